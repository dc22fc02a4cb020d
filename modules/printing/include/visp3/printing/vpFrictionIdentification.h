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

#include <limits>
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
//! \brief Parameters of the identification.
struct VISP_EXPORT vpFrictionIdentificationSpec {
  bool stribeck = true;      //!< Also stiction and Stribeck velocity; otherwise stiction = Coulomb.
  double minVelocity = 0.;   //!< Slower samples are not used (they may stick), L/T, >= 0.
  double outlier = 4.685;    //!< Tukey's bound, in standard deviations, > 1; 4.685 keeps 95 % efficiency.
  double maxCondition = 1e3; //!< Largest condition number of the scaled regressors, > 1.
  double falseAlarm = 0.01;  //!< Share of right models that may be called misfits, > 0 and < 1.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief Result of an identification.
enum class vpFrictionStatus {
  Good,          //!< All parameters hold.
  TooFewSamples, //!< Less than ten samples for each parameter.
  NotExcited,    //!< Velocities or accelerations vary too little to tell the parameters apart; no value is valid.
  NoStribeck,    //!< The slow samples do not show a Stribeck term; stiction = Coulomb, the rest holds.
  NotFinite,     //!< A sample is not finite or beyond vpPrintingLargest; no value is valid.
  //! The forces hold what neither the model nor independent noise has: the parameters are the best of this model, their
  //! standard deviations are too small.
  Misfit
};

//! \ingroup group_printing
//! \brief Parameters with their standard deviations, which take the model as right and the noise of the samples as independent.
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
  //! Of residuals as these, or worse, when the model is right and the noise independent; NaN: not tested.
  double fitProbability = std::numeric_limits<double>::quiet_NaN();

  //! Status as a sentence; static text, never null.
  [[nodiscard]] const char *message() const;
};

/*!
 * \ingroup group_printing
 * \brief Mass, viscous, Coulomb and Stribeck friction from a log such as a velocity ramp (thesis section 7.3.4):
 * weighted least squares with Tukey's weights, starting from an L1 fit; the Stribeck velocity by a search over the fit.
 *
 * Velocities and accelerations are taken as exact: filter them before, without delay between them and the forces.
 *
 * The fit is tested in two ways, which share spec.falseAlarm. One tests whether the residuals contain an offset, or a dependence on the
 * velocity that the model lacks (up to the third power, different in either direction; score test of an M-estimator, by Fisher's F).
 * The other tests whether consecutive residuals of the log are correlated. If either finds something, the status is
 * vpFrictionStatus::Misfit. Samples that were smoothed over overlapping windows are correlated.
 * Allocates; not for control loops.
 *
 * \code
 * const vpFrictionIdentification found = vpIdentifyFriction(samples); // of slow and fast motions
 * std::cout << found.message() << std::endl;
 * if (found.status == vpFrictionStatus::Good || found.status == vpFrictionStatus::NoStribeck) {
 *   std::cout << "Coulomb " << found.model.coulomb << " +- " << found.sigmaCoulomb << std::endl;
 * }
 * \endcode
 * \throw vpException (badValue) naming a field of \e spec that is out of range.
 */
[[nodiscard]] VISP_EXPORT vpFrictionIdentification
vpIdentifyFriction(const std::vector<vpFrictionSample> &log,
                   const vpFrictionIdentificationSpec &spec = vpFrictionIdentificationSpec());

END_VISP_NAMESPACE
#endif
