/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpFeatureLookAt.h>

#include "vpFeatureRows.h"
#include "vpLookAt.h"
#include "vpServoCheck.h"

#include <visp3/core/vpException.h>

BEGIN_VISP_NAMESPACE

vpFeatureLookAt::vpFeatureLookAt()
{
  dim_s = 3;
  init();
}

void vpFeatureLookAt::init()
{
  s.resize(dim_s);
  m_interaction << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
}

void vpFeatureLookAt::buildFrom(const vpHomogeneousMatrix &cdMc, const vpHomogeneousMatrix &cdMo)
{
  const Eigen::Matrix3d R = vpServoPose::rotation(cdMc);
  const Eigen::Vector3d t = vpServoPose::translation(cdMc), origin = vpServoPose::translation(cdMo);
  const vpLookAt lookAt(origin, t);
  if (!lookAt.defined || !vpServoCheck::isPose(cdMc) || !vpServoCheck::isPose(cdMo)) {
    throw vpException(vpException::badValue,
                      "look-at feature is undefined: camera at (%g, %g, %g) m, object at (%g, %g, %g) m", t.x(), t.y(),
                      t.z(), origin.x(), origin.y(), origin.z());
  }
  const Eigen::Vector3d e = vpSO3::log(lookAt.rotation.transpose() * R);
  for (unsigned int i = 0; i < 3; ++i) {
    s[i] = e[i];
  }
  // d' = -R v: the direction to the object rotates against the camera's motion.
  const Eigen::Matrix3d inverseJacobian = vpSO3::rightJacobianInverse(e);
  m_interaction << inverseJacobian * R.transpose() * lookAt.rate * R, inverseJacobian;
}

vpMatrix vpFeatureLookAt::interaction(unsigned int select) { return vpFeatureRows::select(m_interaction, select); }

void vpFeatureLookAt::print(unsigned int select) const { vpFeatureRows::print("look-at", s, select); }

vpFeatureLookAt *vpFeatureLookAt::duplicate() const { return new vpFeatureLookAt(*this); }

END_VISP_NAMESPACE
