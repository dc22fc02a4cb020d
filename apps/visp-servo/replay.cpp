/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "camera.h"
#include "recorded.h"
#include "session.h"
#include "target.h"

#include "appMain.h"
#include "greyPicture.h"
#include "numberText.h"
#include "outputFolder.h"
#include "recording.h"
#include "report.h"
#include "vpFileText.h"

#include <visp3/core/vpMath.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpSO3.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>

namespace fs = std::filesystem;

namespace visualServo
{
namespace
{
//! \brief A cycle, then and now.
struct Compared {
  double time = 0.;
  vpTwist then, now;
  double positionThen = NOTHING, positionNow = NOTHING; //!< m
  double rotationThen = NOTHING, rotationNow = NOTHING; //!< rad
};

vpTwist difference(const vpTwist &a, const vpTwist &b)
{
  vpTwist d;
  for (std::size_t i = 0; i < 6; ++i) {
    d[i] = a[i] - b[i];
  }
  return d;
}

//! \brief What differs between recording and replay.
struct Differences {
  std::size_t missing = 0; //!< Images of images.csv that the video lacks.
  std::size_t images = 0, foundThen = 0, foundNow = 0;
  std::vector<double> positions, rotations; //!< Of the target's poses in images where both found it, m and rad.
  std::size_t cycles = 0;
  double linearSquares = 0., angularSquares = 0., largestLinear = 0., largestAngular = 0.;
  double firstTime = NOTHING; //!< When the speeds first differed by more than a tenth of the limits, s.

  void add(const RecordedImage &then, const vpServoMeasurement &now)
  {
    ++images;
    foundThen += then.found ? 1 : 0;
    foundNow += now.valid ? 1 : 0;
    if (then.found && now.valid) {
      const vpRigidTransform d =
          vpRigidTransform::fromHomogeneous(then.cMo).inverse() * vpRigidTransform::fromHomogeneous(now.cMo);
      positions.push_back(d.p.norm());
      rotations.push_back(vpSO3::log(d.R).norm());
    }
  }
  void add(const Compared &row, const vpServoMotionLimits &limits)
  {
    const vpTwist d = difference(row.now, row.then);
    const double linear = d.linearNorm(), angular = d.angularNorm();
    ++cycles;
    linearSquares += linear * linear;
    angularSquares += angular * angular;
    largestLinear = std::max(largestLinear, linear);
    largestAngular = std::max(largestAngular, angular);
    const bool differs = linear > 0.1 * limits.linearVelocity || angular > 0.1 * limits.angularVelocity;
    firstTime = differs && std::isnan(firstTime) ? row.time : firstTime;
  }
  [[nodiscard]] double rms(double squares) const
  {
    return cycles > 0 ? std::sqrt(squares / static_cast<double>(cycles)) : 0.;
  }
};

//! Images of a recording's video, one after the other.
class Film
{
public:
  explicit Film(const fs::path &folder) : m_file((folder / Recording::VIDEO).string())
  {
    static_cast<void>(vpOpenFile(m_file));
    if (!m_capture.open(m_file, cv::CAP_FFMPEG)) {
      throw std::runtime_error(m_file + ": is not a video that can be read");
    }
  }
  //! False: the video ends before that image, as that of a program that was killed.
  bool read(std::size_t index, vpImage<unsigned char> &image)
  {
    cv::Mat frame, grey;
    for (; m_next <= index; ++m_next) {
      if (!m_capture.read(frame)) {
        return false;
      }
    }
    cv::extractChannel(frame, grey, 0);
    vpApp::copyGrey(grey, image);
    return true;
  }

private:
  std::string m_file;
  cv::VideoCapture m_capture;
  std::size_t m_next = 0;
};

std::vector<std::string> findings(const Differences &d, const Options &options)
{
  const auto text = [](double v) { return v < 1e-3 ? "less than 0.001" : vpApp::number(v, 3); };
  const auto mm = [&text](double v) { return text(1e3 * v); };
  const auto degrees = [&text](double v) { return text(vpMath::deg(v)); };
  std::vector<std::string> lines;
  lines.push_back("Of " + std::to_string(d.images) + " recorded images the target is found in " +
                  std::to_string(d.foundNow) + "; when they were recorded it was found in " +
                  std::to_string(d.foundThen) + ".");
  if (d.missing > 0) {
    lines.push_back("The video lacks the last " + std::to_string(d.missing) +
                    " images, as after a kill: from there on the replayed law has none.");
  }
  if (!d.positions.empty()) {
    lines.push_back("Where both found it, its poses differ by " + mm(vpMedian(d.positions)) + " mm and " +
                    degrees(vpMedian(d.rotations)) + " degrees (medians), at most " +
                    mm(*std::max_element(d.positions.begin(), d.positions.end())) + " mm and " +
                    degrees(*std::max_element(d.rotations.begin(), d.rotations.end())) + " degrees.");
  }
  lines.push_back("The law " + options.laws.front() + " would have moved the camera with velocities that differ by " +
                  mm(d.rms(d.linearSquares)) + " mm/s and " + degrees(d.rms(d.angularSquares)) +
                  " degrees/s (root mean square), at most " + mm(d.largestLinear) + " mm/s and " +
                  degrees(d.largestAngular) + " degrees/s.");
  lines.push_back(std::isnan(d.firstTime)
                      ? "They never differ by more than a tenth of the limits of speed."
                      : "They first differ by more than a tenth of the limits of speed at " +
                            vpApp::fixed(d.firstTime, 2) +
                            " s; what the camera would have seen from there on is not in the recording.");
  return lines;
}

std::string rowText(const Compared &row)
{
  std::string line = vpApp::number(row.time, 9);
  for (const vpTwist *twist : {&row.then, &row.now}) {
    for (std::size_t i = 0; i < 6; ++i) {
      line += "," + vpApp::number((*twist)[i], 9);
    }
  }
  for (const double value : {row.positionThen, row.positionNow, row.rotationThen, row.rotationNow}) {
    line += "," + (std::isfinite(value) ? vpApp::number(value, 9) : "");
  }
  return line;
}

constexpr const char *HEADING =
    "time_s,recorded_v_x,recorded_v_y,recorded_v_z,recorded_v_wx,recorded_v_wy,recorded_v_wz,replayed_v_x,replayed_v_y,"
    "replayed_v_z,replayed_v_wx,replayed_v_wy,replayed_v_wz,recorded_position_error_m,replayed_position_error_m,"
    "recorded_rotation_error_rad,replayed_rotation_error_rad\n";

//! Runs vision and law along the recorded motion.
class Rerun
{
public:
  Rerun(const Options &options, vpVisualServo &servo, std::ostream &csv)
    : m_options(options), m_servo(servo), m_csv(csv), m_images(readImages(options.replay)), m_film(options.replay)
  {}
  void run()
  {
    readCycles(m_options.replay, [this](const RecordedCycle &cycle) { step(cycle); });
  }
  [[nodiscard]] const Differences &differences() const { return m_differences; }

private:
  void step(const RecordedCycle &cycle)
  {
    vpApp::throwIfInterrupted();
    if (!cycle.isIdle && !m_isRunning) {
      m_servo.start();
      m_isRunning = true;
    }
    // Results come to the cycle after the one in which they were handed over, as they did then.
    for (; m_image < m_images.size() && m_images[m_image].seen < cycle.time; ++m_image) {
      see(m_images[m_image]);
    }
    vpServoRobotState state;
    state.valid = cycle.hasCamera;
    state.pose = cycle.fMc;
    const vpVisualServoOutput &now = m_servo.step(state, cycle.time);
    const Compared row{cycle.time,        cycle.twist,         now.twist,        cycle.positionError,
                       now.positionError, cycle.rotationError, now.rotationError};
    m_differences.add(row, m_options.law.motion);
    m_csv << rowText(row) << '\n';
  }
  void see(const RecordedImage &image)
  {
    if (m_film.read(image.index, m_picture)) {
      m_differences.add(image, m_servo.see(m_picture, image.capture).measurement);
    }
    else {
      ++m_differences.missing;
    }
  }

