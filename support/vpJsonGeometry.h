/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJsonGeometry.h
 * \brief Vectors and poses in JSON files, for the modules. Not installed.
 */
#ifndef vpJsonGeometry_h
#define vpJsonGeometry_h

#include "vpJsonObject.h"

#include <Eigen/Geometry>

#include <cmath>

//! Reads a field of \e N numbers.
template <int N> Eigen::Matrix<double, N, 1> vpJsonVector(vpJsonObject &object, const std::string &field)
{
  const std::vector<double> numbers = object.numbers(field, static_cast<std::size_t>(N));
  return Eigen::Map<const Eigen::Matrix<double, N, 1>>(numbers.data());
}

//! Reads a pose: `translation_m`, and optionally `rotation_deg`, a rotation vector.
template <class Transform> Transform vpJsonTransform(vpJsonObject &object)
{
  Transform T;
  T.p = vpJsonVector<3>(object, "translation_m");
  if (object.has("rotation_deg")) {
    const Eigen::Vector3d e = M_PI / 180. * vpJsonVector<3>(object, "rotation_deg");
    const double angle = e.stableNorm();
    if (!(angle <= 1e6)) { // many turns; sine and cosine still keep their digits
      throw object.wrong("rotation_deg", object.value("rotation_deg"), "an angle of at most 1e6 rad");
    }
    if (angle > 0.) {
      T.R = Eigen::AngleAxisd(angle, e.stableNormalized()).toRotationMatrix();
    }
  }
  return T;
}

#endif
