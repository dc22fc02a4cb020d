/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpViewConstraintFilter.h
 * \brief Keeps the target in the image with the smallest change of the camera twist.
 */
#ifndef vpViewConstraintFilter_h
#define vpViewConstraintFilter_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/feedforward/vpServoCommand.h>
#include <visp3/feedforward/vpServoMeasurement.h>
#include <visp3/feedforward/vpTwistProjection.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_feedforward
//! \brief Parameters of vpViewConstraintFilter. The default view is 640x480 px with f = 800 px.
struct VISP_EXPORT vpViewConstraintSpec {
  double left = -0.4;      //!< Left border of the image, normalised (x = X/Z), < 0.
  double right = 0.39875;  //!< Right border, > 0.
  double top = -0.3;       //!< Upper border, < 0.
  double bottom = 0.29875; //!< Lower border, > 0.
  double gamma = 5.;    //!< A point may use at most this fraction of its distance to the border per second, 1/s, > 0.
  double period = 0.01; //!< Longest time for which a twist is executed, s, > 0.
  double imageUncertainty = 0.; //!< Bound of the error of the outline's x and y, normalised, >= 0; added to the margin.
  double depthUncertainty = 0.; //!< Bound of the relative error of the outline's depths, 0..0.9.
  double maxLinear = 1.;        //!< Limit of the linear speed, m/s, > 0.
  double maxAngular = 1.5;      //!< Limit of the angular speed, rad/s, > 0.

  /*!
   * The view of a camera. The image extends from the centre of the first pixel to the centre of the last one;
   * distortion is ignored, so with a distorting lens pass the undistorted camera.
   * \throw vpException (badValue) when the size is 0 or the principal point is not inside the image.
   */
  [[nodiscard]] static vpViewConstraintSpec fromCamera(const vpCameraParameters &camera, unsigned int width,
                                                       unsigned int height);
  //! \throw vpException (badValue) naming the field and its value when one is out of its range or not finite.
  void validate() const;
};

