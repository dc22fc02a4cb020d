/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpToolView.h
 * \brief Before a fixed camera: the task of the end effector, for a law that plans the motion of a camera.
 */
#ifndef vpToolView_h
#define vpToolView_h

#include "vpRigidMotion.h"

#include <visp3/feedforward/vpObjectAverage.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Measurement and goal with which a law moves the end effector as if it were the camera, and so keeps the limits of what moves.
 *
 * With the camera eMc and the object eMo in the end effector, eMo averaged over the images, the end effector has its goal at
 * E = eMc cdMo eMo^-1 in its own frame. The law sees it as an object at E that is to come to its own origin: so near, an object
 * has no direction in which to look, and the plan turns the shortest way. Nothing here allocates or throws after construction.
 */
class vpToolView
{
public:
  vpToolView()
  {
    m_goal.cdMo[2][3] = ahead;
    m_goal.points.resize(1);
    m_view.points.resize(1);
  }

  const vpServoGoal &goal() const { return m_goal; } //!< Of the end effector; the same for all.
  //! \param measurement : Of the fixed camera, now. \param eMc : Camera in the end effector, now. \param cdMo : The camera's goal.
  const vpServoMeasurement &of(const vpServoMeasurement &measurement, const vpRigidTransform &eMc,
                               const vpHomogeneousMatrix &cdMo) noexcept
  {
    m_view.valid = measurement.valid;
    if (!m_view.valid) {
      return m_view;
    }
    m_view.time = measurement.time;
    set(eMc * vpRigidTransform::fromHomogeneous(measurement.cMo));
    m_object.see(m_view);
    const vpRigidTransform eMo{m_object.fRo(), m_object.fto()};
    const vpRigidTransform goal = eMc * vpRigidTransform::fromHomogeneous(cdMo) * eMo.inverse();
    m_view.time = 0.; // each cycle counts: the images are averaged already, and a new goal is no noise
    set(goal * vpRigidTransform{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0., 0., ahead)});
    return m_view;
  }

private:
  static constexpr double ahead = 1e-6; // m; a goal is in front of the camera

  void set(const vpRigidTransform &pose) noexcept
  {
    for (unsigned int i = 0; i < 3; ++i) {
      for (unsigned int k = 0; k < 3; ++k) {
        m_view.cMo[i][k] = pose.R(i, k);
      }
      m_view.cMo[i][3] = pose.p(i);
    }
  }

  vpObjectAverage m_object; // in the end effector
  vpServoGoal m_goal;
  vpServoMeasurement m_view;
};

END_VISP_NAMESPACE
#endif
