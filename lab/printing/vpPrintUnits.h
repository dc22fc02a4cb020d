/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintUnits.h
 * \brief The same machine and product in the px and frames of another camera.
 */
#ifndef vpPrintUnits_h
#define vpPrintUnits_h

#include "lab/printing/vpPrintExperiment.h"

BEGIN_VISP_NAMESPACE

/*!
 * \brief Units of length and time of a camera: a pixel on the product and a frame.
 *
 * Everything of an experiment is in px and frames. Under a camera with pixels of p' um instead of p and f' frames a second
 * instead of f, the same machine has other numbers. With the factors l = p / p' (new px in an old one) and t = f' / f (new
 * frames in an old one) and forces per mass, as everywhere here:
 *
 * | quantity | unit | factor |
 * |---|---|---|
 * | length, standard deviation of a place | L | l |
 * | time, delay, lag, period | T | t |
 * | velocity, Stribeck velocity | L/T | l / t |
 * | acceleration, force; Coulomb friction, stiction, friction error | L/T^2 | l / t^2 |
 * | viscous friction, velocity gain, kp | 1/T | 1 / t |
 * | position gain; ki, which sums over frames | 1/T^2 | 1 / t^2 |
 * | kd, which takes differences of frames | 1 | 1 |
 * | density of acceleration noise | L^2/T^3 | l^2 / t^3 |
 * | density of jerk noise, of friction error | L^2/T^5 | l^2 / t^5 |
 * | wander of a place | L^2/T | l^2 / t |
 * | share of a frame, changes per frame | T, 1/T | t, 1 / t |
 */
struct vpPrintUnits {
  double pixelSize = 4.5;   //!< Of a pixel on the product, um, > 0.
  double frameRate = 1600.; //!< Hz, > 0.

  //! Those of a specification.
  [[nodiscard]] static vpPrintUnits of(const vpPrintExperimentSpec &spec);
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * The same stage in other units.
 * \param spec : In units \e from. \param from : Its units. \param to : Those of the result.
 * \throw vpException (badValue) naming a unit that is out of range, and its value.
 */
[[nodiscard]] vpXYStageSpec vpInUnits(const vpXYStageSpec &spec, const vpPrintUnits &from, const vpPrintUnits &to);

/*!
 * Gains with the same law in seconds: kp / t, ki / t^2, kd, and the force bound; friction of the feedforward likewise.
 * \throw vpException (badValue) naming a unit that is out of range, and its value.
 */
[[nodiscard]] vpPrintVelocityControlSpec vpInUnits(const vpPrintVelocityControlSpec &spec, const vpPrintUnits &from,
                                                   const vpPrintUnits &to);

/*!
 * A filter with the same poles in seconds: a pole z of the filter, a root of z^2 + (alpha + beta - 2) z + 1 - alpha, becomes
 * z^(1/t). Angles that would pass half a turn a frame stay there. Stable gains stay stable.
 * \throw vpException (badValue) naming a unit or gain that is out of range, and its value.
 */
[[nodiscard]] vpAlphaBetaGains vpInUnits(const vpAlphaBetaGains &gains, const vpPrintUnits &from,
                                         const vpPrintUnits &to);

/*!
 * The same machine, product, estimators, controllers and print head under a camera with other pixels and another frame rate. Of
 * the camera, delay and exposure stay the same in seconds; size of the image, noise and grey values stay as they are, the
 * optics' blur stays the same on the product. Dust and cracks stay as many on the product, but their size is in px.
 * Commands of the preview control stay about as many a second, within 1..16 a frame. Counts of frames are rounded.
 * \throw vpException (badValue) naming a unit that is out of range, and its value.
 */
[[nodiscard]] vpPrintExperimentSpec vpInUnits(const vpPrintExperimentSpec &spec, const vpPrintUnits &to);

END_VISP_NAMESPACE
#endif
