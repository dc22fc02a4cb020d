/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/rendering/vpPlaneRenderer.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpUniRand.h>

#include "vpCameraFaultModel.h"
#include "vpPhotoPatch.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// An elliptic patch fixed to the object. Coordinates are fractions of the object's size, the origin is its centre.
struct Occluder {
  double x, y, cosine, sine, stretch, phase;

  explicit Occluder(unsigned int seed)
  {
    vpUniRand random(seed, 7);
    x = random.uniform(-0.4, 0.4);
    y = random.uniform(-0.4, 0.4);
    const double direction = random.uniform(0., M_PI);
    cosine = std::cos(direction);
    sine = std::sin(direction);
    stretch = random.uniform(1., 2.);
    phase = random.uniform(0., 2. * M_PI);
  }
  // Size at which the patch reaches this point.
  double reach(double px, double py) const
  {
    const double along = cosine * (px - x) + sine * (py - y), across = cosine * (py - y) - sine * (px - x);
    return along * along + stretch * across * across;
  }
  unsigned char grey(double px, double py) const
  {
    return static_cast<unsigned char>(110. + 40. * std::sin(60. * px + phase) * std::sin(50. * py) +
                                      40. * std::sin(23. * (px + py) + phase));
  }
};
} // namespace

class vpPlaneRenderer::Impl
{
public:
  Impl(const vpImage<unsigned char> &photo, double objectWidth, double objectHeight, const vpCameraParameters &camera,
       unsigned int width, unsigned int height)
    : m_photo(photo, objectWidth, objectHeight), m_camera(camera), m_objectWidth(objectWidth),
      m_objectHeight(objectHeight), m_background(vpFaintWall(width, height))
  {}

  void render(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
              vpImage<unsigned char> &image)
  {
    faults.validate();
    image = m_background;
    m_covered.clear();
    drawObject(cMo, image);
    if (faults.occlusion > 0.) {
      drawOccluder(cMo, faults, image);
    }
    m_faults.apply(faults, seed, image);
  }

private:
  struct Pixel {
    unsigned int row, column;
    double x, y;  // in the object, fractions of its size
    double reach; // of the occluder
  };

  void drawObject(const vpHomogeneousMatrix &cMo, vpImage<unsigned char> &image)
  {
    m_photo.draw(cMo, m_camera, image.getWidth(), image.getHeight(), [&](int r, int c, int sum, int samples) {
      image[r][c] = static_cast<unsigned char>((sum + (4 - samples) * m_background[r][c] + 2) / 4);
      if (samples > 1) {
        m_covered.push_back({static_cast<unsigned int>(r), static_cast<unsigned int>(c), 0., 0., 0.});
      }
    });
  }

  // The patch grows until it hides the required fraction of the object's pixels.
  void drawOccluder(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, vpImage<unsigned char> &image)
  {
    if (m_covered.empty()) {
      return;
    }
    const Occluder occluder(faults.occluder);
    // From pixels to the object's plane.
    Eigen::Matrix3d K, H;
    K << m_camera.get_px(), 0., m_camera.get_u0(), 0., m_camera.get_py(), m_camera.get_v0(), 0., 0., 1.;
    for (unsigned int r = 0; r < 3; ++r) {
      H.row(r) << cMo[r][0] * m_objectWidth, cMo[r][1] * m_objectHeight, cMo[r][3];
    }
    const Eigen::Matrix3d toObject = (K * H).inverse();
    for (Pixel &p : m_covered) {
      const Eigen::Vector3d q = toObject * Eigen::Vector3d(p.column, p.row, 1.);
      p.x = q.x() / q.z();
      p.y = q.y() / q.z();
      p.reach = occluder.reach(p.x, p.y);
    }
    const auto hidden = static_cast<std::ptrdiff_t>(std::lround(faults.occlusion * m_covered.size()));
    const auto end = m_covered.begin() + std::min<std::ptrdiff_t>(hidden, m_covered.size());
    std::nth_element(m_covered.begin(), end, m_covered.end(),
                     [](const Pixel &a, const Pixel &b) { return a.reach < b.reach; });
    for (auto p = m_covered.begin(); p != end; ++p) {
      image[p->row][p->column] = occluder.grey(p->x, p->y);
    }
  }

  vpPhotoPatch m_photo;
  vpCameraParameters m_camera;
  double m_objectWidth, m_objectHeight;
  vpImage<unsigned char> m_background;
  std::vector<Pixel> m_covered; // pixels at least half covered by the object
  vpCameraFaultModel m_faults;
};

vpPlaneRenderer::vpPlaneRenderer(const vpImage<unsigned char> &photo, double objectWidth, double objectHeight,
                                 const vpCameraParameters &camera, unsigned int width, unsigned int height)
{
  if (photo.getWidth() < 8 || photo.getHeight() < 8) {
    throw vpException(vpException::badValue, "photo is %ux%u px, must be at least 8x8 px", photo.getWidth(),
                      photo.getHeight());
  }
  if (!(objectWidth > 0.) || !(objectHeight > 0.) || !std::isfinite(objectWidth) || !std::isfinite(objectHeight)) {
    throw vpException(vpException::badValue, "the object's size is %g x %g m, must be > 0 and finite", objectWidth,
                      objectHeight);
  }
  if (camera.get_projModel() != vpCameraParameters::perspectiveProjWithoutDistortion) {
    throw vpException(vpException::badValue, "camera of the renderer has a distortion model, must have none");
  }
  if (width < 8 || height < 8) {
    throw vpException(vpException::badValue, "image size is %ux%u px, must be at least 8x8 px", width, height);
  }
  m_impl = std::make_unique<Impl>(photo, objectWidth, objectHeight, camera, width, height);
}

vpPlaneRenderer::~vpPlaneRenderer() = default;
vpPlaneRenderer::vpPlaneRenderer(vpPlaneRenderer &&) noexcept = default;
vpPlaneRenderer &vpPlaneRenderer::operator=(vpPlaneRenderer &&) noexcept = default;

void vpPlaneRenderer::render(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
                             vpImage<unsigned char> &image)
{
  m_impl->render(cMo, faults, seed, image);
}

END_VISP_NAMESPACE
