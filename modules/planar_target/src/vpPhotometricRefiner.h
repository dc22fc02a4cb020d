/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPhotometricRefiner.h
 * \brief Internal: Gauss-Newton on the grey values for the pose of a plane.
 */
#ifndef vpPhotometricRefiner_h
#define vpPhotometricRefiner_h

#include "vpPhotometricModel.h"

BEGIN_VISP_NAMESPACE

//! How the grey values of a frame fit the reference at a pose.
struct vpPhotometricFit {
  double correlation = 0.; //!< Normalised correlation over the samples that are seen and not rejected, blockwise zero-mean.
  double inImage = 0.;     //!< Share of the samples that fall into the image.
  double visible = 0.;     //!< Share of the samples that fall into the image and are not rejected.
};

/*!
 * Minimises sum rho(I(w(p; T)) - g R(p) - b) over the pose T, the gain g and the bias b, with Tukey's rho, R the reference
 * and w the projection of the plane (with the camera's distortion).
 *
 * Inverse compositional: a small motion of the target, t + v and exp(w) R, moves the seen plane as the homography
 * I + A with A = G^-1 ([w]x r1, [w]x r2, v) does, G = (r1, r2, t) of T. So the derivative of a sample is
 * -g J(p) M(T) (v, w), J (1x8) of the reference alone and M (8x6) the same for all samples of an iteration. The
 * 10x10 normal equations of homography, gain and bias are accumulated and then projected on the pose: no gradient of the
 * noisy frame enters (it would bias the estimate), and the result is a pose, not a homography that is almost one.
 *
 * The work space is allocated by the constructor; refine() and verify() allocate nothing.
 */
class vpPhotometricRefiner
{
public:
  //! \e model must outlive this object.
  vpPhotometricRefiner(const vpPhotometricModel &model, const vpTargetPlane &plane, const vpPinhole &camera);

  /*!
   * Refine \e pose from coarse to fine.
   * \param pyramid : See vpTargetFrame.
   * \param reach : How far the points of the target may be from their place, px. Decides on the coarsest level: a level
   * coarser than needed is a detour on which an occlusion leads astray.
   * \param maxIterations : Over all levels.
   * \return False if it diverged or did not converge; \e pose is undefined then.
   */
  bool refine(const std::vector<cv::Mat> &pyramid, vpRigidPose &pose, double reach, unsigned int maxIterations);

  //! The fit at \e pose on the finest level that the frame resolves.
  vpPhotometricFit verify(const std::vector<cv::Mat> &pyramid, const vpRigidPose &pose);

private:
  //! Upper triangle of the normal equations: 8 of the homography, gain, bias, and the residual in column 10.
  using Design = Eigen::Matrix<double, 12, 12>;

  double pixelsPerSample(std::size_t level, const vpRigidPose &pose) const;
  std::size_t finestUseful(const vpRigidPose &pose) const;
  std::size_t sample(const std::vector<cv::Mat> &pyramid, std::size_t level, const vpRigidPose &pose);
  bool start(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpRigidPose &pose);
  bool descend(const std::vector<cv::Mat> &pyramid, std::size_t index, std::size_t soft, vpRigidPose &pose,
               unsigned int iterations, unsigned int &budget, double &shift);
  bool iterate(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpPhotometricLevel &level, vpRigidPose &pose,
               double &shift, double &sigma);
  void startPhotometry(const vpPhotometricLevel &level);
  double fitPhotometry(const vpPhotometricLevel &level);
  double residuals(const vpPhotometricLevel &level);
  Design accumulate(const vpPhotometricLevel &level, double sigma, double shift) const;
  bool matchBlur(std::size_t level);
  double median();

  const vpPhotometricModel &m_model;
  vpTargetPlane m_plane;
  vpPinhole m_camera;
  double m_gain = 1., m_bias = 0.; //!< frame = gain * reference + bias
  std::size_t m_soft = 1;          //!< softness that fitted the last frame
  std::vector<float> m_values;     //!< of the frame at each sample, < 0 outside of it
  std::vector<float> m_residuals;  //!< outside: larger than any cut
  std::vector<float> m_scratch;
};

END_VISP_NAMESPACE
#endif
