/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPixelRefiner.h
 * \brief Internal: the last stage of a pose, on the frame's own pixels, with its covariance.
 */
#ifndef vpPixelRefiner_h
#define vpPixelRefiner_h

#include "vpGreyMedian.h"
#include "vpTargetPrediction.h"

BEGIN_VISP_NAMESPACE

//! Camera model of the target's grey values: gain * value + bias, blurred.
struct vpCameraState {
  double gain = 1., bias = 0.;
  double blur = 0.7; //!< standard deviation of a Gaussian, px
};

//! A pose estimated from the frame's pixels.
struct vpPixelFit {
  bool converged = false; //!< otherwise nothing else is valid
  vpRigidPose pose;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero(); //!< of (v, w), see vpPoseCovariance
  double sigma = 0.;                                                            //!< of a pixel, grey levels
  double kappa = 1.;    //!< covariance factor for correlated errors; > 1: the model is incomplete
  double hidden = 0.;   //!< occluded fraction of the target's pixels in the frame
  double residual = 0.; //!< root mean square over the unoccluded pixels, grey levels
  vpCameraState camera;
};

/*!
 * Minimises sum rho(I(u) - g T(u; pose, blur) - b) over the pixels u of the frame, where (and only where) the noise is
 * white. Six parameters of the pose, three of the camera (gain, bias, blur). rho is Tukey's with a bound that grows
 * with the slope of T; in addition, whole areas that do not fit are masked, because a single pixel of an occluder may
 * have a likely grey value.
 *
 * The derivative of T with respect to the pose is its gradient times the motion of the pixels, which changes slowly: it
 * is constant in blocks of 8x8 pixels, so that an iteration needs 20 sums per block. T is predicted again when the pose
 * has moved by more than a tenth of a pixel, and linear within; of a large target first in a third of the blocks only.
 *
 * The covariance is A^-1 B A^-1 with A = sum psi' J J^T and B = sum psi^2 J J^T, times kappa = max(1, tr(C^-1
 * C_S) / 6), where C_S uses for B the squares of the sums of whole blocks, which include errors correlated between
 * neighbours.
 */
class vpPixelRefiner
{
public:
  //! \e texture must outlive this object.
  vpPixelRefiner(const vpTargetTexture &texture, const vpTargetPlane &plane, const vpPinhole &camera)
    : m_texture(texture), m_plane(plane), m_camera(camera), m_prediction(plane)
  {}

  /*!
   * \param image : CV_8UC1 frame. \param pose : Start, within about a pixel.
   * \param start : Initial camera parameters, where known.
   */
  const vpPixelFit &refine(const cv::Mat &image, const vpRigidPose &pose, const vpCameraState &start);

  /*!
   * One prediction and its linear steps: gives residuals() close to those of refine(), for comparison; fit() has no
   * pose.
   * \return False when there is no solution.
   */
  bool glance(const cv::Mat &image, const vpRigidPose &pose, const vpCameraState &start);

  [[nodiscard]] const vpPixelFit &fit() const { return m_fit; }
  //! Pixels of the last frame's area, residuals of the last fit; weights are 0 off the target and where it is occluded.
  [[nodiscard]] const cv::Rect &area() const { return m_prediction.area(); }
  [[nodiscard]] const cv::Mat &residuals() const { return m_residuals; } //!< see area()
  [[nodiscard]] const cv::Mat &open() const { return m_open; }           //!< see area()
  //! Distance of \e other from the fit in standard deviations of the pixels, after the fit's other parameters are
  //! adapted.
  [[nodiscard]] double distance(const vpRigidPose &other);

private:
  using Params = Eigen::Matrix<double, 9, 1>; // v, w, gain, bias, half the square of the blur
  using Normal = Eigen::Matrix<double, 9, 9>;
  using Motion = Eigen::Matrix<double, 2, 6>;
  using Kind = vpGreyWeights::Kind;

  void begin(const cv::Mat &image, const vpRigidPose &pose, const vpCameraState &start);
  bool predict(const cv::Mat &image, bool sparse = false);
  void makeBlocks();
  void takeFrame(const cv::Mat &image, const cv::Rect &area);
  void updateResiduals();
  double scale();
  [[nodiscard]] vpGreyPixels planes() const;
  void sumBlocks(Kind kind);
  void assemble(Kind kind, Normal &N, Params &right);
  bool descend();
  bool step(double &length);
  double largestMove() const;
  bool isLinear() const;
  double blurred(double change) const;
  void adopt();
  bool maskHidden();
  Normal patchScores();
  int judgeResiduals();
  void conclude();

  const vpTargetTexture &m_texture;
  vpTargetPlane m_plane;
  vpPinhole m_camera;
  vpTargetPrediction m_prediction;
  vpPixelFit m_fit;
  Params m_change = Params::Zero(); // since the last prediction
  double m_way = 0.;                // length of m_change, deviations of the pose
  double m_slope = 0.;              // px; possible error of the prediction that is not an occlusion
  int m_bin = 1;
  bool m_large = false; // the target in the frame
  vpPinhole m_binned;   // camera of the frame after binning
  cv::Size m_frameSize; // likewise
  cv::Mat m_frame, m_residuals, m_open, m_hidden, m_misfit, m_mean, m_bad;
  const vpGreyLanes &m_loops = vpChosenGreyLanes();
  std::vector<vpGreyBlock> m_blocks; // on the target, with their motions at the prediction
  std::vector<float> m_sums;         // see sumBlocks()
  vpGreyMedian m_median{64};
};

END_VISP_NAMESPACE
#endif
