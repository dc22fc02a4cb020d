/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypoints.h"

#include <dlib/image_keypoint.h>
#include <dlib/opencv/cv_image.h>

BEGIN_VISP_NAMESPACE

namespace
{
// dlib's own default of 30 keeps only blobs of high contrast; 10 gives about as many keypoints as the other detectors.
constexpr double detectionThreshold = 10.;

class SurfExtractor : public vpKeypointExtractor
{
public:
  explicit SurfExtractor(unsigned int maxKeypoints) : m_maxKeypoints(maxKeypoints) {}

  void extract(const cv::Mat &image, vpKeypointSet &keypoints) override
  {
    const dlib::cv_image<unsigned char> view(image);
    const std::vector<dlib::surf_point> found = dlib::get_surf_points(view, m_maxKeypoints, detectionThreshold);
    keypoints.points.resize(found.size());
    keypoints.descriptors.create(static_cast<int>(found.size()), 64, CV_32F);
    for (std::size_t i = 0; i < found.size(); ++i) {
      keypoints.points[i] =
          cv::Point2f(static_cast<float>(found[i].p.center.x()), static_cast<float>(found[i].p.center.y()));
      float *row = keypoints.descriptors.ptr<float>(static_cast<int>(i));
      for (long k = 0; k < 64; ++k) {
        row[k] = static_cast<float>(found[i].des(k));
      }
    }
  }

private:
  long m_maxKeypoints;
};
} // namespace

std::unique_ptr<vpKeypointExtractor> makeSurfExtractor(unsigned int maxKeypoints)
{
  return std::make_unique<SurfExtractor>(maxKeypoints);
}

END_VISP_NAMESPACE
