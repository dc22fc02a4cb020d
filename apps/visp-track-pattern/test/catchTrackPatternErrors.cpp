/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Bad use of the program: exit status, sentences, nothing written.
#include "trackPatternRun.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <filesystem>

using namespace trackPatternRun;

TEST_CASE("Bad use ends with a sentence and nothing written", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  std::filesystem::create_directory(run.path("mine"));
  run.write("mine/notes.txt", "precious");
  cv::Mat small(100, 160, CV_8UC1);
  cv::randu(small, 0, 255);
  cv::imwrite(run.path("good.png").string(), small);
  cv::imwrite(run.path("tiny.png").string(), small(cv::Rect(0, 0, 8, 8)));
  run.write("cut.png", vpApp::readFile(run.path("good.png")).substr(0, 3000));
  run.write("film.mp4", "no film");
  run.write("bad.json", R"({"scale_x_px_per_m": 2e5, "width": 640, "height": 480})");
  const std::size_t entries = run.entries().size();
  struct Case {
    std::string arguments;
    int status;
    std::string sentence;
  };
  const std::vector<Case> cases = {
      {"--nonsense", USAGE, "--nonsense"},
      {"--frames 0", USAGE, "--frames is 0, must be a whole number from 1 to 10000000"},
      {"--frames few", USAGE, "--frames"},
      {"--roi 1,2,3", USAGE, "--roi is 1,2,3, must be X,Y,WIDTH,HEIGHT in whole pixels, at least 16 x 16"},
      {"--roi 0,0,8,8", USAGE, "--roi is 0,0,8,8"},
      {"--roi ' 0,0,20,20'", USAGE, "--roi is 0,0,20,20, must be"},
      {"--roi -1,0,20,20", USAGE, "--roi"},
      {"--method best", USAGE, "--method is best, must be gauss-newton, half-maximum, thesis or thesis-fixed"},
      {"--threshold 128", USAGE, "--threshold is 128, must be otsu, isodata or minimum-error"},
      {"--derivative scharr", USAGE, "--derivative is scharr, must be symmetric, roberts, prewitt or sobel"},
      {"--polarity grey", USAGE, "--polarity is grey, must be automatic, bright or dark"},
      {"--overlay gif", USAGE, "--overlay is gif, must be none, png or mp4"},
      {"--video-rate 0", USAGE, "--video-rate is 0"},
      {"--out ''", USAGE, "--out"},
      {"--calibrate", USAGE, "--calibrate needs --pitch-um X Y"},
      {"--calibrate --pitch-um 220 -80", USAGE, "--pitch-um is -80, must be a number > 0"},
      {"--calibrate --pitch-um 220 80 --pitch-sigma-um -1", USAGE, "--pitch-sigma-um is -1, must be a number >= 0"},
      {"--pitch-um 220 80", USAGE, "--pitch-um is given without --calibrate"},
      {"--calibrate --pitch-um 1 1 --calibration x.json", USAGE, "not both in one run"},
      {"--camera 0 good.png", USAGE, "--camera and the input good.png are both given"},
      {"/dev/videofront", USAGE, "--camera is /dev/videofront, must be a number or /dev/videoN"},
      {"--camera front", USAGE, "--camera is front, must be a number or /dev/videoN"},
      {"--camera 9999", DATA, "/dev/video9999: the camera cannot be opened (No such file or directory)"},
      {"/dev/video9999", DATA, "/dev/video9999: the camera cannot be opened (No such file or directory)"},
      {"good.png --threads 0", USAGE, "--threads is 0"},
      {"none", DATA, "none: there is no such file or folder"},
      {"none.png", DATA, "none.png: there is no such file or folder"},
      {"good.png none.png", DATA, "none.png: cannot be read (there is no such file)"},
      {"mine", DATA, "mine: the folder holds no images"},
      {"'x%04d.png'", DATA, "x%04d.png: no file has such a name"},
      {"'x%s.png'", DATA, "x%s.png: is no pattern"},
      {"cut.png", DATA, "cut.png: is not an image that can be read, or is cut short"},
      {"film.mp4", DATA, "film.mp4: is not a video that can be read"},
      {"tiny.png", DATA, "width of the pattern tracker's image is 8 px, must be 16..16384"},
      {"good.png --roi 100,0,100,50", DATA, "--roi 100,0,100,50 does not lie in good.png of 160 x 100 px"},
      {"good.png --calibration none.json", DATA, "none.json: cannot be read"},
      {"good.png --calibration none.xml", DATA, "none.xml: cannot be read"},
      {"good.png --calibration bad.json", DATA, "bad.json: is for images of 640 x 480 px, these have 160 x 100 px"},
      {"good.png --out mine", DATA, "mine: is not empty and not a result of visp-track-pattern"},
      {"good.png --out bad.json", DATA, "bad.json: exists and is not a folder"},
      {"good.png --out /proc/none/out", DATA, "/proc/none/out: cannot be written"},
  };
  for (const Case &bad : cases) {
    CAPTURE(bad.arguments);
    CHECK(run(bad.arguments) == bad.status);
    CAPTURE(run.err());
    const std::size_t sentence = run.err().rfind("visp-track-pattern: ");
    CHECK((sentence == 0 || (sentence != std::string::npos && run.err()[sentence - 1] == '\n')));
    CHECK(std::count(run.err().begin(), run.err().end(), '\n') <= 5); // the message, and progress at every quarter
    CHECK(run.err().find(bad.sentence) != std::string::npos);
    CHECK(run.out().empty());
    CHECK(run.entries().size() == entries);
  }
  CHECK(run("good.png --display", "DISPLAY=") == DATA);
  CHECK(run.err().find("--display needs") != std::string::npos);
  CHECK(vpApp::readFile(run.path("mine/notes.txt")) == "precious");
  CHECK(run("--help") == OK);
  CHECK(run.out().find("--pitch-um") != std::string::npos);
  CHECK(run("--version") == OK);
}
