/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/planar_target/vpPlanarTargetDatabase.h>

#include "vpJsonObject.h"
#include "vpPictureFile.h"
#include "vpPlanarTargetImpl.h"
#include "vpReading.h"
#include "vpTargetSearch.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
namespace fs = std::filesystem;

// One entry of targets.json in a folder of reference photographs.
struct TargetListEntry {
  std::string name;
  std::string file; //!< including the folder
  double width;     //!< m
  std::optional<double> height;
  double depth = 0.; //!< m; 0: not given
};

[[noreturn]] void fail(const std::string &file, const std::string &sentence)
{
  throw vpException(vpException::badValue, file + ": " + sentence);
}

double length(vpJsonObject &entry, const char *field)
{
  const double value = entry.number(field);
  if (!(value > 0.)) {
    throw entry.wrong(field, value, "a number > 0");
  }
  return value;
}

std::string text(vpJsonObject &entry, const char *field)
{
  std::string value = entry.text(field);
  if (value.empty()) {
    throw entry.wrong(field, value, "a text");
  }
  return value;
}

void requireAllListed(const std::string &folder, const std::vector<TargetListEntry> &entries)
{
  std::set<std::string> listed;
  for (const TargetListEntry &entry : entries) {
    listed.insert(fs::path(entry.file).filename().string());
  }
  std::error_code error;
  for (fs::directory_iterator item(folder, error), end; !error && item != end; item.increment(error)) {
    const std::string name = item->path().filename().string();
    if (name[0] != '.' && vpPictures::isImageName(name) && listed.count(name) == 0) {
      fail(folder + "/targets.json", "does not list the photograph " + name + " of its folder");
    }
  }
  if (error) {
    throw vpFileError(folder + ": cannot be read (" + error.message() + ")", vpFileError::Kind::Unreadable);
  }
}

std::vector<TargetListEntry> read(const std::string &folder)
{
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw vpException(vpException::ioError, folder + ": is not a folder");
  }
  const std::string file = folder + "/targets.json";
  const nlohmann::json content = vpReadJson(file);
  vpJsonObject top(content, file);
  std::vector<TargetListEntry> entries;
  for (vpJsonObject &entry : top.objects("targets")) {
    TargetListEntry target{text(entry, "name"), folder + "/" + text(entry, "image"), length(entry, "width_m"),
                           std::nullopt, 0.};
    if (entry.has("height_m")) {
      target.height = length(entry, "height_m");
    }
    if (entry.has("depth_m")) {
      target.depth = length(entry, "depth_m");
    }
    entry.finish();
    entries.push_back(target);
  }
  top.ignore("comment");
  top.finish();
  requireAllListed(folder, entries);
  return entries;
}

//! \throw vpException (ioError, badValue) naming the file, the field and its value, or an unlisted photograph.
std::vector<TargetListEntry> readTargetList(const std::string &folder)
{
  return vpReading([&] { return read(folder); });
}

//! Read a photograph as grey values. \throw vpException (ioError) naming the file.
void readReference(const std::string &file, vpImage<unsigned char> &reference)
{
  cv::Mat image;
  try {
    vpPictures::GreyScale scale;
    image = vpPictures::readGreyPicture(file, scale);
  }
  catch (const std::runtime_error &error) {
    throw vpException(vpException::ioError, error.what());
  }
  reference.resize(static_cast<unsigned int>(image.rows), static_cast<unsigned int>(image.cols));
  for (int row = 0; row < image.rows; ++row) {
    std::memcpy(reference[static_cast<unsigned int>(row)], image.ptr(row), static_cast<std::size_t>(image.cols));
  }
}
} // namespace

class vpPlanarTargetDatabase::Store
{
public:
  Store(const vpCameraParameters &camera, const vpPlanarTargetSpec &spec)
    : m_camera(camera), m_spec(spec), m_frame(spec, camera.get_px() / camera.get_py())
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
  for (const TargetListEntry &entry : readTargetList(folder)) {
    vpImage<unsigned char> reference;
    readReference(entry.file, reference);
    const double height = entry.height.value_or(entry.width * reference.getHeight() / reference.getWidth());
    try {
      database.add(entry.name, reference, entry.width, height, entry.depth);
    }
    catch (const vpException &error) { // the name comes from the file, too
      throw vpException(error.getCode(), vpPrintable(entry.file + ": " + error.getStringMessage()));
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
