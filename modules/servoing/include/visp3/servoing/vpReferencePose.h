/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReferencePose.h
 * \brief Pose of the camera relative to one reference image of a plane of unknown size, and the plane's distance.
 */
#ifndef vpReferencePose_h
#define vpReferencePose_h

#include <visp3/direct_core/vpField.h>
#include <visp3/servoing/vpServoTarget.h>
#include <visp3/servoing/vpServoVision.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_servoing
//! \brief Parameters of a vpReferencePose.
struct VISP_EXPORT vpReferencePoseSpec {
  double nearest = 0.1;  //!< Smallest distance d that the reference camera may have from the plane, m, > 0, <= 1000.
  double farthest = 2.;  //!< Largest distance, at least nearest, m, > 0, <= 1000.
  double caution = 2.;   //!< Number of standard deviations of 1/d by which the scale is on the near side, 0..10.
  double tilt = 0.6;     //!< Standard deviation of the plane's tilt against the reference image, rad, > 0, <= 10.
  double slowness = 0.3; //!< Factor on the speed while two planes explain the images, > 0, <= 1.
  unsigned int minPoints = 8; //!< Fewest visible points of an image that is used, 5..1000.

  //! The numbers with their ranges and units.
  [[nodiscard]] static const vpFields<vpReferencePoseSpec> &fields();
  //! \throw vpException (badValue) naming the field and its value.
  void validate() const;
};

//! \ingroup group_servoing
//! \brief What is known from the images so far. All but TooFewPoints and Inconsistent have a pose.
enum class vpReferenceStatus {
  Unique,       //!< One pose.
  Ambiguous,    //!< Two planes explain the images so far; the more likely one is used, slowly.
  PureRotation, //!< The camera has only turned: the plane's normal and distance are not known yet, and do not matter.
  TooFewPoints, //!< The image shows fewer points than needed.
  NoOdometry,   //!< The pose of the camera at capture is missing or not finite, but was known before.
  Inconsistent, //!< No motion in front of a plane explains the image; three such images restart the estimation.
  NoImage       //!< No image was given yet.
};

//! \ingroup group_servoing
//! \brief Status as a word ("Unique"), static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpReferenceStatus status);

//! \ingroup group_servoing
//! \brief Result of one image; r is the reference camera, c the current one.
struct VISP_EXPORT vpReferencePoseResult {
  vpReferenceStatus status = vpReferenceStatus::NoImage; //!< Status of the image.
  std::string message = "No image was given yet.";       //!< One sentence for users.
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();       //!< Orientation rRc of the current camera.
  Eigen::Vector3d tau = Eigen::Vector3d::Zero(); //!< Its position rtc / d, d the distance of the plane from r; no unit.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); //!< Unit normal of the plane in r, away from the camera.
  double distance = 0.;                              //!< Estimate of d, m; within the stated range.
  double distanceSigma = 0.;                         //!< Standard deviation of #distance, m.
  double scale = 0.; //!< Distance with which measurements and goals are scaled, m; see vpReferencePoseSpec::caution.
  double speedFactor = 1.;     //!< Factor on the speed limits, (0, 1].
  double misfit = 0.;          //!< Mean square of the residuals of all images over their variance; about 1.
  unsigned int hypotheses = 0; //!< Number of planes that explain the images so far.
  unsigned int images = 0;     //!< Number of images in use, at most 32.
  //! Covariance of (tau, rotation vector), R_true = R exp(rotation vector), row-major; no unit, rad.
  std::array<double, 36> covariance{};

  //! True if there is a pose.
  [[nodiscard]] bool found() const
  {
    return status == vpReferenceStatus::Unique || status == vpReferenceStatus::Ambiguous ||
           status == vpReferenceStatus::PureRotation;
  }
};

