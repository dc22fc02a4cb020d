/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFrictionModel.h
 * \brief Mass and friction of one axis of a stage.
 */
#ifndef vpFrictionModel_h
#define vpFrictionModel_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief Mass and friction of one axis: F = m a + Fv v + sgn(v) (Fc + (Fs - Fc) exp(-(v / vs)^2)), thesis (7.25),
 * (7.26) with Stribeck's term. Units: length L (px), time T (frame), force F; with mass 1 forces are accelerations.
 *
 * \code
 * const vpFrictionModel axis{1., 0.02, 0.08, 0.12, 0.3}; // px and frames; of vpIdentifyFriction(), say
 * std::cout << axis.force(5., 0.1) << " px/frame^2" << std::endl; // at 5 px/frame, for 0.1 px/frame^2: 0.28
 * \endcode
 */
struct VISP_EXPORT vpFrictionModel {
  double mass = 1.;             //!< Mass, F T^2/L, > 0.
  double viscous = 0.;          //!< Fv, viscous friction, F T/L, >= 0.
  double coulomb = 0.;          //!< Fc, Coulomb friction, F, >= 0.
  double stiction = 0.;         //!< Fs, stiction, F, >= 0; with stiction = coulomb there is no Stribeck term.
  double stribeckVelocity = 1.; //!< vs, Stribeck velocity, L/T, > 0.

  //! Friction at a velocity, F; odd function, 0 at rest. Finite for a plausible velocity (vpIsPlausible()), valid
  //! model.
  [[nodiscard]] double friction(double velocity) const noexcept;
  //! Force required for an acceleration at a velocity, (7.26), F. Finite as friction() is.
  [[nodiscard]] double force(double velocity, double acceleration) const noexcept;
  /*!
   * \param owner : Owner of the model, for the message.
   * \throw vpException (badValue) naming the field that is out of range, and its value.
   */
  void validate(const char *owner) const;
};

END_VISP_NAMESPACE
#endif
