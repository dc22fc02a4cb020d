/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "servoRun.h"

#include "appMain.h"
#include "numberText.h"

#include <visp3/core/vpMath.h>
#include <visp3/servoing/vpRealTime.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <thread>

#include <unistd.h>

namespace visualServo
{
namespace
{
using Image = vpImage<unsigned char>;
constexpr std::size_t MOST_WAITING = 250;               // images that wait to be written
constexpr double LONGEST_BRAKING = 3.;                  // s
constexpr double TINY = 1e-9;                           // s
constexpr double FLUSH_EVERY = 0.25, SHOW_EVERY = 0.04; // s

std::chrono::steady_clock::time_point pointOf(double time)
{
  return std::chrono::steady_clock::time_point(
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(time)));
}

bool isLatched(vpVisualServoStatus status) { return status >= vpVisualServoStatus::ClockFault; }
} // namespace

ServoRun::ServoRun(const Options &options, vpApp::ImageSource &source, Robot &robot, vpVisualServo &servo,
                   Recording &recording, Screen screen)
  : m_options(options), m_source(source), m_robot(robot), m_servo(servo), m_recording(recording),
    m_screen(std::move(screen)), m_commands(!options.motion.dryRun), m_lawsUsed{servo.controller().id()}
{}

void ServoRun::run()
{
  if (m_options.motion.start || m_options.isSimulated() || m_options.motion.dryRun) {
    startOrStop();
  }
  m_options.realTime ? runByClock() : runStepped();
  m_recording.flush();
}

std::string ServoRun::failure() const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_failure;
}

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

//! Main thread: what the other threads left for the files.
void ServoRun::drain()
{
  for (CycleRow row; m_queue.pop(row);) {
    m_recording.add(row);
  }
  std::deque<Seen> seen;
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    seen.swap(m_seen);
  }
  for (Seen &one : seen) {
    m_arrivals.push_back(one.row.capture);
    while (m_arrivals.front() < one.row.capture - 1.) {
      m_arrivals.pop_front();
    }
    m_recording.add(one.row, one.image.get());
    m_shown = one.image ? std::move(one) : m_shown;
  }
  const double now = vpApp::now();
  if (now - m_flushedAt > FLUSH_EVERY) {
    m_recording.flush();
    m_flushedAt = now;
  }
}

void ServoRun::show()
{
  const double now = vpApp::now();
  if (!m_screen || now - m_shownAt < SHOW_EVERY) {
    return;
  }
  m_shownAt = now;
  Moment moment;
  moment.image = m_shown.image.get();
  moment.seen = m_shown.image ? &m_shown.row : nullptr;
  moment.cycle = m_recording.cycleCount() > 0 ? &m_recording.last() : nullptr;
  moment.law = m_lawsUsed.back();
  moment.images = m_recording.imageCount();
  moment.lost = m_source.lost();
  moment.imageRate = static_cast<double>(m_arrivals.size());
  moment.isMoving = m_wantsMotion;
  obey(m_screen(moment));
}

void ServoRun::obey(Wish wish)
{
  switch (wish) {
  case Wish::StartStop:
    startOrStop();
    break;
  case Wish::NextLaw:
    nextLaw();
    break;
  case Wish::Quit:
    m_ending = Ending::Quit;
    m_end = true;
    break;
  case Wish::None:
    break;
  }
}

void ServoRun::startOrStop()
{
  m_wantsMotion = !m_wantsMotion;
  if (m_wantsMotion) {
    m_servo.start();
    m_hasStarted = true;
  }
  else {
    m_servo.stop();
  }
}

void ServoRun::nextLaw()
{
  m_law = (m_law + 1) % m_options.laws.size();
  const std::string &id = m_options.laws[m_law];
  delete m_nextController.exchange(new vpServoController(vpServoController::create(id, m_options.law)));
  m_lawsUsed.push_back(id);
}

//! Main thread: the terminal. A line for each change, and from time to time where it is.
void ServoRun::tell(bool isLast)
{
  for (; m_told < m_recording.events().size(); ++m_told) {
    const Event &event = m_recording.events()[m_told];
    std::fprintf(stderr, "%8.2f s  %s: %s\n", event.time, event.word.c_str(), event.sentence.c_str());
  }
  const double now = vpApp::now();
  if (!isLast && now - m_toldAt < (isatty(STDERR_FILENO) != 0 ? 1. : 5.)) {
    return;
  }
  m_toldAt = now;
  if (m_recording.cycleCount() == 0) {
    return;
  }
  const CycleRow &row = m_recording.last();
  const vpServoTiming &timing = m_servo.timing();
  std::fprintf(stderr, "%8.2f s  %s, %zu images (%zu in the last second, %zu lost), image age %s, %s, step %.0f us\n",
               row.time,
               row.hasPose ? (vpApp::fixed(1e3 * row.positionError, 1) + " mm and " +
                              vpApp::fixed(vpMath::deg(row.rotationError), 2) + " deg from the goal")
                                 .c_str()
                           : "target not seen",
               m_recording.imageCount(), m_arrivals.size(), m_source.lost(),
               std::isfinite(row.age) ? (vpApp::fixed(1e3 * row.age, 0) + " ms").c_str() : "unknown",
               (vpApp::fixed(1e3 * row.twist.linearNorm(), 1) + " mm/s").c_str(), 1e6 * timing.step.quantile(0.99));
}

//! Main thread.
bool ServoRun::isOver()
{
  const bool isMoving = m_wantsMotion;
  if (m_end) {
    return true;
  }
  if (vpApp::interrupted()) {
    m_ending = Ending::Interrupted;
    return true;
  }
  if (m_hasFailed) {
    m_ending = Ending::Failed;
    return true;
  }
  if (m_recording.cycleCount() == 0) {
    return false;
  }
  const CycleRow &row = m_recording.last();
  if (isMoving && isLatched(row.status) && !m_screen) { // in the window the user may start again
    fail(row.message);
    m_ending = Ending::Failed;
    return true;
  }
  if (isMoving && row.status == vpVisualServoStatus::Converged && !m_options.stay && m_commands) {
    m_ending = Ending::Converged;
    return true;
  }
  if (m_options.duration > 0. && row.time >= m_options.duration) {
    m_ending = Ending::Duration;
    return true;
  }
  if (m_sourceEnded) {
    m_ending = Ending::NoMoreImages;
    return true;
  }
  return false;
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

std::string sentenceOf(Ending ending)
{
  switch (ending) {
  case Ending::Converged:
    return "The goal was reached.";
  case Ending::Duration:
    return "The time was over.";
  case Ending::NoMoreImages:
    return "The images ended.";
  case Ending::Quit:
    return "It was ended by a key.";
  case Ending::Interrupted:
    return "It was ended by Ctrl-C.";
  case Ending::Failed:
    return "It failed.";
  }
  return "";
}
} // namespace visualServo
