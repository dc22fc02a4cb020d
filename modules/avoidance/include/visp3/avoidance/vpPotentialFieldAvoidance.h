/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpPotentialFieldAvoidance_h
#define vpPotentialFieldAvoidance_h

#include <visp3/avoidance/vpAvoidanceMethod.h>
#include <visp3/avoidance/vpPotentialField.h>

#include <memory>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpPotentialFieldAvoidance.
 */
struct VISP_EXPORT vpPotentialFieldAvoidanceSpec {
  vpAvoidanceMethodSpec common;              //!< What all methods have.
  vpFieldForm form = vpFieldForm::Corrected; //!< See there.
  vpFieldWeightSpec metres;                  //!< Corrected: (8.2) over the distance from the surface, m.
  vpFieldWeightSpec pixels{120., 60., 0.5};  //!< Thesis: (8.2) over the place in the image, px.
  double gain = 2.;                          //!< x'_t = gain (goal - x), 1/s, > 0.
  double avoidSpeed = 0.25;                  //!< |x'_oa|, m/s, > 0; as printed of each image axis.
  double focal = 600.;                       //!< Thesis: focal length of the camera, px, > 0.
  double imageWidth = 640.;                  //!< Thesis: of the picture, px, > 0.
  double imageHeight = 480.;                 //!< The same.
  double sight = 1.;                         //!< Thesis: obstacles farther from the camera do not count, m, > 0.
  double tolerance = 1e-3;                   //!< The goal is reached within this, m, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpPotentialFieldAvoidance
 * \ingroup group_avoidance
 * \brief Reactive avoidance on path level, thesis 8.2.1: the tool's velocity is a mixture of one to the goal and one away
 * from the obstacle. A baseline: nothing is foreseen, and it stops where both cancel (Waiting).
 *
 * vpFieldForm::Thesis: (8.1)-(8.2) as printed; the obstacle counts while the camera sees its centre, on the two image
 * axes apart, which are turned into the base frame (the text takes them for it). As in the text no bound is kept on
 * velocities or accelerations, only position limits are.
 *
 * vpFieldForm::Corrected: radial distance of the last link from the obstacle's surface, weight 1 in contact, only the
 * velocity towards the obstacle changes. The tool's speed and the joints' limits are kept, the tool's acceleration is not.
 *
 * Both push the rest of the arm away from obstacles by self-motion, (8.10)-(8.12).
 */
class VISP_EXPORT vpPotentialFieldAvoidance : public vpAvoidanceMethod
{
public:
  /*!
   * \param scene : Must outlive this.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpPotentialFieldAvoidanceSpec::validate(); naming a joint without motion limits.
   */
  explicit vpPotentialFieldAvoidance(const vpCollisionScene &scene, const vpPotentialFieldAvoidanceSpec &spec = {});
  ~vpPotentialFieldAvoidance() override;

  vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) override;
  void setGoal(const vpAvoidanceGoal &goal) noexcept override;
  //! Nothing: the field is looked up in every step().
  void look() override {}
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
