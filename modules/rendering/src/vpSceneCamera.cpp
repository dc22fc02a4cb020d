/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/rendering/vpSceneCamera.h>

#include "vpFieldCheck.h"
#include "vpCameraFaultModel.h"
#include "vpHashRandom.h"
#include "vpPhotoPatch.h"
#include "vpSceneRaster.h"

#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double sizeTolerance = 1e-9; // m

void check(const vpSceneCameraSpec &spec)
{
  const auto fail = [](const std::string &sentence) { throw vpException(vpException::badValue, sentence); };
  if (spec.camera.get_projModel() != vpCameraParameters::perspectiveProjWithoutDistortion) {
    fail("camera of the scene has a distortion model, must have none");
  }
  if (!(spec.camera.get_px() > 0.) || !(spec.camera.get_py() > 0.)) {
    fail("camera of the scene has no focal length");
  }
  if (spec.width < 8 || spec.height < 8) {
    fail("picture of the scene is " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
         " px, must be at least 8x8 px");
  }
  for (std::size_t i = 0; i < spec.photos.size(); ++i) {
    const vpScenePhoto &photo = spec.photos[i];
    if (photo.image.getWidth() < 8 || photo.image.getHeight() < 8) {
      fail("photograph of object " + photo.object + " is below 8x8 px");
    }
    if (!(photo.size.array() > 0.).all() || !photo.size.allFinite()) {
      fail("photograph of object " + photo.object + " has no size");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (spec.photos[k].object == photo.object) {
        fail("object " + photo.object + " has two photographs");
      }
    }
  }
}
} // namespace

void vpDepthFaults::validate() const
{
  constexpr vpFieldCheck fields("the depth camera's faults");
  fields.notNegative("noise", noise, "m");
  fields.in("dropout", dropout, {0., 1.});
  fields.positive("maxDepth", maxDepth, "m");
}

class vpSceneCamera::Impl
{
public:
  explicit Impl(const vpSceneCameraSpec &spec)
    : m_spec(spec), m_wall(vpFaintWall(spec.width, spec.height)), m_raster(spec.camera, spec.width, spec.height)
  {
    for (const vpScenePhoto &photo : spec.photos) {
      m_patches.emplace_back(photo.image, photo.size.x(), photo.size.y());
    }
  }

  void picture(const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpCameraFaults &faults,
               unsigned int seed, vpImage<unsigned char> &image)
  {
    faults.validate();
    image = m_wall;
    m_raster.draw(scene, fMc, &image);
    for (std::size_t i = 0; i < m_patches.size(); ++i) {
      const int k = scene.find(m_spec.photos[i].object);
      if (k >= 0) {
        drawPhoto(m_spec.photos[i], m_patches[i], scene.object(k), fMc.inverse(), image);
      }
    }
    m_faults.apply(faults, seed, image);
  }

  void depth(const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpDepthFaults &faults, unsigned int seed,
             vpImage<float> &image)
  {
    faults.validate();
    m_raster.draw(scene, fMc, nullptr);
    image = m_raster.depth();
    const vpNormalQuantiles &normal = vpNormalQuantiles::get();
    const float noise = static_cast<float>(faults.noise), most = static_cast<float>(faults.maxDepth);
    const bool isIdeal = faults.noise == 0. && faults.dropout == 0.;
    for (unsigned int r = 0; r < image.getHeight(); ++r) {
      vpHashRandom random(seed, vpHashRandom::Purpose::Noise, r, 0);
      for (unsigned int c = 0; c < image.getWidth(); ++c) {
        float &z = image[r][c];
        z = z <= most ? z : 0.F;
        if (isIdeal || !(z > 0.F)) {
          continue;
        }
        const std::uint64_t bits = random.bits();
        z += noise * z * z * normal[static_cast<std::uint16_t>(bits)];
        z = z > 0.F && static_cast<double>(bits >> 32) * 0x1p-32 >= faults.dropout ? z : 0.F;
      }
    }
  }

  vpSceneCameraSpec m_spec;

private:
  // Overwrites the raster where nothing is in front of the face.
  void drawPhoto(const vpScenePhoto &photo, vpPhotoPatch &patch, const vpCollisionObject &object,
                 const vpRigidTransform &cMf, vpImage<unsigned char> &image)
  {
    const Eigen::Vector3d &size = object.shape.size();
    if (object.shape.type() != vpShapeType::Box || (size.head<2>() - photo.size).norm() > sizeTolerance) {
      throw vpException(vpException::badValue, "object %s is no box of %g x %g m, the size of its photograph",
                        photo.object.c_str(), photo.size.x(), photo.size.y());
    }
    vpRigidTransform cMface = cMf * object.pose;
    cMface.p -= 0.5 * size.z() * cMface.R.col(2);
    const Eigen::Vector3d normal = cMface.R.col(2);
    const double offset = normal.dot(cMface.p);
    const vpImage<float> &depth = m_raster.depth();
    patch.draw(cMface.toHomogeneous(), m_spec.camera, m_spec.width, m_spec.height,
               [&](int r, int c, int sum, int samples) {
                 // Rounding of floats, and a pixel's centre that just misses the face.
                 constexpr double slack = 1.001;
                 const double z = offset / normal.dot(m_raster.ray(c, r));
                 if (z <= slack * static_cast<double>(depth[r][c])) {
                   image[r][c] = static_cast<unsigned char>((sum + (4 - samples) * image[r][c] + 2) / 4);
                 }
               });
  }

  vpImage<unsigned char> m_wall;
  vpSceneRaster m_raster;
  std::vector<vpPhotoPatch> m_patches; // one per photograph
  vpCameraFaultModel m_faults;
};

vpSceneCamera::vpSceneCamera(const vpSceneCameraSpec &spec)
{
  check(spec);
  m_impl = std::make_unique<Impl>(spec);
}

vpSceneCamera::~vpSceneCamera() = default;
vpSceneCamera::vpSceneCamera(vpSceneCamera &&) noexcept = default;
vpSceneCamera &vpSceneCamera::operator=(vpSceneCamera &&) noexcept = default;

const vpSceneCameraSpec &vpSceneCamera::spec() const noexcept { return m_impl->m_spec; }

void vpSceneCamera::picture(const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpCameraFaults &faults,
                            unsigned int seed, vpImage<unsigned char> &image)
{
  m_impl->picture(scene, fMc, faults, seed, image);
}

void vpSceneCamera::depth(const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpDepthFaults &faults,
                          unsigned int seed, vpImage<float> &image)
{
  m_impl->depth(scene, fMc, faults, seed, image);
}

END_VISP_NAMESPACE