  const Options &m_options;
  vpVisualServo &m_servo;
  std::ostream &m_csv;
  std::vector<RecordedImage> m_images;
  Film m_film;
  Differences m_differences;
  vpImage<unsigned char> m_picture;
  std::size_t m_image = 0;
  bool m_isRunning = false;
};

Eye eyeOf(const Options &options)
{
  vpImage<unsigned char> first;
  Film film(options.replay);
  if (!film.read(0, first)) {
    throw std::runtime_error((fs::path(options.replay) / Recording::VIDEO).string() +
                             ": has no image that can be read");
  }
  Eye eye;
  eye.width = first.getWidth();
  eye.height = first.getHeight();
  eye.intrinsics = intrinsicsOf(options.camera, eye.width, eye.height);
  eye.fMc = fixedCamera(options.camera);
  return eye;
}

nlohmann::ordered_json summaryOf(const Differences &d, const Options &options, const std::string &commandLine)
{
  return {{"version", VISP_DIRECT_VERSION},
          {"command", commandLine},
          {"recording", options.replay},
          {"law", options.laws.front()},
          {"images", d.images},
          {"images_missing", d.missing},
          {"found_then", d.foundThen},
          {"found_now", d.foundNow},
          {"cycles", d.cycles},
          {"velocity_rms_mps", d.rms(d.linearSquares)},
          {"angular_velocity_rms_radps", d.rms(d.angularSquares)},
          {"velocity_largest_mps", d.largestLinear},
          {"angular_velocity_largest_radps", d.largestAngular},
          {"findings", findings(d, options)}};
}
} // namespace

int replay(const Options &given, const std::string &commandLine)
{
  Options options = given;
  std::error_code ignored;
  if (fs::equivalent(options.out, options.replay, ignored)) {
    throw vpApp::UsageError("--out is " + options.out + ", the recording itself, must be another folder");
  }
  const Eye eye = eyeOf(options);
  options.servo.assumeExecuted = false;
  options.servo.followLength = options.servo.followAngle =
      std::numeric_limits<double>::infinity(); // it moved as it did
  vpVisualServo servo(controllerOf(options, eye), options.servo);
  servo.setVision(makeVision(options, eye.intrinsics));
  if (options.target.reference.empty()) {
    servo.setGoal(servo.vision().goal(goalPose(options, eye)));
  }
  vpApp::OutputFolder out("visp-servo", options.out);
  std::ofstream csv(out.file("replay.csv"), std::ios::binary);
  csv << HEADING;
  Rerun rerun(options, servo, csv);
  rerun.run();
  csv.close();
  if (!csv) {
    throw std::runtime_error((out.path() / "replay.csv").string() + ": cannot be written, is the disk full?");
  }
  const Differences &d = rerun.differences();
  const std::string place = vpApp::finishWithReport(out, summaryOf(d, options, commandLine));
  for (const std::string &line : findings(d, options)) {
    std::cout << line << "\n";
  }
  std::cout << place << std::endl;
  return vpApp::ExitOk;
}
} // namespace visualServo
