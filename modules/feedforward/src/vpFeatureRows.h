/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFeatureRows.h
 * \brief Common code of the features of this module: row selection as requested by vpServo.
 */
#ifndef vpFeatureRows_h
#define vpFeatureRows_h

#include <visp3/core/vpMatrix.h>
#include <visp3/visual_features/vpBasicFeature.h>

#include <Eigen/Core>

#include <iostream>

BEGIN_VISP_NAMESPACE

namespace vpFeatureRows
{
//! The rows of \e L selected by \e select.
inline vpMatrix select(const Eigen::Matrix<double, 3, 6> &L, unsigned int select)
{
  vpMatrix rows;
  for (unsigned int i = 0; i < 3; ++i) {
    if (vpBasicFeature::FEATURE_LINE[i] & select) {
      const unsigned int n = rows.getRows();
      rows.resize(n + 1, 6, false);
      for (unsigned int k = 0; k < 6; ++k) {
        rows[n][k] = L(i, k);
      }
    }
  }
  return rows;
}

//! "name: s0 s1 s2" with the selected components.
inline void print(const char *name, const vpColVector &s, unsigned int select)
{
  std::cout << name << ":";
  for (unsigned int i = 0; i < s.getRows(); ++i) {
    if (vpBasicFeature::FEATURE_LINE[i] & select) {
      std::cout << ' ' << s[i];
    }
  }
  std::cout << std::endl;
}
} // namespace vpFeatureRows

END_VISP_NAMESPACE
#endif
