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
 * \brief Mass and friction of one axis: F = m a + Fv v + sgn(v) (Fc + (Fs - Fc) exp(-(v / vs)^2)), thesis (7.25), (7.26) with
 * Stribeck's term. Units: length L (px), time T (frame), force F; with mass 1 forces are accelerations.
 */
struct VISP_EXPORT vpFrictionModel {
  double mass = 1.;             //!< F T^2/L, > 0.
  double viscous = 0.;          //!< Fv, F T/L, >= 0.
  double coulomb = 0.;          //!< Fc, F, >= 0.
  double stiction = 0.;         //!< Fs, F, >= 0; with stiction = coulomb there is no Stribeck term.
  double stribeckVelocity = 1.; //!< vs, L/T, > 0.

  //! Friction at a velocity, F; odd, 0 at rest. Finite for a plausible velocity (vpIsPlausible()) and a validated model.
  [[nodiscard]] double friction(double velocity) const noexcept;
  //! Force that gives an acceleration at a velocity, (7.26), F. Finite as friction() is.
  [[nodiscard]] double force(double velocity, double acceleration) const noexcept;
  /*!
   * \param owner : Whose model it is, for the message.
   * \throw vpException (badValue) naming the field that is out of range, and its value.
   */
  void validate(const char *owner) const;
};

END_VISP_NAMESPACE
#endif
