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

#include "vpPhotometry.h"

BEGIN_VISP_NAMESPACE

/*!
 * Minimises sum rho(I(w(p; T)) - g R(p) - b) over the pose T, the gain g and the bias b, with Tukey's rho, R the
 * reference and w the projection of the plane (with the camera's distortion).
 *
 * Inverse compositional: a small motion of the target, t + v and exp(w) R, moves the visible plane as the homography
 * I + A with A = G^-1 ([w]x r1, [w]x r2, v) does, G = (r1, r2, t) of T. So the derivative of a sample is -g J(p) M(T)
 * (v, w), J (1x8) of the reference alone and M (8x6) the same for all samples of an iteration. The 10x10 normal
 * equations of homography, gain and bias are accumulated and then projected on the pose: no gradient of the noisy frame
 * is used (it would bias the estimate), and the result is a pose, not an approximate homography.
 *
 * The work space is allocated by the constructor; refine() and verify() allocate nothing.
 */
class vpPhotometricRefiner
{
public:
  //! \e model must outlive this object. \param precise : False if another stage follows: then the last small steps are
  //! skipped.
  vpPhotometricRefiner(const vpPhotometricModel &model, const vpTargetPlane &plane, const vpPinhole &camera,
                       bool precise);

  /*!
   * Refine \e pose from coarse to fine.
   * \param pyramid : See vpTargetFrame.
   * \param reach : Maximum error of the target's points, px. Determines the coarsest level: a level coarser than needed
   *   is a detour on which an occlusion can mislead.
   * \param maxIterations : Maximum number of iterations over all levels.
   * \return False if it diverged or did not converge; \e pose is undefined then.
   */
  bool refine(const std::vector<cv::Mat> &pyramid, vpRigidPose &pose, double reach, unsigned int maxIterations);

  //! Fit at \e pose on the finest level that the frame resolves.
  vpPhotometricFit verify(const std::vector<cv::Mat> &pyramid, const vpRigidPose &pose);

  //! Gain of the last frame's pyramid.
  [[nodiscard]] double gain() const { return m_photometry.gain(); }
  [[nodiscard]] double bias() const { return m_photometry.bias(); } //!< see gain()

private:
  //! Normal equations: 8 of the homography, gain, bias, and the residual in column 10; padded to whole registers.
  using Design = Eigen::Matrix<double, 12, 12>;

  std::size_t finestUseful(const vpRigidPose &pose) const;
  bool start(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpRigidPose &pose);
  bool descend(const std::vector<cv::Mat> &pyramid, std::size_t index, std::size_t soft, vpRigidPose &pose,
               unsigned int iterations, unsigned int &budget, double &shift);
  bool iterate(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpPhotometricLevel &level,
               vpRigidPose &pose, double &shift, double &sigma);
  Design accumulate(const vpPhotometricLevel &level, double sigma, double shift) const;
  bool matchBlur(std::size_t index);

  const vpPhotometricModel &m_model;
  vpTargetPlane m_plane;
  vpPhotometry m_photometry;
  const vpGreyLanes &m_loops = vpChosenGreyLanes();
  bool m_precise;
  std::size_t m_soft = 1; //!< softness that fitted the last frame
};

END_VISP_NAMESPACE
#endif
