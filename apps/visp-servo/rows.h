/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file rows.h
 * \brief What is recorded of each cycle and each image, and how it leaves the control thread.
 */
#ifndef visualServo_rows_h
#define visualServo_rows_h

#include <visp3/servoing/vpVisualServo.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace visualServo
{
constexpr double NOTHING = std::numeric_limits<double>::quiet_NaN();

//! \brief One cycle of the control thread. Of fixed size.
struct CycleRow {
  double time = 0.; //!< Since the start of the program's run, s.
  vpVisualServoStatus status = vpVisualServoStatus::Idle;
  vpServoStatus servo = vpServoStatus::Holding;
  const char *message = ""; //!< Static text.
  vpClearance obstacle;     //!< See vpVisualServoOutput.
  bool hasPose = false;     //!< The target's pose, predicted for now, is known.
  vpRigidTransform cMo;
  std::array<double, 6> sigma{}; //!< Standard deviations of its position (m) and rotation (rad); NaN: not known.
  double positionError = NOTHING, rotationError = NOTHING; //!< m, rad.
  double age = NOTHING;                                    //!< Of the image in use, s.
  double speedFactor = 0.;
  double distance = 0., distanceSigma = 0.; //!< See vpServoSight, m.
  vpTwist twist;                            //!< See vpVisualServoOutput, m/s and rad/s.
  int joints = 0;
  std::array<double, vpArmMaxJoints> q{}, velocity{}; //!< rad or m, rad/s or m/s.
  bool hasCamera = false;                             //!< The robot told #fMc.
  vpRigidTransform fMc; //!< Camera in the base; end effector in the base before a fixed camera.
  double stepTime = 0.; //!< Computing time of the step, s.
};

//! \brief One image.
struct ImageRow {
  bool isRecorded = false;
  std::size_t index = 0;   //!< In the recorded video, from 0.
  unsigned int number = 0; //!< Of the source.
  double capture = 0.;     //!< Time of capture on the clock of CycleRow::time, s.
  double seen = 0.;        //!< Time when its result was handed over, s.
  double visionTime = 0.;  //!< Computing time, s.
  bool found = false;
  vpHomogeneousMatrix cMo;
  vpPoseCovariance covariance;
  double distance = 0., distanceSigma = 0.; //!< See vpServoSight, m.
  std::vector<vpServoPoint> outline, goal;  //!< Of target and goal, normalised.
  std::string message;                      //!< Of the vision.
};

//! Standard deviations of a pose: position (m), rotation (rad); NaN where not known.
[[nodiscard]] std::array<double, 6> deviationsOf(const vpPoseCovariance &covariance) noexcept;

//! The row of a cycle. Does not allocate. \param arm : Null: without joints.
[[nodiscard]] CycleRow rowOf(const vpVisualServo &servo, const vpServoRobotState &state, bool tellsPose, double time,
                             double stepTime) noexcept;

/*!
 * \brief Rows from one thread to another without a lock. The writer never waits: rows that find no room are counted.
 */
class RowQueue
{
public:
  //! \param size : Number of rows it holds, > 0.
  explicit RowQueue(std::size_t size) : m_rows(size + 1) {}
  //! Writer's thread. \return False: no room, the row is lost.
  bool push(const CycleRow &row) noexcept
  {
    const std::size_t write = m_write.load(std::memory_order_relaxed), next = (write + 1) % m_rows.size();
    if (next == m_read.load(std::memory_order_acquire)) {
      m_lost.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    m_rows[write] = row;
    m_write.store(next, std::memory_order_release);
    return true;
  }
  //! Reader's thread. \return False: there is none.
  bool pop(CycleRow &row) noexcept
  {
    const std::size_t read = m_read.load(std::memory_order_relaxed);
    if (read == m_write.load(std::memory_order_acquire)) {
      return false;
    }
    row = m_rows[read];
    m_read.store((read + 1) % m_rows.size(), std::memory_order_release);
    return true;
  }
  //! Rows without room. Any thread.
  [[nodiscard]] std::size_t lost() const noexcept { return m_lost.load(std::memory_order_relaxed); }

private:
  std::vector<CycleRow> m_rows;
  std::atomic<std::size_t> m_write{0}, m_read{0}, m_lost{0};
};
} // namespace visualServo

#endif
