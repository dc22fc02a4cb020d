/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Input checks and messages common to all calibrations.
#ifndef vpCalibrationInput_h
#define vpCalibrationInput_h

#include <visp3/pattern/vpCalibrationPoint.h>

#include <Eigen/Core>

#include <cstdio>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

// Throws vpException (badValue) that names what is out of range.
void vpCheckCalibrationImage(unsigned int width, unsigned int height);
// NaN stands for "not given".
void vpCheckPrincipalPoint(const char *field, double value);

// Checks number, finiteness and standard deviations; "point 3 of view 0: u is nan, must be finite".
void vpCheckCalibrationView(std::size_t view, const std::vector<vpCalibrationPoint> &points, std::size_t least);

// Distribution of the points of a view: centre, principal axes (columns, longest first), standard deviations along
// them.
struct vpCalibrationSpread {
  Eigen::Vector3d centre;
  Eigen::Matrix3d axes; // right-handed
  Eigen::Vector3d sigma;

  [[nodiscard]] bool isLine() const { return !(sigma[1] > 1e-6 * sigma[0]); }
  [[nodiscard]] bool isPlane() const { return !(sigma[2] > 1e-3 * sigma[0]); }
};
[[nodiscard]] vpCalibrationSpread vpSpreadOf(const std::vector<vpCalibrationPoint> &points);

// Distribution of the image positions, likewise; sigma[2] is 0.
[[nodiscard]] vpCalibrationSpread vpImageSpreadOf(const std::vector<vpCalibrationPoint> &points);

// The null vector of the rows; false when there may be more than one: the second smallest singular value is at most leastGap
// times the largest.
[[nodiscard]] bool vpNullVector(const Eigen::MatrixXd &rows, double leastGap, Eigen::VectorXd &h);

// A sentence of a message, with values as in printf.
template <class... Values> [[nodiscard]] std::string vpSentence(const char *format, Values... values)
{
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

END_VISP_NAMESPACE
#endif
