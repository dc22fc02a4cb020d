/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "servoRun.h"

#include "appMain.h"
#include "numberText.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include <unistd.h>

namespace visualServo
{
namespace
{
constexpr double FLUSH_EVERY = 0.25, SHOW_EVERY = 0.04; // s

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
  moment.sentence = m_recording.cycleCount() > 0 ? m_recording.sentenceOf(m_recording.last()) : "";
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
