/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fieldMotion.h
 * \brief A point that visits positions in a potential field as printed: figure 8.6.
 */
#ifndef avoidObstacle_fieldMotion_h
#define avoidObstacle_fieldMotion_h

#include <visp3/avoidance/vpPotentialField.h>

#include <vector>

namespace avoidObstacle
{
/*!
 * \brief Positions in time order, and an obstacle beside the path that acts only on x, as in section 8.3.3. The
 * thesis gives no numbers for figure 8.6: these are our choice.
 */
struct FieldTask {
  std::vector<Eigen::Vector2d> places = {{0.05, 0.15}, {0.05, 0.3}, {0., 0.45}}; //!< Starting at (0, 0), m.
  double slot = 2.5;                       //!< Time per position, s, twice as long for the last one.
  Eigen::Vector2d obstacle = {-0.12, 0.4}; //!< m.
  double sight = 0.2;                      //!< Beyond this along y the camera does not see it, m.
  double gain = 2.;                        //!< x'_t = gain (place - x), 1/s.
  double avoidSpeed = 0.25;                //!< x'_oa, m/s.
  double period = 0.005;                   //!< s.
};

//! \brief The resulting motion.
struct FieldMotion {
  vpFieldWeightSpec weight;
  std::vector<double> times;        //!< s.
  std::vector<Eigen::Vector2d> way; //!< m.
  std::vector<double> weights;      //!< w_u.
  std::vector<double> missed;       //!< Distance from each position at the end of its slot, m.
  double peakSpeed = 0.;            //!< m/s.
};

//! If \e withObstacle is false, the obstacle has no weight.
[[nodiscard]] FieldMotion followField(const FieldTask &task, const vpFieldWeightSpec &weight, bool withObstacle = true);
//! Parameters of the upper (strict) and the lower plot, m.
[[nodiscard]] vpFieldWeightSpec strictField();
[[nodiscard]] vpFieldWeightSpec mildField();
} // namespace avoidObstacle

#endif
