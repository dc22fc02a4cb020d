/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintUnits.h
 * \brief Converts machine and product to the px and frames of another camera.
 */
#ifndef vpPrintUnits_h
#define vpPrintUnits_h

#include "lab/printing/vpPrintExperiment.h"

BEGIN_VISP_NAMESPACE

/*!
 * \brief Units of length and time of a camera: a pixel on the product and a frame.
 *
 * An experiment is specified in px and frames. Under a camera with pixels of p' um instead of p and f' frames per
 * second instead of f, the same machine has different numbers. With the factors l = p / p' (new px per old px) and t =
 * f' / f (new frames per old frame) and forces per mass, as everywhere here:
 *
 * | quantity | unit | factor |
 * |---|---|---|
 * | length, standard deviation of a position | L | l |
 * | time, delay, lag, period | T | t |
 * | velocity, Stribeck velocity | L/T | l / t |
 * | acceleration, force; Coulomb friction, stiction, friction error | L/T^2 | l / t^2 |
 * | viscous friction, velocity gain, kp | 1/T | 1 / t |
 * | position gain; ki, which sums over frames | 1/T^2 | 1 / t^2 |
 * | kd, which takes differences of frames | 1 | 1 |
 * | density of acceleration noise | L^2/T^3 | l^2 / t^3 |
 * | density of jerk noise, of friction error | L^2/T^5 | l^2 / t^5 |
 * | random walk of a position | L^2/T | l^2 / t |
 * | fraction of a frame, changes per frame | T, 1/T | t, 1 / t |
 */
struct vpPrintUnits {
  double pixelSize = 4.5;   //!< Size of a pixel on the product, um, > 0.
  double frameRate = 1600.; //!< Frame rate, Hz, > 0.

  //! Units of a specification.
  [[nodiscard]] static vpPrintUnits of(const vpPrintExperimentSpec &spec);
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * Converts a stage to other units.
 * \param spec : Stage in units \e from. \param from : Units of \e spec. \param to : Units of the result.
 * \throw vpException (badValue) naming a unit that is out of range, and its value.
 */
[[nodiscard]] vpXYStageSpec vpInUnits(const vpXYStageSpec &spec, const vpPrintUnits &from, const vpPrintUnits &to);

/*!
 * Converts gains to the same law in seconds: kp / t, ki / t^2, kd, and the force bound; feedforward friction likewise.
 * \throw vpException (badValue) naming a unit that is out of range, and its value.
 */
[[nodiscard]] vpPrintVelocityControlSpec vpInUnits(const vpPrintVelocityControlSpec &spec, const vpPrintUnits &from,
                                                   const vpPrintUnits &to);

/*!
 * Converts a filter to the same poles in seconds: a pole z, a root of z^2 + (alpha + beta - 2) z + 1 - alpha, becomes
 * z^(1/t). Pole angles are limited to half a turn per frame. Stable gains stay stable.
 * \throw vpException (badValue) naming a unit or gain that is out of range, and its value.
 */
[[nodiscard]] vpAlphaBetaGains vpInUnits(const vpAlphaBetaGains &gains, const vpPrintUnits &from,
                                         const vpPrintUnits &to);

/*!
 * Converts machine, product, estimators, controllers and print head to a camera with another pixel size and frame rate.
 * Delay and exposure are kept in seconds, the optical blur on the product; image size in px, noise and grey values are
 * unchanged. The number of dust specks and cracks on the product is kept, but their size is in px. The preview
 * control keeps about its commands per second, within 1..16 per frame. Frame counts are rounded.
 * \throw vpException (badValue) naming a unit that is out of range, and its value.
 */
[[nodiscard]] vpPrintExperimentSpec vpInUnits(const vpPrintExperimentSpec &spec, const vpPrintUnits &to);

END_VISP_NAMESPACE
#endif
