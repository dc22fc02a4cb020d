/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCameraPoseNoise.h
 * \brief Camera pose as known by the arm.
 */
#ifndef vpCameraPoseNoise_h
#define vpCameraPoseNoise_h

#include "vpHashRandom.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

//! fMc with Gaussian errors of position (m) and rotation (rad) per component. \param seed : Seed for this image.
inline vpRigidTransform vpNoisyCamera(const vpRigidTransform &fMc, double positionSigma, double angleSigma,
                                      unsigned int seed)
{
  vpHashRandom random(seed, vpHashRandom::Purpose::CameraPose, 0, 0);
  const auto normal = [&random] {
    const double value = vpNormalQuantiles::get()[static_cast<std::uint16_t>(random.bits())];
    return value;
  };
  Eigen::Vector3d place, turn;
  for (int i = 0; i < 3; ++i) {
    place(i) = positionSigma * normal();
    turn(i) = angleSigma * normal();
  }
  return {vpSO3::exp(turn) * fMc.R, fMc.p + place};
}

END_VISP_NAMESPACE
#endif
