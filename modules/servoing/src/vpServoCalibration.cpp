/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpReading.h"
#include "vpXmlOutline.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/servoing/vpServoCalibration.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t largestFile = 1U << 20U; // bytes
constexpr double worstRotation = 1e-3;
constexpr double longest = 1000.; // m
constexpr double shortest = 1e-3; // px: vpCameraParameters refuses a focal length near 0

[[noreturn]] void refuse(const std::string &file, const std::string &what) { throw vpFileError(file + ": " + what); }

std::string trimmed(const std::string &text)
{
  const std::size_t first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

double numberOf(const std::string &text, const std::string &file, const std::string &what)
{
  const std::string word = trimmed(text);
  char *end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0' || !std::isfinite(value)) {
    refuse(file, what + " is \"" + vpPrintable(word, 60) + "\", must be a finite number");
  }
  return value;
}

//! The elements of a camera file.
class CameraFile
{
public:
  explicit CameraFile(const std::string &file)
    : m_file(file), m_text(vpReadFileText(file, largestFile)), m_elements(vpReadXmlOutline(m_text, file, false))
  {}

  [[nodiscard]] std::vector<int> children(int parent, const std::string &name) const
  {
    std::vector<int> found;
    for (std::size_t i = 0; i < m_elements.size(); ++i) {
      if (m_elements[i].parent == parent && m_elements[i].name == name) {
        found.push_back(static_cast<int>(i));
      }
    }
    return found;
  }
  //! Text of the only child of this name; empty if there is none.
  [[nodiscard]] std::string text(int parent, const std::string &name) const
  {
    const std::vector<int> found = children(parent, name);
    if (found.size() > 1) {
      refuse(m_file, "has more than one " + name + " in one element");
    }
    if (found.empty()) {
      return "";
    }
    const std::size_t begin = m_text.find('>', m_elements[static_cast<std::size_t>(found[0])].afterName) + 1;
    return trimmed(m_text.substr(begin, m_text.find('<', begin) - begin));
  }
  [[nodiscard]] double number(int parent, const std::string &name) const
  {
    return numberOf(text(parent, name), m_file, name);
  }
  [[nodiscard]] unsigned int size(int parent, const std::string &name) const
  {
    if (children(parent, name).empty()) {
      return 0;
    }
    const double value = number(parent, name);
    if (!(value >= 1. && value <= 1e6 && value == std::floor(value))) {
      refuse(m_file, name + " is " + text(parent, name) + ", must be whole and 1..1000000");
    }
    return static_cast<unsigned int>(value);
  }
  [[nodiscard]] const std::string &file() const { return m_file; }

private:
  std::string m_file, m_text;
  std::vector<vpXmlElement> m_elements;
};

vpCameraParameters readModel(const CameraFile &xml, int model, bool isDistorting)
{
  const double px = xml.number(model, "px"), py = xml.number(model, "py");
  const double u0 = xml.number(model, "u0"), v0 = xml.number(model, "v0");
  if (!(px >= shortest && py >= shortest)) {
    refuse(xml.file(),
           "px and py are " + xml.text(model, "px") + " and " + xml.text(model, "py") + ", must be >= 0.001");
  }
  vpCameraParameters camera(px, py, u0, v0);
  if (isDistorting) {
    camera.initPersProjWithDistortion(px, py, u0, v0, xml.number(model, "kud"), xml.number(model, "kdu"));
  }
  return camera;
}

vpCameraParameters readModels(const CameraFile &xml, int camera)
{
  std::string unknown;
  int plain = -1;
  for (const int model : xml.children(camera, "model")) {
    const std::string type = xml.text(model, "type");
    if (type == "perspectiveProjWithDistortion") {
      return readModel(xml, model, true);
    }
    plain = type == "perspectiveProjWithoutDistortion" ? model : plain;
    unknown = type;
  }
  if (plain < 0) {
    refuse(xml.file(), unknown.empty() ? "the camera has no model"
                                       : "projection model " + vpPrintable(unknown, 60) +
                                             " is not supported, must be perspectiveProjWithDistortion or "
                                             "perspectiveProjWithoutDistortion");
  }
  return readModel(xml, plain, false);
}

