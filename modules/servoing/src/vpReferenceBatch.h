/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReferenceBatch.h
 * \brief Internal: least squares over all images of a plane that are linked by odometry.
 */
#ifndef vpReferenceBatch_h
#define vpReferenceBatch_h

#include <visp3/manipulator/vpArmTypes.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

BEGIN_VISP_NAMESPACE

//! One image: the reference points that it shows.
struct vpReferenceView {
  std::vector<Eigen::Vector2d> points; //!< Normalised, in the order of the reference.
  std::vector<char> visible;           //!< False: the point was not found.
  std::size_t count = 0;               //!< Number of visible points.
  double weight = 0.;                  //!< 1 / sigma^2 of a coordinate.
  vpRigidTransform fMc;                //!< Camera at capture in the odometry frame, m.
  bool key = false;                    //!< True: kept for the distance from which it shows the plane.
};

//! What the images may mean: camera and plane in the reference camera, lengths in units of the plane's distance d.
struct vpReferenceHypothesis {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();   //!< Orientation of the last view's camera.
  Eigen::Vector3d tau = Eigen::Vector3d::Zero();     //!< Its position, d.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); //!< Unit normal of the plane, away from the camera.
  double alpha = 1.;                                 //!< 1 / d, 1/m.
  std::vector<Eigen::Vector2d> noise;                //!< Error of each reference point, normalised.

  double cost = 0.;     //!< Twice the negative log-likelihood.
  double lastCost = 0.; //!< Part of the last view's points.
  //! Covariance of (tau, right rotation of R, normal in tangent(normal), alpha).
  Eigen::Matrix<double, 9, 9> covariance = Eigen::Matrix<double, 9, 9>::Zero();
};

//! Gaussian knowledge before the images.
struct vpReferencePrior {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();               //!< Expected normal.
  Eigen::Matrix2d normalInformation = Eigen::Matrix2d::Identity(); //!< Of the angles in tangent(normal), 1/rad^2.
  double alpha = 1.;                                               //!< Expected 1 / d, 1/m.
  double alphaWeight = 1.;                                         //!< 1 / variance of it, m^2.
};

/*!
 * Levenberg's method for one camera pose, plane normal and alpha from all views. The camera of view k is at R Ro_k,
 * tau + alpha R po_k, (Ro_k, po_k) its odometry relative to the last view: nine unknowns, however many views. The
 * reference points have noise, too; its two unknowns a point are eliminated by the Schur complement.
 *
 * All derivatives of a point's image pass through the three of the point in the camera, so a point's views are summed
 * in 3x3 matrices first. The work space grows to the number of points once.
 */
class vpReferenceBatch
{
public:
  //! Two directions across \e normal.
  [[nodiscard]] static Eigen::Matrix<double, 3, 2> tangent(const Eigen::Vector3d &normal);

  //! \param reference : Points of the reference, normalised. \param sigma : Their standard deviation, > 0.
  vpReferenceBatch(const std::vector<Eigen::Vector2d> &reference, double sigma);

  /*!
   * \param views : Images; the last one is the current one. \param h : Start, and result with cost and covariance.
   * \param iterations : Maximum number of steps.
   * \return False if there is no solution with all points before all cameras and the plane seen from the front.
   */
  bool refine(const std::vector<vpReferenceView> &views, const vpReferencePrior &prior, vpReferenceHypothesis &h,
              int iterations);

private:
  using Matrix9 = Eigen::Matrix<double, 9, 9>;
  using Vector9 = Eigen::Matrix<double, 9, 1>;
  struct Point { // what remains of a point after its elimination
    Eigen::Matrix2d inverse;
    Eigen::Matrix<double, 9, 2> link;
    Eigen::Vector2d right;
  };
  struct Normal {
    Matrix9 A;
    Vector9 b;
    double cost = 0., lastCost = 0.;
    double noiseGain = 0.; // decrease of the cost by the best noise of the reference points
    std::vector<Point> points;
  };
  struct Camera {
    Eigen::Matrix3d R; // of the view in the last one
    Eigen::Vector3d p;
  };
  bool linearise(const vpReferenceHypothesis &h, const vpReferencePrior &prior, Normal &normal) const;
  bool addPoint(std::size_t i, const vpReferenceHypothesis &h, const Eigen::Matrix<double, 3, 2> &B,
                Normal &normal) const;
  void move(const Normal &normal, const Vector9 &step, vpReferenceHypothesis &h) const;

  const std::vector<Eigen::Vector2d> &m_reference;
  double m_weight; // 1 / sigma^2 of the reference points
  const std::vector<vpReferenceView> *m_views = nullptr;
  std::vector<Camera> m_cameras;
  Normal m_now, m_next;
};

END_VISP_NAMESPACE
#endif
