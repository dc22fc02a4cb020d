/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypoints.h"

#include <dlib/image_keypoint.h>
#include <dlib/opencv/cv_image.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
// dlib's own: the sampling of the finest octave, and how far from the border a keypoint's surroundings reach, in scales.
constexpr long firstStep = 2;
constexpr double surroundings = 32.;

class SurfExtractor : public vpKeypointExtractor
{
public:
  explicit SurfExtractor(const vpPlanarTargetSpec &spec) : m_spec(spec) {}

  void extract(const cv::Mat &image, vpKeypointSet &keypoints) override
  {
    const dlib::cv_image<unsigned char> view(image);
    const std::vector<dlib::surf_point> found = surfPoints(view);
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
  // dlib::get_surf_points() with octaves, layers and orientation of choice; the outermost scales only bound maxima.
  [[nodiscard]] std::vector<dlib::surf_point> surfPoints(const dlib::cv_image<unsigned char> &view) const
  {
    dlib::integral_image image;
    image.load(view);
    dlib::hessian_pyramid pyramid;
    pyramid.build_pyramid(image, static_cast<long>(m_spec.surfOctaves), static_cast<long>(m_spec.surfLayers) + 2,
                          firstStep);
    std::vector<dlib::interest_point> strongest;
    dlib::get_interest_points(pyramid, m_spec.surfThreshold, strongest);
    std::sort(strongest.rbegin(), strongest.rend());
    strongest.resize(std::min<std::size_t>(strongest.size(), m_spec.maxKeypoints));
    std::vector<dlib::surf_point> found;
    for (const dlib::interest_point &point : strongest) {
      const auto size = static_cast<unsigned long>(surroundings * point.scale);
      if (dlib::get_rect(image).contains(dlib::centered_rect(point.center, size, size))) {
        dlib::surf_point surf;
        surf.p = point;
        surf.angle = m_spec.surfUpright ? 0. : dlib::compute_dominant_angle(image, point.center, point.scale);
        dlib::compute_surf_descriptor(image, point.center, point.scale, surf.angle, surf.des);
        found.push_back(surf);
      }
    }
    return found;
  }

  vpPlanarTargetSpec m_spec;
};
} // namespace

std::unique_ptr<vpKeypointExtractor> makeSurfExtractor(const vpPlanarTargetSpec &spec)
{
  return std::make_unique<SurfExtractor>(spec);
}

END_VISP_NAMESPACE
