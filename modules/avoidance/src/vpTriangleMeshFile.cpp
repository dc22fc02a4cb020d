/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpReading.h"

#include <visp3/avoidance/vpTriangleMesh.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

BEGIN_VISP_NAMESPACE

namespace
{
struct Soup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

[[noreturn]] void fail(const std::string &file, const std::string &why) { throw vpFileError(file + ": " + why); }

// First number of "7", "7/1" or "7//3"; negative numbers count from the end.
int objIndex(const std::string &word, std::size_t vertices, const std::string &file, const std::string &line)
{
  int index = 0;
  std::istringstream in(word);
  if (!(in >> index) || index == 0) {
    fail(file, "line " + line + ": \"" + word + "\" is no index of a vertex");
  }
  const int from0 = index > 0 ? index - 1 : static_cast<int>(vertices) + index;
  if (from0 < 0 || from0 >= static_cast<int>(vertices)) {
    fail(file, "line " + line + ": vertex " + word + " of " + std::to_string(vertices) + " does not exist");
  }
  return from0;
}

Soup readObj(const std::string &text, const std::string &file)
{
  Soup soup;
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Eigen::Vector3d v;
      if (!(words >> v.x() >> v.y() >> v.z())) {
        fail(file, "line " + std::to_string(number) + ": a vertex needs three numbers");
      }
      soup.vertices.push_back(v);
    }
    else if (kind == "f") {
      std::vector<int> polygon;
      std::string word;
      while (words >> word) {
        polygon.push_back(objIndex(word, soup.vertices.size(), file, std::to_string(number)));
      }
      if (polygon.size() < 3) {
        fail(file, "line " + std::to_string(number) + ": a face needs three vertices");
      }
      for (std::size_t i = 2; i < polygon.size(); ++i) {
        soup.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
      }
    }
  }
  return soup;
}

void addTriangle(const std::array<Eigen::Vector3d, 3> &corners, Soup &soup)
{
  const int first = static_cast<int>(soup.vertices.size());
  soup.vertices.insert(soup.vertices.end(), corners.begin(), corners.end());
  soup.triangles.push_back({first, first + 1, first + 2});
}

Soup readTextStl(const std::string &text, const std::string &file)
{
  Soup soup;
  std::istringstream in(text);
  std::string word;
  std::array<Eigen::Vector3d, 3> corners;
  std::size_t corner = 0;
  while (in >> word) {
    if (word == "vertex") {
      if (!(in >> corners[corner].x() >> corners[corner].y() >> corners[corner].z())) {
        fail(file, "triangle " + std::to_string(soup.triangles.size()) + ": a vertex needs three numbers");
      }
      if (++corner == 3) {
        addTriangle(corners, soup);
        corner = 0;
      }
    }
  }
  if (corner != 0) {
    fail(file, "triangle " + std::to_string(soup.triangles.size()) + " is cut off");
  }
  return soup;
}

constexpr std::size_t stlHeader = 84, stlTriangle = 50;

std::size_t binaryCount(const std::string &bytes)
{
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

Soup readBinaryStl(const std::string &bytes, const std::string &file)
{
  if (bytes.size() < stlHeader) {
    fail(file, "is neither a text nor a binary STL file");
  }
  const std::size_t count = binaryCount(bytes);
  if (bytes.size() < stlHeader + count * stlTriangle) {
    fail(file, "says " + std::to_string(count) + " triangles and ends in triangle " +
                   std::to_string((bytes.size() - stlHeader) / stlTriangle));
  }
  Soup soup;
  for (std::size_t i = 0; i < count; ++i) {
    float numbers[12];
    std::memcpy(numbers, bytes.data() + stlHeader + i * stlTriangle, sizeof(numbers));
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] << numbers[3 + 3 * k], numbers[4 + 3 * k], numbers[5 + 3 * k];
    }
    addTriangle(corners, soup);
  }
  return soup;
}

Soup readStl(const std::string &bytes, const std::string &file)
{
  // Binary files may begin with "solid", too: the size decides.
  const bool binary = bytes.size() >= stlHeader && bytes.size() == stlHeader + binaryCount(bytes) * stlTriangle;
  return !binary && bytes.compare(0, 5, "solid") == 0 ? readTextStl(bytes, file) : readBinaryStl(bytes, file);
}

bool endsWith(const std::string &text, const char *end)
{
  const std::size_t n = std::strlen(end);
  return text.size() >= n && text.compare(text.size() - n, n, end) == 0;
}

vpTriangleMesh read(const std::string &file, double scale)
{
  if (!std::isfinite(scale) || !(scale > 0.)) {
    throw vpException(vpException::badValue, "%s: scale is %g, must be > 0 and finite", file.c_str(), scale);
  }
  const std::string bytes = vpReadFileText(file, vpLargestDataFile);
  Soup soup;
  if (endsWith(file, ".obj")) {
    soup = readObj(bytes, file);
  }
  else if (endsWith(file, ".stl")) {
    soup = readStl(bytes, file);
  }
  else {
    fail(file, "is no .obj and no .stl file");
  }
  for (Eigen::Vector3d &v : soup.vertices) {
    v *= scale;
  }
  return vpTriangleMesh(soup.vertices, soup.triangles, file);
}
} // namespace

vpTriangleMesh vpTriangleMesh::load(const std::string &file, double scale)
{
  return vpReading([&] { return read(file, scale); });
}

END_VISP_NAMESPACE
