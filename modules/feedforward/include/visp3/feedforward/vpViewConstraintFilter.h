/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpViewConstraintFilter.h
 * \brief Keeps the target in the image: the least change of a camera twist that does not let it leave.
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
struct VISP_EXPORT vpViewConstraintConfig {
  double left = -0.4;      //!< Left border of the image, normalised (x = X/Z), < 0.
  double right = 0.39875;  //!< Right border, > 0.
  double top = -0.3;       //!< Upper border, < 0.
  double bottom = 0.29875; //!< Lower border, > 0.
  double gamma = 5.;    //!< A point may use up at most this share of its distance to the border per second, 1/s, > 0.
  double period = 0.01; //!< Longest time for which a twist is executed before the next one, s, > 0.
  double imageUncertainty = 0.; //!< Bound of the error of the outline's x and y, normalised, >= 0; kept off the border.
  double depthUncertainty = 0.; //!< Bound of the relative error of the outline's depths, 0..0.9.
  double maxLinear = 1.;        //!< Limit of the linear speed, m/s, > 0.
  double maxAngular = 1.5;      //!< Limit of the angular speed, rad/s, > 0.

  /*!
   * The view of a camera. Its image reaches from the centre of the first pixel to that of the last one; distortion is
   * not regarded, so with a distorting lens give the undistorted camera.
   * \throw vpException (badValue) when the size is 0 or the principal point is not inside the image.
   */
  [[nodiscard]] static vpViewConstraintConfig fromCamera(const vpCameraParameters &camera, unsigned int width,
                                                         unsigned int height);
  //! \throw vpException (badValue) naming the field and its value when one is out of its range or not finite.
  void validate() const;
};

/*!
 * \class vpViewConstraintFilter
 * \ingroup group_feedforward
 * \brief Filter behind any servo law: the twist nearest to the wanted one that keeps every outline point in the view.
 *
 * For each outline point and each of the four borders, with b the distance to the border, h = b - m the distance to a
 * line a margin m inside of it, and L the row of the point's interaction matrix, it asks L v >= -gamma h (a control
 * barrier function: near the border the point slows down exponentially) and solves
 * min |v - v0|^2, speeds in units of #vpViewConstraintConfig::maxLinear and #vpViewConstraintConfig::maxAngular.
 *
 * **Limits.** v0 is first scaled, as a whole, to the speed limits, and the solution is scaled back to the speed of v0,
 * s = max(|v| / maxLinear, |w| / maxAngular). One factor for all six components: a twist that satisfies L v >= -gamma h
 * with h >= 0 does so at every smaller speed too, while clipping by axis would break it.
 *
 * **The margin** makes up for the discrete time. During one period T a constant twist (v, w), a point at
 * m = (x, y, 1) and depth Z has, with q = P'/Z = -v/Z - w x m, x'' = (1, 0, -x) . (-w x q) - 2 q_z x'. With speeds
 * |v| <= V, |w| <= W, view radius rho, rho1 = sqrt(1 + rho^2), and zeta the least depth within the period, this gives
 * |x'' + 2 q_z x'| <= C = rho1 W (V/zeta + W rho1) and |q_z| <= kappa = V/zeta + W rho, hence for t <= T
 * b(t) >= b - x'(0) t - C t^2 exp(2 kappa T) / 2 with x'(0) the outward speed, up to exp(+-2 kappa T).
 * With m = C T exp(4 kappa T) / gamma, b >= 0 gives b(t) >= 0 in both cases: h >= 0, where x'(0) <= gamma h; and h < 0,
 * where the point must move inwards with at least gamma |h| times the factor of the scaling above, if that is 1/2 or
 * more. If it is less, the filter stands still. So the *true border is never crossed* by an ideal camera, whatever the
 * wanted twist. V and W are the speeds asked for in this very step, so the margin vanishes (with the square of the
 * speed) towards the goal and takes nothing of the view from it.
 *
 * **Zero twist** is feasible while all h >= 0. A point with h < 0, in the margin or outside the image, has to move
 * inwards (backing away does it for all points, the principal point being in the view); scaled to the speed of v0, so
 * without any wanted motion it stays where it is. If the rows contradict each other the result is zero.
 *
 * **Deadlock** is possible: the nearest twist may be zero although the goal is not reached. It is reported
 * (vpServoStatus::Deadlock) when less than 2 % of the wanted speed is left.
 *
 * **Uncertain depth:** rows hold at both ends of the interval of depths; they are linear in 1/Z, so between them too.
 */
class VISP_EXPORT vpViewConstraintFilter
{
public:
  //! Largest number of visible outline points: two rows for each border at most.
  static constexpr int maxPoints = vpTwistProjection::capacity / 8;

  //! \throw vpException (badValue) naming the field and its value.
  explicit vpViewConstraintFilter(const vpViewConstraintConfig &config = {});

  //! The parameters in force.
  [[nodiscard]] const vpViewConstraintConfig &config() const { return m_config; }

  /*!
   * One cycle.
   * \param wanted : The law's answer. Any status but Servoing passes through unchanged.
   * \param outline : Points to keep in the view, as seen now; those not visible are left out. None: only the speed
   *   limits apply.
   * \param dt : Time for which the twist will be executed, s; the period of the configuration is used when longer.
   * \return Servoing with the same twist, ViewLimited with a changed one, Deadlock, or InvalidInput with zero twist
   *   when a visible point is not finite, has a depth <= 0, or more than #maxPoints are visible.
   */
  [[nodiscard]] vpServoCommand filter(const vpServoCommand &wanted, const std::vector<vpServoPoint> &outline,
                                      double dt) noexcept;

  /*!
   * The margin m, normalised, that a point at depth \e Z is kept off the border by.
   * \param Z : Depth, m, > 0. \param linear, angular : Speed, m/s and rad/s. \param period : s, > 0.
   */
  [[nodiscard]] double margin(double Z, double linear, double angular, double period) const noexcept;

private:
  bool addRows(const vpServoPoint &point, double linear, double angular, double period) noexcept;

  vpViewConstraintConfig m_config;
  double m_radius; // of the view's farthest corner, normalised
  bool m_inside;   // all points of this cycle are within the true borders
  vpTwistProjection m_projection;
};

END_VISP_NAMESPACE
#endif
