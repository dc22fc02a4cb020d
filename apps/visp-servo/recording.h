/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file recording.h
 * \brief What is kept while the program runs: log.csv, images.csv, events.csv and the video, and what the film needs in memory.
 */
#ifndef visualServo_recording_h
#define visualServo_recording_h

#include "rows.h"

#include "outputFolder.h"

#include <visp3/core/vpImage.h>
#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/manipulator/vpArmModel.h>

#include <opencv2/videoio.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace visualServo
{
//! \brief A change of status.
struct Event {
  double time = 0.; //!< s
  std::string word;
  std::string sentence;
};

/*!
 * \brief Some of the rows that were added, evenly: every 2^k-th.
 */
template <class Row> class Thinned
{
public:
  //! \param most : Largest number of rows, even.
  explicit Thinned(std::size_t most) : m_most(most) {}
  void add(const Row &row)
  {
    if (m_count++ % m_every == 0) {
      m_rows.push_back(row);
    }
    if (m_rows.size() == m_most) { // keep every second one
      for (std::size_t i = 0; i < m_most / 2; ++i) {
        m_rows[i] = m_rows[2 * i];
      }
      m_rows.resize(m_most / 2);
      m_every *= 2;
    }
  }
  [[nodiscard]] const std::vector<Row> &rows() const { return m_rows; }
  //! Number of rows that were added.
  [[nodiscard]] std::size_t count() const { return m_count; }

private:
  std::size_t m_most, m_count = 0, m_every = 1;
  std::vector<Row> m_rows;
};

/*!
 * \brief Writes rows as they come; every flush() makes them safe against a kill. For one thread.
 *
 * `camera.mkv` holds every image without loss (FFV1): a run can be repeated from it.
 */
class Recording
{
public:
  //! \param arm : For the columns of the joints and the pose of what moves; may be null. \param rate : Images per second, for players.
  //! \param isFixed : The camera is, the end effector moves. \param scene : Names what is in the way; may be null.
  Recording(vpApp::OutputFolder &out, const vpArmModel *arm, double rate, bool isFixed = false,
            const vpCollisionScene *scene = nullptr);
  void add(CycleRow row);
  //! \param image : Null: the video was recorded before.
  void add(ImageRow row, const vpImage<unsigned char> *image);
  //! \throw std::runtime_error naming the file that cannot be written.
  void flush();
  void close();

  //! Some of the cycles, for the video.
  [[nodiscard]] const std::vector<CycleRow> &cycles() const { return m_cycles.rows(); }
  //! Some of the images.
  [[nodiscard]] const std::vector<ImageRow> &images() const { return m_images.rows(); }
  [[nodiscard]] const std::vector<Event> &events() const { return m_events; }
  [[nodiscard]] std::size_t cycleCount() const { return m_cycles.count(); }
  [[nodiscard]] std::size_t imageCount() const { return m_images.count(); }
  [[nodiscard]] const CycleRow &last() const { return m_last; }
  //! What is in the way of the arm, "link 5 and object pillar"; empty: nothing.
  [[nodiscard]] std::string obstacleOf(const CycleRow &row) const;
  //! The status of a cycle in sentences, with what stops the arm.
  [[nodiscard]] std::string sentenceOf(const CycleRow &row) const;
  [[nodiscard]] std::size_t found() const { return m_found; }
  //! File name of the video.
  static constexpr const char *VIDEO = "camera.mkv";

private:
  void openVideo(const vpImage<unsigned char> &image);
  void locate(CycleRow &row);

  vpApp::OutputFolder &m_out;
  const vpArmModel *m_arm;
  double m_rate;
  bool m_isFixed;
  const vpCollisionScene *m_scene;
  std::ofstream m_log, m_imageLog, m_eventLog;
  cv::VideoWriter m_video;
  cv::Size m_size;
  vpArmData m_data;
  vpRigidTransform m_moved; // of a robot that tells no pose: integrated
  Thinned<CycleRow> m_cycles{20000};
  Thinned<ImageRow> m_images{20000};
  std::vector<Event> m_events;
  CycleRow m_last;
  std::size_t m_recorded = 0, m_found = 0;
};
} // namespace visualServo

#endif
