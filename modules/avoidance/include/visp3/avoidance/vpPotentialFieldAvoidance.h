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
  vpAvoidanceMethodSpec common;              //!< Parameters common to all methods.
  vpFieldForm form = vpFieldForm::Corrected; //!< Variant of (8.1)-(8.2).
  vpFieldWeightSpec metres;                  //!< Corrected: (8.2) over the distance from the surface, m.
  vpFieldWeightSpec pixels{120., 60., 0.5};  //!< Thesis: (8.2) over the image position, px.
  double gain = 2.;                          //!< Gain of x'_t = gain (goal - x), 1/s, > 0.
  double avoidSpeed = 0.25;                  //!< Avoidance speed |x'_oa|, m/s, > 0; as printed, per image axis.
  double focal = 600.;                       //!< Thesis: focal length of the camera, px, > 0.
  double imageWidth = 640.;                  //!< Thesis: image width, px, > 0.
  double imageHeight = 480.;                 //!< Thesis: image height, px, > 0.
  double sight = 1.;                         //!< Thesis: maximum distance of obstacles from the camera, m, > 0.
  double tolerance = 1e-3;                   //!< Position tolerance at the goal, m, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpPotentialFieldAvoidance
 * \ingroup group_avoidance
 * \brief Reactive avoidance at path level, thesis 8.2.1: the tool velocity blends one to the goal and one away from the
 * obstacle. A baseline: no prediction, and it stops where both cancel (Waiting).
 *
 * vpFieldForm::Thesis: (8.1)-(8.2) as printed; the obstacle acts while the camera sees its centre, separately on the
 * two image axes, which are rotated into the base frame (the text equates them with it). As in the text velocities and
 * accelerations are not limited, only positions.
 *
 * vpFieldForm::Corrected: radial distance of the last link from the obstacle's surface, weight 1 in contact, only the
 * velocity towards the obstacle changes. Tool speed and joint limits are kept, the tool's acceleration limit is not.
 *
 * Both push the rest of the arm away from obstacles by self-motion, (8.10)-(8.12).
 *
 * \code
 * vpPotentialFieldAvoidance method(scene);
 * method.start(q, vpAvoidanceGoal::at(arm, goal));
 * vpAvoidanceOutput output;
 * for (int i = 0; i < 4000 && (i == 0 || vpIsWorking(output)); ++i) { // 20 s: it may stand for ever
 *   method.step(q, output);
 *   q += 0.005 * output.velocity; // to the drives
 * }
 * std::cout << vpMessage(output, scene, 0.01) << std::endl;
 * \endcode
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
  //! Does nothing: the field is evaluated in every step().
  void look() override {}
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
