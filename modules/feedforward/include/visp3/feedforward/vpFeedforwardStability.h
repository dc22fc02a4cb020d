/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFeedforwardStability.h
 * \brief Stability margin of the law `ff-sum`: where it is known to converge, not a proof for all poses.
 */
#ifndef vpFeedforwardStability_h
#define vpFeedforwardStability_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_feedforward
 * Stability margin of the rotation under `ff-sum`, for a bearing of the object and a rotation to the goal.
 *
 * The law is a cascade: the translation error decays independently, and with it the disturbance B v of the rotation.
 * What remains is e_w' = -k A e_w, with k the rotation gain, A = L_theta_u + kappa S M, M = -J_th Lw the effect of a
 * rotation on the bearing angle of a point, and S = diag(s1, s2, 0), 0 < s <= 1, the slopes of the saturation. The
 * result is the smallest eigenvalue of (A + A^T) / 2 over sampled directions of bearing and rotation and over the
 * corners of S. (The smallest eigenvalue is concave in S, so the corners bound all saturations.) While it is > 0 along
 * the whole path, |e_w| decreases at least as exp(-k margin t). Where it is <= 0 nothing is known: the thesis's claim
 * of global stability, (5.29)-(5.31), does not apply to this law.
 *
 * \code
 * const double margin = vpFeedforwardSumStabilityMargin(vpMath::rad(20.), vpMath::rad(60.), 1.);
 * std::cout << (margin > 0. ? "converges" : "not known to converge") << ", margin " << margin << std::endl;
 * \endcode
 * \param bearing : Angle between the optical axis and the direction to the object, rad, in [0, pi/2).
 * \param rotation : Angle theta of the rotation to the goal, rad, in [0, pi].
 * \param kappa : Weight of the image term, >= 0.
 * \param samples : Number of rotation axes, evenly distributed over the sphere, for each of 16 directions of the
 *   bearing, >= 1.
 * \return The margin; 1 at the goal, at most 1.
 * \throw vpException (badValue) naming the argument and its value when one is out of its range.
 */
[[nodiscard]] VISP_EXPORT double vpFeedforwardSumStabilityMargin(double bearing, double rotation, double kappa,
                                                                 unsigned int samples = 500);

END_VISP_NAMESPACE
#endif
