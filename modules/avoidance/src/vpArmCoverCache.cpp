/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpArmCoverCache.h"

#include "vpFileReplace.h"
#include "vpJsonGeometry.h"
#include "vpReading.h"

#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr const char *comment = "Capsules that enclose the bodies of an arm. They may be edited: they are verified "
                                "when read. Fields: data/robot/README.md";

class Hash
{
public:
  void add(double number) { addBytes(&number, sizeof number); }
  void add(std::int64_t number) { addBytes(&number, sizeof number); }
  void add(const Eigen::Vector3d &v)
  {
    for (int i = 0; i < 3; ++i) {
      add(v(i) + 0.); // -0 is 0
    }
  }
  [[nodiscard]] std::string text() const
  {
    std::array<char, 20> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(m_state));
    return digits.data();
  }

private:
  void addBytes(const void *data, std::size_t size)
  {
    const auto *bytes = static_cast<const unsigned char *>(data);
    for (std::size_t i = 0; i < size; ++i) {
      m_state = (m_state ^ bytes[i]) * 0x100000001b3U;
    }
  }
  std::uint64_t m_state = 0xcbf29ce484222325U;
};

vpArmCapsule capsule(vpJsonObject &object)
{
  vpArmCapsule c;
  c.from = vpJsonVector<3>(object, "from_m");
  c.to = vpJsonVector<3>(object, "to_m");
  c.radius = object.number("radius_m");
  if (!(c.radius > 0.) || !(c.radius <= vpLargestLength)) {
    throw object.wrong("radius_m", object.value("radius_m"), "> 0 and at most 10000 m");
  }
  for (const char *end : {"from_m", "to_m"}) {
    if (!(vpJsonVector<3>(object, end).cwiseAbs().maxCoeff() <= vpLargestLength)) {
      throw object.wrong(end, object.value(end), "within 10000 m");
    }
  }
  return c;
}

vpCachedCover entry(vpJsonObject &object)
{
  vpCachedCover cached;
  cached.key = object.text("key");
  cached.fitted = object.text("fitted");
  cached.unchecked = object.flag("unchecked", false);
  cached.cover.overhang = object.number("overhang_m", 0.);
  cached.cover.volumeRatio = object.number("volume_ratio", 0.);
  cached.cover.radius = object.number("radius_m", 0.);
  object.each("capsules", [&](vpJsonObject &item) { cached.cover.capsules.push_back(capsule(item)); });
  if (cached.cover.capsules.empty()) {
    throw object.wrong("capsules", object.value("capsules"), "at least one capsule");
  }
  return cached;
}

std::string dump(const nlohmann::ordered_json &value)
{
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::ordered_json numbers(const Eigen::Vector3d &v) { return {v.x(), v.y(), v.z()}; }

// One line for a capsule, for whoever edits them.
std::string toText(const std::string &body, const vpCachedCover &cached)
{
  nlohmann::ordered_json head;
  head["body"] = body;
  head["key"] = cached.key;
  head["fitted"] = cached.fitted;
  if (cached.unchecked) {
    head["unchecked"] = true;
  }
  head["overhang_m"] = cached.cover.overhang;
  head["volume_ratio"] = cached.cover.volumeRatio;
  head["radius_m"] = cached.cover.radius;
  std::string text = dump(head);
  text.back() = ','; // instead of the closing brace
  std::string separator = "\n    \"capsules\": [\n      ";
  for (const vpArmCapsule &c : cached.cover.capsules) {
    nlohmann::ordered_json line;
    line["from_m"] = numbers(c.from);
    line["to_m"] = numbers(c.to);
    line["radius_m"] = c.radius;
    text += separator + dump(line);
    separator = ",\n      ";
  }
  return text + "]}";
}

} // namespace

std::string vpCoverKey(const vpTriangleMesh &mesh, int count, unsigned int seed)
{
  Hash hash;
  hash.add(static_cast<std::int64_t>(count));
  hash.add(static_cast<std::int64_t>(seed));
  for (const Eigen::Vector3d &v : mesh.vertices()) {
    hash.add(v);
  }
  for (const auto &t : mesh.triangles()) {
    for (const int i : t) {
      hash.add(static_cast<std::int64_t>(i));
    }
  }
  return hash.text();
}

std::string vpCapsulesKey(const std::vector<vpArmCapsule> &capsules)
{
  Hash hash;
  for (const vpArmCapsule &c : capsules) {
    hash.add(c.from);
    hash.add(c.to);
    hash.add(c.radius);
  }
  return hash.text();
}

vpArmCoverCache::vpArmCoverCache(const std::string &file) : m_file(file)
{
  std::error_code ignored;
  if (file.empty() || std::filesystem::status(file, ignored).type() == std::filesystem::file_type::not_found) {
    return;
  }
  vpReading([&] {
    const nlohmann::json content = vpReadJson(file);
    vpJsonObject top(content, file);
    top.ignore("comment");
    top.each("bodies", [&](vpJsonObject &object) {
      const std::string body = object.text("body");
      if (!m_covers.emplace(body, entry(object)).second) {
        throw object.wrong("body", object.value("body"), "another one than before");
      }
    });
    top.finish();
  });
}

const vpCachedCover *vpArmCoverCache::find(const std::string &body) const
{
  const auto found = m_covers.find(body);
  return found == m_covers.end() ? nullptr : &found->second;
}

void vpArmCoverCache::set(const std::string &body, const vpCachedCover &cover)
{
  m_covers[body] = cover;
  m_changed = true;
}

std::string vpArmCoverCache::save() const
{
  if (m_file.empty() || !m_changed) {
    return "";
  }
  std::string text = std::string("{\n  \"comment\": \"") + comment + "\",\n  \"bodies\": [";
  std::string separator = "\n    ";
  for (const auto &cover : m_covers) {
    text += separator + toText(cover.first, cover.second);
    separator = ",\n    ";
  }
  text += "]\n}\n";
  const std::string reason = vpReplaceFile(m_file, text);
  return reason.empty() ? "" : m_file + ": the covers cannot be written" + reason;
}

END_VISP_NAMESPACE