std::string describe(const vpCalibratedCamera &camera)
{
  return vpPrintable(camera.name, 60) + " (" + std::to_string(camera.width) + " x " + std::to_string(camera.height) +
         " px)";
}

vpCalibratedCamera readCamera(const std::string &file, const std::string &name, unsigned int width, unsigned int height)
{
  const CameraFile xml(file);
  std::string known;
  std::vector<std::pair<int, vpCalibratedCamera>> fitting;
  for (const int element : xml.children(0, "camera")) {
    vpCalibratedCamera camera;
    camera.name = xml.text(element, "name");
    camera.width = xml.size(element, "image_width");
    camera.height = xml.size(element, "image_height");
    known += (known.empty() ? "" : ", ") + describe(camera);
    const bool fits = (name.empty() || name == camera.name) &&
                      (width == 0 || camera.width == 0 || width == camera.width) &&
                      (height == 0 || camera.height == 0 || height == camera.height);
    if (fits) {
      fitting.emplace_back(element, camera);
    }
  }
  if (fitting.size() != 1) {
    const std::string wanted =
        (name.empty() ? "" : " with the name " + vpPrintable(name, 60)) +
        (width == 0 && height == 0 ? "" : " for " + std::to_string(width) + " x " + std::to_string(height) + " px");
    refuse(file, (fitting.empty() ? "has no camera" : "has more than one camera") + wanted +
                     (known.empty() ? "" : "; there are: " + known));
  }
  fitting[0].second.parameters = readModels(xml, fitting[0].first);
  return fitting[0].second;
}

// The numbers behind "data:" of YAML, row by row in brackets, or all numbers of a plain text.
std::vector<double> readNumbers(const std::string &file)
{
  std::string text = vpReadFileText(file, largestFile);
  const std::size_t data = text.find("data:");
  if (data != std::string::npos) {
    text = text.substr(data + 5);
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool isBullet = text[i] == '-' && (i + 1 >= text.size() || text[i + 1] == ' ');
      text[i] = isBullet || text[i] == '[' || text[i] == ']' || text[i] == ',' ? ' ' : text[i];
    }
  }
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    numbers.push_back(numberOf(word, file, "number " + std::to_string(numbers.size() + 1)));
    if (numbers.size() > 16) {
      break;
    }
  }
  return numbers;
}

vpRigidTransform readPose(const std::string &file)
{
  const std::vector<double> n = readNumbers(file);
  vpRigidTransform pose;
  if (n.size() == 6) {
    const Eigen::Vector3d turn(n[3], n[4], n[5]);
    if (!(turn.norm() <= 7.)) {
      refuse(file, "is no rotation vector in rad: its angle is " + std::to_string(turn.norm()));
    }
    pose.R = vpSO3::exp(turn);
    pose.p = {n[0], n[1], n[2]};
  }
  else if (n.size() == 16) {
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> M(n.data());
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M.topLeftCorner<3, 3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    pose.R = svd.matrixU() * svd.matrixV().transpose();
    pose.p = M.topRightCorner<3, 1>();
    const double off = (M.topLeftCorner<3, 3>() - pose.R).cwiseAbs().maxCoeff();
    if (!(off <= worstRotation && pose.R.determinant() > 0.)) {
      refuse(file, "its upper left 3 x 3 numbers are no rotation");
    }
    if (M.row(3) != Eigen::RowVector4d(0., 0., 0., 1.)) {
      refuse(file, "its last row is not 0 0 0 1");
    }
  }
  else {
    refuse(file, "has " + (n.size() > 16 ? "more than 16" : std::to_string(n.size())) +
                     " numbers, must have 6 (translation, theta u) or 16 (a 4 x 4 matrix)");
  }
  if (!(pose.p.norm() <= longest)) {
    refuse(file, "its translation is longer than 1000 m");
  }
  return pose;
}
} // namespace

vpCalibratedCamera vpLoadCalibratedCamera(const std::string &file, const std::string &name, unsigned int width,
                                          unsigned int height)
{
  return vpReading([&]() { return readCamera(file, name, width, height); });
}

vpRigidTransform vpLoadPose(const std::string &file)
{
  return vpReading([&]() { return readPose(file); });
}

END_VISP_NAMESPACE
