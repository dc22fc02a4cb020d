/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpPotentialField_h
#define vpPotentialField_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Variant of (8.1)-(8.2).
enum class vpFieldForm {
  Thesis,   //!< As printed: a separate weight per image axis, not normalised; may exceed 1.
  Corrected //!< One radial weight, 1 in contact, applied to the direction towards the obstacle only.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of (8.2). The unit of #centre and #width is that of the distances: px or m.
 */
struct VISP_EXPORT vpFieldWeightSpec {
  double centre = 0.04; //!< Distance d_0 at which the weight has fallen by half, > 0.
  double width = 0.02;  //!< Width k_s of the transition, > 0 (called a slope in the text).
  //! Height w_s, > 0. 0.5 is full motion as printed; more overshoots, which reverses the task. Corrected: 0.5 only.
  double height = 0.5;

  //! \throw vpException (badValue) naming the field that is out of range for the form, and its value.
  void validate(vpFieldForm form) const;
};

/*!
 * \ingroup group_avoidance
 * \brief Weight of avoidance at a distance, (8.2): a double sigmoid.
 *
 * As printed w(0) = 2 w_s tanh(d_0/k_s): 0.76 for d_0 = k_s and w_s = 0.5, so that an arm in contact still moves
 * towards the obstacle. Corrected: divided by tanh(d_0/k_s) and never above 1.
 * \param spec : Parameters. \param form : Variant.
 * \param distance : In the unit of the spec; signed as printed, corrected: negative counts as 0.
 */
[[nodiscard]] VISP_EXPORT double vpFieldWeight(const vpFieldWeightSpec &spec, vpFieldForm form,
                                               double distance) noexcept;

/*!
 * \ingroup group_avoidance
 * \brief (8.1) as printed, on two image axes: x' = w x'_oa + (I - w) x'_t with w = diag(w_u, w_v, 0) in the camera.
 * \param spec : Parameters of both weights, px.
 * \param offset : Offset of the obstacle from the image's centre, px. \param avoid : Avoidance velocity x'_oa.
 * \param task : Task velocity x'_t; both of the tool in the axes of the camera, m/s.
 */
[[nodiscard]] VISP_EXPORT Eigen::Vector3d vpBlendAsPrinted(const vpFieldWeightSpec &spec, const Eigen::Vector2d &offset,
                                                           const Eigen::Vector3d &avoid,
                                                           const Eigen::Vector3d &task) noexcept;

/*!
 * \ingroup group_avoidance
 * \brief (8.1) as corrected: the task velocity towards the obstacle is blended into a velocity away from it; motion
 * along or away from the obstacle is unchanged.
 *
 * \code
 * const vpFieldWeightSpec spec; // half the effect 4 cm from the surface
 * const Eigen::Vector3d task(-0.2, 0.1, 0.), normal(1., 0., 0.); // m/s; away from the obstacle
 * std::cout << vpBlendRadial(spec, 0.05, normal, 0.25, task).transpose() << " m/s, 5 cm from it" << std::endl;
 * \endcode
 * \param spec : Parameters of the weight, m.
 * \param distance : Distance from the obstacle's surface, m. \param normal : Unit vector from obstacle to tool.
 * \param speed : Avoidance speed |x'_oa|, m/s, >= 0. \param task : Task velocity x'_t, m/s, in the frame of the normal.
 */
[[nodiscard]] VISP_EXPORT Eigen::Vector3d vpBlendRadial(const vpFieldWeightSpec &spec, double distance,
                                                        const Eigen::Vector3d &normal, double speed,
                                                        const Eigen::Vector3d &task) noexcept;

END_VISP_NAMESPACE
#endif