/*!
 * \class vpViewConstraintFilter
 * \ingroup group_feedforward
 * \brief Filter behind any servo law: the twist nearest to the desired one that keeps every outline point in view.
 *
 * For each outline point and each of the four borders, with b the distance to the border, h = b - m the distance to a
 * line inside it by a margin m, and L the row of the point's interaction matrix, it requires L v >= -gamma h (a control
 * barrier function: near the border the point slows down exponentially) and solves min |v - v0|^2, with speeds in units
 * of #vpViewConstraintSpec::maxLinear and #vpViewConstraintSpec::maxAngular.
 *
 * **Limits.** v0 is first scaled, as a whole, to the speed limits V0 and W0, and the solution is scaled back to the
 * share of them used by v0, s0 = max(|v0| / V0, |w0| / W0). One factor for all six components: a twist that satisfies
 * L v >= -gamma h with h >= 0 does so at every smaller speed too, while clipping by axis would violate it. V0, W0 are
 * #vpViewConstraintSpec::maxLinear and #vpViewConstraintSpec::maxAngular, and while a point is visible at most an
 * eighth of the smallest depth, and 1 / (8 rho1) rad, in a period T.
 *
 * **Guarantee.** T is the longer of \e dt and #vpViewConstraintSpec::period; a longer dt makes the motion slower, not
 * unsafe. If every visible point is initially inside the view (by imageUncertainty), and the camera executes the
 * constant twist returned, then no point is outside at any time from 0 to T.
 *
 * **Proof.** Under a constant twist (v, w) a point at m = (x, y, 1) and depth Z has, with q = P'/Z = -v/Z - w x m,
 * x' = q_x - x q_z, q' = -w x q - q_z q, and so x'' + 2 q_z x' = (1, 0, -x) . (-w x q). All twists of a step, v0 as
 * well as the result, have |v| <= V = s0 V0 and |w| <= W = s0 W0. With the view radius rho, rho1 = sqrt(1 + rho^2), and
 * n the smallest depth that the uncertainty allows, Z' >= -V - W rho Z gives Z >= zeta = (n - V T) exp(-W rho T) > 0
 * while the point is in view, hence |x'' + 2 q_z x'| <= C = rho1 W (V/zeta + W rho1) and |q_z| <= kappa = V/zeta + W
 * rho. Solved by the integrating factor exp(2 int q_z), which stays in exp(+-2 kappa T): with b the distance to a
 * border and r the outward speed at t = 0, b(t) >= b - r t f - C t^2 exp(2 kappa T) / 2 with some f in exp(+-2 kappa
 * T). The rows see the point with an error of up to imageUncertainty u, which changes r by at most D = u (V/n + W (1 +
 * 3 rho + 2 u)). Take the smaller of gamma and exp(-2 kappa T) / (2 T) for gamma, and the margin m = exp(4 kappa T) (C
 * T + 2 D) / gamma.
 * - h >= 0, r <= gamma h + D: b(t) >= b (1 - gamma T exp(2 kappa T)) + exp(2 kappa T) T (gamma m - D - C T / 2) >= 0,
 *   since the first bracket is at least 1/2 and gamma m >= C T + 2 D.
 * - h < 0, r <= D - s gamma (m - b) with s the factor of the scaling, at least 1/2 (below that the filter stands
 *   still), hence b(t) >= b (1 - s gamma t f) + t f (s gamma m - D) - C t^2 exp(2 kappa T) / 2 >= 0, since
 *   s gamma m - D >= exp(4 kappa T) C T / 2.
 * The margin vanishes with the square of the speed towards the goal (except for u), so the whole view is usable at the
 * goal. `bin/catchViewConstraintProof` tests the guarantee with adversarial cases.
 *
 * **Zero twist** is feasible while all h >= 0. A point with h < 0, in the margin or outside the image, has to move
 * inwards (backing away does it for all points, the principal point being in view); the motion is scaled to the speed
 * of v0, so without any desired motion the point stays where it is. Contradicting rows give zero.
 *
 * **Deadlock** is possible: the nearest twist may be zero although the goal is not reached. It is reported
 * (vpServoStatus::Deadlock) when less than 2 % of the desired speed is left.
 *
 * **Uncertain depth:** rows hold at both ends of the depth interval; they are linear in 1/Z, so in between too.
 *
 * \code
 * vpViewConstraintFilter filter(vpViewConstraintSpec::fromCamera(camera, 640, 480));
 * const vpServoCommand safe = filter.filter(law.step(measurement, dt), measurement.outline, dt); // each cycle
 * robot.setVelocity(vpRobot::CAMERA_FRAME, safe.v.toColVector());
 * if (safe.status == vpServoStatus::Deadlock) {
 *   std::cerr << vpMessage(safe.status) << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpViewConstraintFilter
{
public:
  //! Maximum number of visible outline points: at most two rows for each border.
  static constexpr int maxPoints = vpTwistProjection::capacity / 8;

  //! \throw vpException (badValue) naming the field and its value.
  explicit vpViewConstraintFilter(const vpViewConstraintSpec &spec = {});

  //! Current parameters.
  [[nodiscard]] const vpViewConstraintSpec &spec() const { return m_spec; }

  /*!
   * One cycle.
   * \param wanted : Output of the law. Any status but Servoing passes through unchanged.
   * \param outline : Points to keep in view, as currently seen; those not visible are ignored. None: only the speed
   *   limits apply.
   * \param dt : Time for which the twist will be executed, s; at least the period of the configuration is used.
   * \return Servoing with the same twist, ViewLimited with a changed one, Deadlock, or InvalidInput with zero twist
   *   when a visible point is not finite, has a depth <= 0, or more than #maxPoints are visible.
   */
  [[nodiscard]] vpServoCommand filter(const vpServoCommand &wanted, const std::vector<vpServoPoint> &outline,
                                      double dt) noexcept;

  /*!
   * Margin m, normalised, between the border and a point at depth \e Z.
   * \param Z : Depth, m, > 0. \param linear, angular : Speed, m/s and rad/s. \param period : Time step, s, > 0.
   */
  [[nodiscard]] double margin(double Z, double linear, double angular, double period) const noexcept;

private:
  // Bounds of |v| and |w|, m/s and rad/s.
  struct Speeds {
    double linear, angular;
  };
  // Values of gamma and margin for a point.
  struct Bounds {
    double gamma, margin;
  };
  [[nodiscard]] Bounds bounds(double Z, const Speeds &speeds, double period) const noexcept;
  bool addRows(const vpServoPoint &point, const Speeds &limits, double share, double period) noexcept;

  vpViewConstraintSpec m_spec;
  double m_radius; // radius of the view's farthest corner, normalised
  bool m_inside;   // all points of this cycle are within the true borders
  vpTwistProjection m_projection;
};

END_VISP_NAMESPACE
#endif
