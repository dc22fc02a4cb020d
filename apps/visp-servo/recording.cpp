/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "recording.h"

#include "numberText.h"
#include "quietLibraries.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/core/vpPoseVector.h>

#include <cstdio>
#include <stdexcept>
#include <utility>

namespace visualServo
{
namespace
{
void append(std::string &line, double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), std::isnan(value) ? "," : "%.9g,", value);
  line += text;
}

void append(std::string &line, const vpHomogeneousMatrix *pose)
{
  if (pose == nullptr) {
    line += ",,,,,,";
    return;
  }
  const vpPoseVector p(*pose);
  for (unsigned int i = 0; i < 6; ++i) {
    append(line, p[i]);
  }
}

void append(std::string &line, const std::array<double, 6> &values)
{
  for (const double value : values) {
    append(line, value);
  }
}

std::string six(const std::string &prefix, const char *linear, const char *angular)
{
  std::string names;
  for (const char *axis : {"x", "y", "z"}) {
    names += "," + prefix + linear + axis;
  }
  for (const char *axis : {"x", "y", "z"}) {
    names += "," + prefix + angular + axis;
  }
  return names;
}

std::string csvText(const std::string &sentence)
{
  std::string text = "\"";
  for (const char c : sentence) {
    text += c == '"' ? "\"\"" : std::string(1, c);
  }
  return text + "\"";
}
} // namespace

Recording::Recording(vpApp::OutputFolder &out, const vpArmModel *arm, double rate, bool isFixed,
                     const vpCollisionScene *scene)
  : m_out(out), m_arm(arm), m_rate(rate), m_isFixed(isFixed), m_scene(scene),
    m_log(out.file("log.csv"), std::ios::binary), m_imageLog(out.file("images.csv"), std::ios::binary),
    m_eventLog(out.file("events.csv"), std::ios::binary)
{
  m_eventLog << "time_s,status,message\n";
  m_log << "time_s,status,law_status" << six("cMo_", "t", "tu") << six("sigma_", "t", "tu")
        << ",position_error_m,rotation_error_rad,image_age_s,speed_factor,distance_m,distance_sigma_m"
        << six("v_", "", "w") << six(m_isFixed ? "fMe_" : "fMc_", "t", "tu") << ",step_us";
  for (const char *quantity : {"q_", "velocity_"}) {
    for (int i = 0; m_arm != nullptr && i < m_arm->size(); ++i) {
      m_log << ',' << quantity << vpApp::fileName(m_arm->spec().joints[static_cast<std::size_t>(i)].name);
    }
  }
  m_log << (m_scene != nullptr ? ",obstacle\n" : "\n");
  m_imageLog << "image,number,capture_s,seen_s,vision_ms,found" << six("cMo_", "t", "tu") << six("sigma_", "t", "tu")
             << ",distance_m,distance_sigma_m,message\n";
}

// The pose of what moves, where the robot gives joints or nothing.
void Recording::locate(CycleRow &row)
{
  if (m_arm != nullptr && row.joints == m_arm->size()) {
    const vpJointVector q = Eigen::Map<const Eigen::VectorXd>(row.q.data(), row.joints);
    row.hasCamera = vpArmKinematics::update(*m_arm, q, m_data);
    const vpRigidTransform moved = m_isFixed ? m_data.tool : vpArmKinematics::camera(*m_arm, m_data);
    row.fMc = row.hasCamera ? moved : vpRigidTransform();
  }
  else if (m_arm == nullptr && !row.hasCamera) {
    row.fMc = m_moved;
    row.hasCamera = true;
  }
}

std::string Recording::obstacleOf(const CycleRow &row) const
{
  const bool isNone = m_scene == nullptr || row.obstacle.kind == vpCollisionKind::None;
  return isNone ? "" : m_scene->describe(row.obstacle);
}

std::string Recording::sentenceOf(const CycleRow &row) const
{
  const bool isStopped = row.status == vpVisualServoStatus::Obstructed;
  const std::string obstacle = isStopped ? obstacleOf(row) : "";
  return row.message + (obstacle.empty() ? "" : " In the way: " + obstacle + ".");
}

