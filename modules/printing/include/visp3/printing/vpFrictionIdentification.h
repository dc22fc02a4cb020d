/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFrictionIdentification.h
 * \brief Mass and friction of an axis from a log of forces and motion.
 */
#ifndef vpFrictionIdentification_h
#define vpFrictionIdentification_h

#include <visp3/printing/vpFrictionModel.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief One row of the log.
struct VISP_EXPORT vpFrictionSample {
  double force = 0.;        //!< Applied force, F.
  double velocity = 0.;     //!< Velocity, L/T.
  double acceleration = 0.; //!< Acceleration, L/T^2.
};

//! \ingroup group_printing
//! \brief Options of the identification.
struct VISP_EXPORT vpFrictionIdentificationSpec {
  bool stribeck = true;      //!< Identify stiction and Stribeck velocity, too; otherwise stiction = Coulomb.
  double minVelocity = 0.;   //!< Slower samples are ignored (they may stick), L/T, >= 0.
  double outlier = 4.685;    //!< Tukey's bound, in standard deviations, > 1; 4.685 has 95 % efficiency.
  double maxCondition = 1e3; //!< Maximum condition number of the scaled regressors, > 1.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief Result of an identification.
enum class vpFrictionStatus {
  Good,          //!< All parameters are valid.
  TooFewSamples, //!< Less than ten samples per parameter.
  NotExcited,    //!< Velocities or accelerations vary too little to separate the parameters; nothing is valid.
  NoStribeck,    //!< The slow samples show no Stribeck term; stiction = Coulomb, the rest is valid.
  NotFinite      //!< A sample is not finite or beyond vpPrintingLargest; nothing is valid.
};

//! \ingroup group_printing
//! \brief Parameters with their standard deviations.
struct VISP_EXPORT vpFrictionIdentification {
  vpFrictionStatus status = vpFrictionStatus::TooFewSamples; //!< Reliability of the result.
  vpFrictionModel model;                                     //!< Estimated parameters.
  double sigmaMass = 0.;                                     //!< Standard deviation of the mass.
  double sigmaViscous = 0.;                                  //!< Standard deviation of the viscous friction.
  double sigmaCoulomb = 0.;                                  //!< Standard deviation of the Coulomb friction.
  double sigmaStiction = 0.;                                 //!< Standard deviation of stiction at stribeckVelocity.
  double noise = 0.;     //!< Standard deviation of the forces from the model, robust, F.
  int samples = 0;       //!< Number of samples used.
  int outliers = 0;      //!< Number of samples used with weight 0.
  double condition = 0.; //!< Condition number of the scaled regressors.

  //! Status as a sentence; static text, never null.
  [[nodiscard]] const char *message() const;
};

/*!
 * \ingroup group_printing
 * \brief Mass, viscous, Coulomb and Stribeck friction from a log such as a velocity ramp (thesis section 7.3.4):
 * weighted least squares with Tukey's weights, starting from an L1 fit; the Stribeck velocity by a search over the fit.
 *
 * Velocities and accelerations are assumed exact: filter them before, without delay relative to the forces.
 * Allocates; not for control loops.
 * \throw vpException (badValue) naming a field of \e spec that is out of range.
 */
[[nodiscard]] VISP_EXPORT vpFrictionIdentification
vpIdentifyFriction(const std::vector<vpFrictionSample> &log,
                   const vpFrictionIdentificationSpec &spec = vpFrictionIdentificationSpec());

END_VISP_NAMESPACE
#endif
