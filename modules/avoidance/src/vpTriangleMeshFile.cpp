/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMeshFileOutline.h"
#include "vpReading.h"

#include <visp3/avoidance/vpTriangleMesh.h>

#include <Eigen/Geometry>

#if __has_include(<assimp/AssertHandler.h>)
#include <assimp/AssertHandler.h>
#endif
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <mutex>
#include <stdexcept>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t mostTriangles = 20000000; // a Collada file may repeat its meshes

struct Soup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

std::string lowerExtension(const std::string &file)
{
  const std::size_t dot = file.rfind('.');
  std::string extension = dot == std::string::npos ? "" : file.substr(dot + 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Eigen::Affine3d placeOf(const aiMatrix4x4 &m)
{
  Eigen::Affine3d T;
  T.matrix() << static_cast<double>(m.a1), static_cast<double>(m.a2), static_cast<double>(m.a3),
      static_cast<double>(m.a4), static_cast<double>(m.b1), static_cast<double>(m.b2), static_cast<double>(m.b3),
      static_cast<double>(m.b4), static_cast<double>(m.c1), static_cast<double>(m.c2), static_cast<double>(m.c3),
      static_cast<double>(m.c4), 0., 0., 0., 1.;
  return T;
}

// A polygon becomes a fan, which holds all of it, also where it is not convex. Points and lines are left out.
void add(const aiMesh &mesh, const aiFace &face, int first, Soup &soup, const std::string &file)
{
  for (unsigned int k = 0; k < face.mNumIndices; ++k) {
    if (face.mIndices[k] >= mesh.mNumVertices) {
      throw vpFileError(file + ": a face uses vertex " + std::to_string(face.mIndices[k]) + " of " +
                        std::to_string(mesh.mNumVertices));
    }
  }
  const auto at = [&](unsigned int k) { return first + static_cast<int>(face.mIndices[k]); };
  for (unsigned int k = 2; k < face.mNumIndices; ++k) {
    soup.triangles.push_back({at(0), at(k - 1), at(k)});
  }
  if (soup.triangles.size() > mostTriangles) {
    throw vpFileError(file + ": has more than " + std::to_string(mostTriangles) + " triangles");
  }
}

void add(const aiMesh &mesh, const Eigen::Affine3d &place, Soup &soup, const std::string &file)
{
  if (soup.vertices.size() + mesh.mNumVertices > 3 * mostTriangles) {
    throw vpFileError(file + ": has more than " + std::to_string(3 * mostTriangles) + " vertices");
  }
  const int first = static_cast<int>(soup.vertices.size());
  for (unsigned int i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D &v = mesh.mVertices[i];
    soup.vertices.emplace_back(
        place * Eigen::Vector3d(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)));
  }
  for (unsigned int i = 0; i < mesh.mNumFaces; ++i) {
    add(mesh, mesh.mFaces[i], first, soup, file);
  }
}

void add(const aiScene &scene, const aiNode &node, const Eigen::Affine3d &parent, Soup &soup, const std::string &file)
{
  const Eigen::Affine3d place = parent * placeOf(node.mTransformation);
  for (unsigned int i = 0; i < node.mNumMeshes; ++i) {
    add(*scene.mMeshes[node.mMeshes[i]], place, soup, file);
  }
  for (unsigned int i = 0; i < node.mNumChildren; ++i) {
    add(scene, *node.mChildren[i], place, soup, file);
  }
}

#if __has_include(<assimp/AssertHandler.h>)
// While one lives, a failed assertion of assimp is an exception; in Debian 13's build it would end the process.
class AssertionsThrow
{
public:
  AssertionsThrow() : m_lock(s_mutex)
  {
    Assimp::setAiAssertHandler([](const char *expression, const char *, int) {
      throw std::runtime_error(std::string("assimp expects ") + expression);
    });
  }
  ~AssertionsThrow() { Assimp::setAiAssertHandler(Assimp::defaultAiAssertHandler); }
  AssertionsThrow(const AssertionsThrow &) = delete;
  AssertionsThrow &operator=(const AssertionsThrow &) = delete;

private:
  static inline std::mutex s_mutex; // assimp has one handler for all threads
  std::lock_guard<std::mutex> m_lock;
};
#else
struct AssertionsThrow {
};
#endif

Soup parse(const std::string &bytes, const std::string &extension, const std::string &file)
{
  [[maybe_unused]] const AssertionsThrow guard{};
  Assimp::Importer importer;
  // As RViz and MoveIt read Collada: its up axis is ignored, its unit is not.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // From memory: materials and pictures beside the file are not looked for.
  const aiScene *scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0U, extension.c_str());
  if (scene == nullptr) {
    const std::string reason = importer.GetErrorString();
    throw vpFileError(file + ": is no readable ." + extension + " file" + (reason.empty() ? "" : " (" + reason + ")"));
  }
  Soup soup;
  if (scene->mRootNode != nullptr) {
    add(*scene, *scene->mRootNode, Eigen::Affine3d::Identity(), soup, file);
  }
  return soup;
}

void requireScale(const std::string &file, const Eigen::Vector3d &scale)
{
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(scale(i)) || scale(i) == 0.) {
      throw vpException(vpException::badValue, "%s: scale along %c is %g, must be finite and not 0", file.c_str(),
                        "xyz"[i], scale(i));
    }
  }
}

vpTriangleMesh read(const std::string &file, const Eigen::Vector3d &scale)
{
  requireScale(file, scale);
  const std::string extension = lowerExtension(file);
  if (extension != "stl" && extension != "obj" && extension != "dae" && extension != "ply") {
    throw vpFileError(file + ": is no .stl, .obj, .dae or .ply file");
  }
  std::string bytes = vpReadFileText(file, vpLargestDataFile);
  vpRequireMeshOutline(bytes, extension, file);
  Soup soup = parse(bytes, extension, file);
  for (Eigen::Vector3d &v : soup.vertices) {
    v = v.cwiseProduct(scale);
  }
  if (scale.prod() < 0.) { // a mirrored triangle turns round
    for (auto &t : soup.triangles) {
      std::swap(t[1], t[2]);
    }
  }
  return vpTriangleMesh(soup.vertices, soup.triangles, file);
}
} // namespace

vpTriangleMesh vpTriangleMesh::load(const std::string &file, double scale)
{
  return vpReading([&] {
    if (!(scale > 0.)) {
      throw vpException(vpException::badValue, "%s: scale is %g, must be > 0 and finite", file.c_str(), scale);
    }
    return read(file, Eigen::Vector3d::Constant(scale));
  });
}

vpTriangleMesh vpTriangleMesh::load(const std::string &file, const Eigen::Vector3d &scale)
{
  return vpReading([&] { return read(file, scale); });
}

END_VISP_NAMESPACE