void Recording::add(CycleRow row)
{
  if (cycleCount() > 0) { // the motion of the last cycle lasts until this one
    const double step = row.time - m_last.time;
    m_moved = m_moved * vpRigidTransform::fromHomogeneous(vpExponentialMap::direct(m_last.twist.toColVector(), step));
  }
  locate(row);
  std::string line;
  append(line, row.time);
  line += std::string(vpToString(row.status)) + "," + vpToString(row.servo) + ",";
  const vpHomogeneousMatrix cMo = row.cMo.toHomogeneous(), fMc = row.fMc.toHomogeneous();
  append(line, row.hasPose ? &cMo : nullptr);
  append(line, row.sigma);
  for (const double value :
       {row.positionError, row.rotationError, row.age, row.speedFactor, row.distance, row.distanceSigma}) {
    append(line, value);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    append(line, row.twist[i]);
  }
  append(line, row.hasCamera ? &fMc : nullptr);
  append(line, 1e6 * row.stepTime);
  for (const auto *values : {&row.q, &row.velocity}) {
    for (int i = 0; m_arm != nullptr && i < m_arm->size(); ++i) {
      append(line, row.joints > 0 ? (*values)[static_cast<std::size_t>(i)] : NOTHING);
    }
  }
  if (m_scene != nullptr) {
    line += csvText(obstacleOf(row)) + ",";
  }
  line.back() = '\n';
  m_log << line;

  const std::string sentence = sentenceOf(row);
  if (m_events.empty() || m_events.back().sentence != sentence) {
    m_events.push_back({row.time, vpToString(row.status), sentence});
    m_eventLog << vpApp::number(row.time, 9) << ',' << vpToString(row.status) << ',' << csvText(sentence) << '\n';
  }
  m_cycles.add(row);
  m_last = row;
}

void Recording::openVideo(const vpImage<unsigned char> &image)
{
  const vpApp::QuietLibraries quiet;
  m_size = cv::Size(static_cast<int>(image.getWidth()), static_cast<int>(image.getHeight()));
  const std::string file = m_out.file(VIDEO);
  if (!m_video.open(file, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('F', 'F', 'V', '1'), m_rate, m_size, false)) {
    throw std::runtime_error(file + ": OpenCV cannot write a video without loss (FFV1 of FFmpeg)");
  }
}

void Recording::add(ImageRow row, const vpImage<unsigned char> *image)
{
  row.isRecorded = image != nullptr;
  row.index = m_recorded;
  if (image != nullptr) {
    if (!m_video.isOpened()) {
      openVideo(*image);
    }
    const cv::Mat picture(static_cast<int>(image->getHeight()), static_cast<int>(image->getWidth()), CV_8UC1,
                          image->bitmap);
    if (picture.size() != m_size) {
      throw std::runtime_error("image " + std::to_string(row.number) + " has " + std::to_string(picture.cols) + " x " +
                               std::to_string(picture.rows) + " px, those before " + std::to_string(m_size.width) +
                               " x " + std::to_string(m_size.height));
    }
    m_video.write(picture);
    ++m_recorded;
  }
  std::string line = (row.isRecorded ? std::to_string(row.index) : "") + "," + std::to_string(row.number) + ",";
  for (const double value : {row.capture, row.seen, 1e3 * row.visionTime}) {
    append(line, value);
  }
  line += row.found ? "1," : "0,";
  append(line, row.found ? &row.cMo : nullptr);
  append(line, deviationsOf(row.covariance));
  append(line, row.distance);
  append(line, row.distanceSigma);
  m_imageLog << line << csvText(row.message) << '\n';
  m_found += row.found ? 1 : 0;
  m_images.add(row);
}

void Recording::flush()
{
  for (const auto &[name, file] :
       {std::pair("log.csv", &m_log), std::pair("images.csv", &m_imageLog), std::pair("events.csv", &m_eventLog)}) {
    file->flush();
    if (!*file) {
      throw std::runtime_error((m_out.path() / name).string() + ": cannot be written, is the disk full?");
    }
  }
}

void Recording::close()
{
  flush();
  m_log.close();
  m_imageLog.close();
  m_eventLog.close();
  m_video.release();
}
} // namespace visualServo
