/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-track-pattern.
 */
#ifndef trackPattern_options_h
#define trackPattern_options_h

#include <visp3/pattern/vpCalibrationPoint.h>
#include <visp3/pattern/vpPatternTrackerSpec.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace trackPattern
{
//! Format of the result overlays.
enum class OverlayKind { None, Png, Mp4 };

//! \brief Region of the images, px.
struct Roi {
  unsigned int x = 0, y = 0, width = 0, height = 0;
};

//! \brief User options.
struct Options {
  std::vector<std::string>
      inputs;         //!< Files, one folder, one pattern or one video; empty: a camera or the program's own sequence.
  std::string camera; //!< "/dev/video0"; empty: none.
  std::string out = "out/track-pattern";
  unsigned int frames = 0; //!< Maximum number of frames; 0: all (own sequence: 200, camera: 300).
  std::optional<Roi> roi;
  vpPatternTrackerSpec tracker;
  OverlayKind overlay = OverlayKind::Mp4;
  double videoRate = 25.;                //!< Frames per second of the overlay video, 1..240.
  std::string calibration;               //!< File; empty: none.
  std::string cameraName = "microscope"; //!< Name of the camera in an XML file.
  bool calibrate = false;                //!< Write calibration.json and calibration.xml.
  bool dotGrid = false;                  //!< Each image shows a static grid of dots.
  vpCalibrationPitch pitch;              //!< Pitch of the product or the grid, m.
  bool display = false;                  //!< Show the overlay in a window.
  unsigned int seed = 1;                 //!< Seed of the program's own sequence.
};

/*!
 * Read the command line.
 * \return False when the program has nothing left to do (`--help`, `--version`).
 * \throw vpApp::UsageError naming the option and its value.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);
} // namespace trackPattern

#endif
