/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The threads of a ServoRun, and the same work in one thread.
#include "servoRun.h"

#include "appMain.h"

#include <visp3/servoing/vpRealTime.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace visualServo
{
namespace
{
using Image = vpImage<unsigned char>;
constexpr std::size_t MOST_WAITING = 250; // images that wait to be written
constexpr double LONGEST_BRAKING = 3.;    // s
constexpr double TINY = 1e-9;             // s

std::chrono::steady_clock::time_point pointOf(double time)
{
  return std::chrono::steady_clock::time_point(
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(time)));
}
} // namespace

void ServoRun::fail(const std::string &sentence) noexcept
{
  m_servo.stop();
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_failure = m_failure.empty() ? sentence : m_failure;
  m_hasFailed = true;
}

//! Control thread.
void ServoRun::moveRobot(const vpVisualServoOutput &motion) noexcept
{
  if (!m_commands || m_isBroken) {
    return;
  }
  try {
    if (m_wantsMotion && !m_hasBegun) {
      m_robot.begin();
      m_hasBegun = true;
    }
    if (m_hasBegun) {
      m_robot.command(motion, m_options.servo.period);
    }
  }
  catch (const std::exception &error) {
    fail(m_robot.description() + ": " + vpApp::sentenceOf(error));
    m_isBroken = true;
    halt(); // it might go on with the last velocity
  }
}

//! Control thread.
void ServoRun::cycle(double time) noexcept
{
  if (vpServoController *next = m_nextController.exchange(nullptr)) {
    m_servo.setController(std::move(*next));
    delete next;
  }
  vpServoRobotState state;
  try {
    state = m_robot.read();
  }
  catch (const std::exception &error) {
    state.valid = false;
    fail(m_robot.description() + ": " + vpApp::sentenceOf(error));
  }
  const double begin = vpApp::now();
  const vpVisualServoOutput &motion = m_servo.step(state, time);
  const double took = vpApp::now() - begin;
  moveRobot(motion);
  m_queue.push(rowOf(m_servo, state, m_robot.tellsState(), time, took));
}

//! Vision thread.
void ServoRun::see(const std::shared_ptr<const Image> &image, unsigned int number, double capture)
{
  Seen seen;
  seen.row.number = number;
  seen.row.capture = capture;
  const double begin = vpApp::now();
  const vpServoSight &sight = m_servo.see(*image, capture);
  seen.row.visionTime = vpApp::now() - begin;
  seen.row.seen = m_options.realTime ? clock() : m_time;
  seen.row.found = sight.measurement.valid;
  seen.row.message = m_servo.vision().message();
  seen.row.distance = sight.distance;
  seen.row.distanceSigma = sight.distanceSigma;
  if (seen.row.found) {
    seen.row.cMo = sight.measurement.cMo;
    seen.row.covariance = sight.measurement.covariance;
    const bool hasOutline = !sight.measurement.outline.empty();
    seen.row.outline = hasOutline ? sight.measurement.outline : sight.measurement.points;
  }
  if (sight.hasGoal) {
    seen.row.goal = sight.goal.points;
  }
  seen.image = image;
  const std::lock_guard<std::mutex> lock(m_mutex);
  if (m_seen.size() >= MOST_WAITING) {
    seen.image.reset();
    ++m_unrecorded;
  }
  m_seen.push_back(std::move(seen));
}

//! Control thread: the driver's own stop, once.
void ServoRun::halt() noexcept
{
  if (!m_hasBegun || m_isHalted) {
    return;
  }
  m_isHalted = true;
  try {
    m_robot.end();
  }
  catch (const std::exception &error) {
    fail(m_robot.description() + ": " + vpApp::sentenceOf(error));
  }
}

//! Control thread: the servo commands no motion any more.
bool ServoRun::stands() const noexcept
{
  const vpVisualServoOutput &motion = m_servo.output();
  return motion.twist.linearNorm() == 0. && motion.twist.angularNorm() == 0. && (motion.velocity.array() == 0.).all();
}

void ServoRun::controlThread()
{
  const double period = m_options.servo.period;
  if (!m_options.isSimulated()) {
    m_realTime = vpRequestRealTime().message;
  }
  double next = 0.;
  double braking = 0.;
  while (true) {
    std::this_thread::sleep_until(pointOf(m_begin + next));
    const double time = clock();
    cycle(time);
    next = std::max(next + period, time - period * 10.); // late steps are not made up for
    if (m_end) {                                         // brakes within the limits before the driver's stop
      m_servo.stop();
      braking += period;
      if (stands() || m_isBroken || braking > LONGEST_BRAKING) {
        break;
      }
    }
  }
  halt();
}

void ServoRun::visionThread()
{
  try {
    double first = NOTHING;
    while (!m_end) {
      auto image = std::make_shared<Image>();
      if (!m_source.next(*image)) {
        break;
      }
      double capture = m_source.time();
      if (!m_source.isLive()) { // files: at the rate of their recording
        first = std::isnan(first) ? clock() - capture : first;
        capture += first;
        std::this_thread::sleep_until(pointOf(m_begin + capture));
      }
      else {
        capture -= m_begin;
      }
      see(image, m_source.number(), capture);
    }
  }
  catch (const std::exception &error) {
    fail(vpApp::sentenceOf(error));
  }
  m_sourceEnded = true;
}

void ServoRun::runByClock()
{
  m_begin = vpApp::now();
  std::thread control([this] { controlThread(); });
  std::thread vision([this] { visionThread(); });
  std::exception_ptr broken;
  try {
    while (!isOver()) {
      drain();
      show();
      tell(false);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  catch (...) { // a file that cannot be written, or a window: the robot must stop first
    broken = std::current_exception();
  }
  m_end = true;
  control.join();
  vision.join();
  if (broken) {
    std::rethrow_exception(broken);
  }
  drain();
  tell(true);
}

void ServoRun::runStepped()
{
  const double period = m_options.servo.period;
  const double latency = m_source.isLive() ? m_options.camera.latency : 0.; // of the rendered camera
  struct Waiting {
    std::shared_ptr<Image> image;
    unsigned int number;
    double capture;
  };
  std::deque<Waiting> waiting;
  double due = 0.;
  bool hasEnded = false;
  for (std::size_t k = 0; !isOver(); ++k) {
    const double time = static_cast<double>(k) * period;
    cycle(time);
    m_time = time;
    m_sourceEnded = hasEnded && waiting.empty(); // after a cycle with the last image
    try {
      while (!hasEnded && due <= time + TINY) { // one image ahead, as only then its time is known
        auto image = std::make_shared<Image>();
        hasEnded = !m_source.next(*image);
        if (!hasEnded) {
          waiting.push_back({image, m_source.number(), m_source.time()});
          due = m_source.time() + (m_source.isLive() ? 1. / m_options.camera.rate : 0.);
        }
      }
      while (!waiting.empty() && waiting.front().capture + latency <= time + TINY) {
        see(waiting.front().image, waiting.front().number, waiting.front().capture);
        waiting.pop_front();
      }
    }
    catch (const std::exception &error) {
      fail(vpApp::sentenceOf(error));
    }
    drain();
    show();
    tell(false);
  }
  halt();
  drain();
  tell(true);
}
} // namespace visualServo
