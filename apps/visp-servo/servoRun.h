/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file servoRun.h
 * \brief The loop from images to the robot: in three threads by the clock, or in one as fast as the machine can.
 */
#ifndef visualServo_servoRun_h
#define visualServo_servoRun_h

#include "liveRobot.h"
#include "options.h"
#include "recording.h"

#include "imageSource.h"

#include <visp3/core/vpCameraParameters.h>

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace visualServo
{
//! Why a run ended.
enum class Ending {
  Converged,    //!< The goal was reached.
  Duration,     //!< The time was over.
  NoMoreImages, //!< The recording ended.
  Quit,         //!< The user ended it by a key.
  Interrupted,  //!< Ctrl-C.
  Failed        //!< ServoRun::failure() says why.
};

//! What a window asks for.
enum class Wish { None, StartStop, NextLaw, Quit };

//! \brief What is shown of a run at one moment.
struct Moment {
  const vpImage<unsigned char> *image; //!< Null: there was none yet.
  const ImageRow *seen;                //!< Of that image; null with it.
  const CycleRow *cycle;               //!< Null before the first.
  std::string sentence;                //!< Of that cycle.
  std::string law;
  std::size_t images = 0, lost = 0;
  double imageRate = 0.; //!< Images per second of the last second.
  bool isMoving = false; //!< start() was called.
};
//! Shows a moment; returns what the user wants.
using Screen = std::function<Wish(const Moment &)>;

/*!
 * \brief One run. The control thread calls neither files nor the screen: its rows go through a queue without locks to the main thread, which
 * writes, shows and decides about the end.
 */
class ServoRun
{
public:
  //! \param screen : Empty: none. All must outlive this.
  ServoRun(const Options &options, vpApp::ImageSource &source, Robot &robot, vpVisualServo &servo, Recording &recording,
           Screen screen);
  //! Runs until the end; the robot is at rest then. \throw std::exception only for files that cannot be written.
  void run();

  [[nodiscard]] Ending ending() const { return m_ending; }
  //! What failed, a sentence; empty: nothing.
  [[nodiscard]] std::string failure() const;
  //! Rows of cycles that found no room in the queue.
  [[nodiscard]] std::size_t lostRows() const { return m_queue.lost(); }
  //! Images that were not recorded because writing was too slow.
  [[nodiscard]] std::size_t unrecorded() const { return m_unrecorded; }
  //! Controllers used, in this order.
  [[nodiscard]] const std::vector<std::string> &lawsUsed() const { return m_lawsUsed; }
  //! What the operating system allowed the control thread, a sentence; empty without the clock. After run().
  [[nodiscard]] const std::string &realTime() const { return m_realTime; }
  //! True if the robot was told to move.
  [[nodiscard]] bool hasStarted() const { return m_hasStarted; }

private:
  struct Seen {
    ImageRow row;
    std::shared_ptr<const vpImage<unsigned char>> image;
  };

  void runByClock();
  void runStepped();
  void controlThread();
  void visionThread();
  void cycle(double time) noexcept;
  void moveRobot(const vpVisualServoOutput &motion) noexcept;
  void see(const std::shared_ptr<const vpImage<unsigned char>> &image, unsigned int number, double capture);
  void fail(const std::string &sentence) noexcept;
  void drain();
  void show();
  void obey(Wish wish);
  void startOrStop();
  void nextLaw();
  void tell(bool isLast);
  [[nodiscard]] bool isOver();
  void halt() noexcept;
  [[nodiscard]] bool stands() const noexcept;
  [[nodiscard]] double clock() const { return vpApp::now() - m_begin; }

  const Options &m_options;
  vpApp::ImageSource &m_source;
  Robot &m_robot;
  vpVisualServo &m_servo;
  Recording &m_recording;
  Screen m_screen;
  RowQueue m_queue{8192};
  double m_begin = 0.;
  bool m_commands; // the robot is to be moved

  std::atomic<bool> m_end{false}, m_wantsMotion{false}, m_sourceEnded{false}, m_hasFailed{false};
  std::atomic<vpServoController *> m_nextController{nullptr};
  std::string m_realTime;                      // control thread
  bool m_isBroken = false, m_isHalted = false; // control thread: the robot refuses; it was stopped
  bool m_hasBegun = false;                     // control thread: the robot takes velocities
  double m_time = 0.;                          // of the last cycle of runStepped(), s
  mutable std::mutex m_mutex;
  std::deque<Seen> m_seen; // by the mutex
  std::string m_failure;   // by the mutex

  // Main thread.
  Ending m_ending = Ending::Quit;
  Seen m_shown;
  std::deque<double> m_arrivals;
  std::size_t m_law = 0, m_told = 0, m_unrecorded = 0;
  std::vector<std::string> m_lawsUsed;
  bool m_hasStarted = false;
  double m_toldAt = 0., m_flushedAt = 0., m_shownAt = 0.;
};

//! The sentence of an ending.
[[nodiscard]] std::string sentenceOf(Ending ending);
} // namespace visualServo

#endif