/*!
 * \class vpReferencePose
 * \ingroup group_servoing
 * \brief Estimates R, t/d, the plane and its distance d from points matched with one reference image, and from
 * odometry.
 *
 * A homography H = R^T (I - tau n^T) of two images gives the rotation, the translation tau = t/d in units of the
 * plane's distance, and its normal n (thesis 4.3); two planes explain it equally well, and d remains unknown. Where the
 * camera's pose in the base of the robot is known at each capture, the robot's motion gives d, and further images
 * decide on the plane: up to 24 key images and the last 8 share one camera pose, one n and one 1/d, found by least
 * squares (bundle adjustment of a plane with the reference points' noise as unknowns). All planes that the images do
 * not refute are continued; one is dropped when it is e^15 times less likely than the best.
 *
 * Until d is known, measurements and goals are scaled with a distance d_hat from the stated range. A wrong scale d_hat
 * = rho d makes a servo law slower or faster, not inexact: stable for 0 < rho < 2 with any delay that is bridged by
 * odometry. A range so narrow that it contains one distance makes this the estimator for a plane of known distance.
 *
 * Without odometry each image is evaluated by itself, except for the normal; d stays unknown, and the message says so.
 *
 * \code
 * std::vector<Eigen::Vector2d> corners; // in the reference image, normalised: by vpPlaneTracker, say
 * std::vector<vpServoPoint> points;     // the same corners now
 * for (int i = 0; i < 25; ++i) {
 *   corners.emplace_back(0.1 * (i % 5) - 0.2, 0.1 * (i / 5) - 0.2);
 *   points.push_back({0.8 * corners.back().x() + 0.05, 0.8 * corners.back().y()});
 * }
 * vpReferencePose estimate(corners, 0.1 / 800.); // 0.1 px, focal length 800 px
 * vpArmData data;
 * vpArmKinematics::update(arm, q, data); // when the image was taken
 * const vpRigidTransform fMc = vpArmKinematics::camera(arm, data);
 * const vpReferencePoseResult &found = estimate.add(points, 0.1 / 800., &fMc); // each image
 * if (found.found()) {
 *   std::cout << "plane at " << found.distance << " +- " << found.distanceSigma << " m, camera at "
 *             << found.tau.transpose() << " of that" << std::endl;
 * }
 * else {
 *   std::cerr << found.message << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpReferencePose
{
public:
  /*!
   * \param reference : Points of the plane in the reference image, normalised.
   * \param sigma : Standard deviation of their coordinates, normalised, > 0.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue) naming the field, a point that is not finite, sigma, or too few points.
   */
  vpReferencePose(const std::vector<Eigen::Vector2d> &reference, double sigma, const vpReferencePoseSpec &spec = {});
  ~vpReferencePose();
  vpReferencePose(vpReferencePose &&) noexcept;            //!< Moves.
  vpReferencePose &operator=(vpReferencePose &&) noexcept; //!< Moves.

  /*!
   * Adds an image.
   * \param points : The reference points in the current image; vpServoPoint::Z is ignored. Points that are not finite
   *   count as not visible.
   * \param sigma : Standard deviation of their coordinates, normalised, > 0.
   * \param fMc : Camera at capture in a frame at rest with the plane, usually the robot's base; nullptr: unknown. The
   *   first image with it discards all before; from then on images without it are not used, until reset().
   * \throw vpException (badValue) when the number of points is not that of the reference, or sigma is not positive.
   */
  const vpReferencePoseResult &add(const std::vector<vpServoPoint> &points, double sigma, const vpRigidTransform *fMc);
  /*!
   * States what is known of the plane's normal, instead of the optical axis and vpReferencePoseSpec::tilt. Forgets all
   * images.
   * \param normal : Normal in the reference camera, away from it, any length. \param sigma : Standard deviation of its
   *   angles, rad, > 0.
   * \throw vpException (badValue) for a vector of length 0, or a sigma that is not positive.
   */
  void setNormalPrior(const Eigen::Vector3d &normal, double sigma);
  //! Forgets all images.
  void reset();
  //! The last result.
  [[nodiscard]] const vpReferencePoseResult &result() const;
  /*!
   * The reference points as an object, scaled by vpReferencePoseResult::scale: those that were visible in at least half
   * as many images as the most frequent one. The origin is their mean, the axes are those of the reference camera, the
   * outline is the rectangle around them in the reference image.
   */
  [[nodiscard]] vpServoTarget target() const;
  /*!
   * The last result as a measurement of target(), and the pose of the reference image as the goal, both with the same
   * scale.
   * \param time : Time of capture, s. \param sight : All of its fields are set; the measurement is invalid without a
   *   pose.
   */
  void sight(double time, vpServoSight &sight) const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
