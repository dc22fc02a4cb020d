/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoPlant.h
 * \brief Imperfections of a robot and its vision system.
 */
#ifndef vpServoPlant_h
#define vpServoPlant_h

#include <visp3/direct_core/vpField.h>

#include <string>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_simulation
 * \brief Parameters of a plant. The limits are the same for all laws compared.
 *
 * \code
 * vpServoPlant plant = vpServoPlant::byName("B");
 * plant.deadband = 0.05; // rad/s
 * plant.validate();      // throws, naming what is out of range
 * vpFrictionCamera robot(plant);
 * \endcode
 */
struct VISP_EXPORT vpServoPlant {
  std::string name = "A";   //!< Name for reports.
  double loopRate = 100.;   //!< Rate of the inner loop that runs the law, Hz, > 0.
  double visionRate = 100.; //!< Rate of the camera, Hz, > 0. At most #loopRate.
  double latency = 0.;      //!< Latency from exposure to result, s, >= 0. The inner loop compensates it by odometry.
  double pixelNoise = 0.;   //!< Standard deviation of the image points, px, >= 0.
  double lag = 0.;          //!< Time constant of the velocity response, s, >= 0.
  double deadband = 0.;     //!< Coulomb friction of the rotation axes, as lost velocity, rad/s, >= 0.
  double maxLinear = 1.;    //!< Limit of the linear speed, m/s, > 0.
  double maxAngular = 1.5;  //!< Limit of the angular speed, rad/s, > 0.

  /*!
   * The plants of the comparison: "A" perfect; "B" 10 Hz vision, 100 ms latency, 100 Hz loop with odometry, 0.5 px
   * noise, 30 ms lag, deadband 0.10 rad/s; "D" like B with 0.20 rad/s.
   * \throw vpException (badValue) naming an unknown plant and the known ones.
   */
  [[nodiscard]] static vpServoPlant byName(const std::string &name);
  //! The numbers with their ranges and units.
  [[nodiscard]] static const vpFields<vpServoPlant> &fields();
  //! \throw vpException (badValue) naming the field and its value if one is out of range.
  void validate() const;
};

END_VISP_NAMESPACE
#endif
