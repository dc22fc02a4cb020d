/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/planar_target/vpPlanarTargetDatabase.h>

#include "vpPlanarTargetImpl.h"
#include "vpTargetList.h"
#include "vpTargetSearch.h"

#include <visp3/core/vpException.h>

#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

class vpPlanarTargetDatabase::Store
{
public:
  Store(const vpCameraParameters &camera, const vpPlanarTargetSpec &spec)
    : m_camera(camera), m_spec(spec), m_frame(spec.maxKeypoints, camera.get_px() / camera.get_py())
  {}

  vpCameraParameters m_camera;
  vpPlanarTargetSpec m_spec;
  vpTargetFrame m_frame; // of all targets
  std::vector<std::unique_ptr<vpPlanarTarget::Impl>> m_targets;
  std::vector<vpPlanarTargetSighting> m_sightings; // one for each target
  vpTargetSearch m_search;
};

vpPlanarTargetDatabase::vpPlanarTargetDatabase(const vpCameraParameters &camera, const vpPlanarTargetSpec &spec)
{
  spec.validate();
  m_store = std::make_unique<Store>(camera, spec);
}

vpPlanarTargetDatabase::~vpPlanarTargetDatabase() = default;
vpPlanarTargetDatabase::vpPlanarTargetDatabase(vpPlanarTargetDatabase &&) noexcept = default;
vpPlanarTargetDatabase &vpPlanarTargetDatabase::operator=(vpPlanarTargetDatabase &&) noexcept = default;

vpPlanarTargetDatabase vpPlanarTargetDatabase::fromFolder(const std::string &folder, const vpCameraParameters &camera,
                                                          const vpPlanarTargetSpec &spec)
{
  vpPlanarTargetDatabase database(camera, spec);
  for (const vpTargetListEntry &entry : readTargetList(folder)) {
    vpImage<unsigned char> reference;
    readReference(entry.file, reference);
    const double height = entry.height.value_or(entry.width * reference.getHeight() / reference.getWidth());
    try {
      database.add(entry.name, reference, entry.width, height, entry.depth);
    }
    catch (const vpException &error) {
      throw vpException(error.getCode(), entry.file + ": " + error.getStringMessage());
    }
  }
  return database;
}

void vpPlanarTargetDatabase::add(const std::string &name, const vpImage<unsigned char> &reference, double width,
                                 double height, double depth)
{
  if (name.empty()) {
    throw vpException(vpException::badValue, "a target of the database has an empty name");
  }
  if (!(depth >= 0.) || !std::isfinite(depth)) {
    throw vpException(vpException::badValue, "target '%s': depth is %g m, must be >= 0", name.c_str(), depth);
  }
  for (const vpPlanarTargetSighting &other : m_store->m_sightings) {
    if (other.name == name) {
      throw vpException(vpException::badValue, "the database has a target '%s' already", name.c_str());
    }
  }
  try {
    m_store->m_targets.push_back(
        std::make_unique<vpPlanarTarget::Impl>(reference, width, height, m_store->m_camera, m_store->m_spec));
  }
  catch (const vpException &error) {
    throw vpException(error.getCode(), "target '" + name + "': " + error.getStringMessage());
  }
  m_store->m_sightings.push_back({name, width, height, depth, {}});
}

std::size_t vpPlanarTargetDatabase::size() const { return m_store->m_targets.size(); }

const std::vector<vpPlanarTargetSighting> &vpPlanarTargetDatabase::process(const vpImage<unsigned char> &image)
{
  std::vector<vpPlanarTarget::Impl *> targets;
  bool refused = false;
  for (const auto &target : m_store->m_targets) {
    refused = target->refuse(image);
    targets.push_back(target.get());
  }
  if (!refused) {
    m_store->m_frame.assign(image);
    m_store->m_search.process(m_store->m_frame, targets);
  }
  for (std::size_t i = 0; i < targets.size(); ++i) {
    m_store->m_sightings[i].result = targets[i]->m_result;
  }
  return m_store->m_sightings;
}

const std::vector<vpPlanarTargetSighting> &vpPlanarTargetDatabase::sightings() const { return m_store->m_sightings; }

const vpPlanarTargetEffort &vpPlanarTargetDatabase::effort() const { return m_store->m_search.effort(); }

void vpPlanarTargetDatabase::predict(std::size_t i, const vpHomogeneousMatrix &cMo)
{
  for (unsigned int k = 0; k < 12; ++k) {
    if (!std::isfinite(cMo.data[k])) {
      return;
    }
  }
  // The results of the last frame are not modified; the pose for tracking is the target's own.
  if (i < m_store->m_targets.size() && m_store->m_targets[i]->m_known) {
    m_store->m_targets[i]->m_result.cMo = cMo;
  }
}

void vpPlanarTargetDatabase::reset()
{
  m_store->m_search = vpTargetSearch();
  for (std::size_t i = 0; i < m_store->m_targets.size(); ++i) {
    m_store->m_targets[i]->reset();
    m_store->m_sightings[i].result = vpPlanarTargetResult();
  }
}

END_VISP_NAMESPACE
