/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Wrong input of visp-servo: one sentence, the right exit status, and nothing left behind.
#include "vpCatch.h"

#include "programRun.h"

#include <opencv2/imgcodecs.hpp>

#include <string>
#include <vector>

namespace
{
constexpr int DATA = 1, USAGE = 2;

struct Case {
  std::string arguments;
  int status;
  std::string sentence;
};
} // namespace

TEST_CASE("wrong input is one sentence", "[visp-servo][errors]")
{
  ProgramRun run(SERVO);
  run.write("text.png", "no picture");
  run.write("wrong.xml", "<root><camera></root>");
  run.write("other.xml", "<?xml version=\"1.0\"?>\n<root></root>\n");
  run.write("two.urdf", "<robot name='two'><link name='a'/><link name='b'/><link name='c'/>"
                        "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"
                        "<joint name='k' type='fixed'><parent link='a'/><child link='c'/></joint></robot>");
  run.write("unsized.xml",
            "<root><camera><name>Camera</name><model><type>perspectiveProjWithoutDistortion</type><px>500</px>"
            "<py>500</py><u0>320</u0><v0>240</v0></model></camera></root>");
  run.write("noRotation.yaml",
            "rows: 4\ncols: 4\ndata:\n  - [1, 0, 0, 0]\n  - [0, 2, 0, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n");
  run.write("busy/mine.txt", "do not touch");
  run.write("notes.txt", "x");
  cv::imwrite(run.path("blank.png").string(), cv::Mat(100, 100, CV_8UC1, cv::Scalar(128)));
  cv::imwrite(run.path("frame.png").string(), cv::Mat(100, 120, CV_8UC1, cv::Scalar(128)));
  cv::Mat texture(100, 120, CV_8UC1);
  cv::randu(texture, 0, 255);
  cv::imwrite(run.path("textured.png").string(), texture);
  const std::vector<Case> cases = {
      {"--target missing.png --size 0.1", DATA, "missing.png: cannot be read"},
      {"--target text.png --size 0.1", DATA, "text.png: is not an image"},
      {"--target blank.png --size 0.1", DATA, "blank.png: "},
      {"--target frame.png", USAGE, "--target is given without --size"},
      {"--size 0", USAGE, "--size is 0, must be a number > 0"},
      {"--size 0.1,0.1,0.1", USAGE, "--size is 0.1,0.1,0.1, must be WIDTH or WIDTH,HEIGHT"},
      {"--size nan", USAGE, "--size is nan"},
      {"--eMc missing.yaml", DATA, "missing.yaml"},
      {"--eMc noRotation.yaml", DATA, "noRotation.yaml"},
      {"--camera frame.png --camera-xml missing.xml", DATA, "missing.xml"},
      {"--camera frame.png --camera-xml wrong.xml", DATA, "wrong.xml"},
      {"--camera frame.png --camera-xml other.xml", DATA, "other.xml"},
      {"--camera none.mp4", DATA, "none.mp4: there is no such file or folder"},
      {"--camera notes.txt", DATA, "notes.txt: is not a video that can be read"},
      {"--camera 9999", DATA, "/dev/video9999: the camera cannot be opened (No such file or directory)"},
      {"--robot franka --camera sim --eMc x.yaml", DATA, "the installed ViSP was built without vpRobotFranka"},
      {"--robot robbie --eMc x.yaml", USAGE, "--robot is robbie, which is no file and no robot of ViSP"},
      {"--robot robbie --camera 0", USAGE, "--robot is robbie, which is no file"},
      {"--robot franka", DATA, "the installed ViSP was built without vpRobotFranka"},
      {"--camera-xml missing.xml", DATA, "missing.xml"},
      {"--camera-xml unsized.xml", DATA, "unsized.xml: does not state the size of the images"},
      {"--robot two.urdf --robot-tip nobody", DATA,
       "two.urdf: --robot-tip is nobody, must be one of the links a, b, c"},
      {"--robot two.urdf", DATA, "two.urdf: --robot-tip must be one of the links b, c: the end effector is not unique"},
      {"--robot two.urdf --robot-tip b --camera-link cam", DATA, "two.urdf: --camera-link is cam, must be one of"},
      {"--robot-plugin mine.so --camera frame.png", USAGE, "needs --camera-xml"},
      {"--robot-plugin missing.so --camera sim", DATA, "missing.so: no such file"},
      {"--robot-plugin '" ROBOT_NULL "' --camera sim", DATA, "gave no robot"},
      {"--robot-plugin '" ROBOT_THROWS "' --camera sim --robot-arguments 10.0.0.1", DATA,
       "no robot answers at 10.0.0.1"},
      {"--robot none --camera sim", USAGE, "--camera sim needs a robot that carries it"},
      {"--law nonsense", USAGE, "--law: servo law \"nonsense\" is unknown"},
      {"--law pbvs1,nonsense", USAGE, "--law: servo law \"nonsense\" is unknown"},
      {"--law ff-dtg+cbf", USAGE, "--law: \"ff-dtg+cbf\": the view filter cannot follow a law that plans"},
      {"extra", USAGE, "unexpected argument \"extra\""},
      {"--lamda 2", USAGE, "there is no option --lamda, did you mean --lambda?"},
      {"--lambda 0", USAGE, "--lambda is 0, must be a number > 0"},
      {"--max-linear inf", USAGE, "--max-linear is inf"},
      {"--goal missing.json", DATA, "missing.json: cannot be read"},
      {"--goal-pose 0,0,-1,0,0,0", USAGE, "--goal-pose must have Z > 0"},
      {"--goal-pose 0,0,1", USAGE, "--goal-pose is 0,0,1, must be six numbers"},
      {"--goal g.json --goal-pose 0,0,1,0,0,0", USAGE, "--goal and --goal-pose are both given"},
      {"--tag 36h11:0", USAGE, "--tag is given without --size"},
      {"--tag 36h11:0 --size 0.1", USAGE, "--tag needs a camera or recorded images, and --camera is sim"},
      {"--tag nothing --size 0.1", USAGE, "--tag is nothing, must be FAMILY:ID"},
      {"--reference r.png --goal g.json", USAGE, "--reference is the goal itself"},
      {"--reference missing.png", DATA, "missing.png: cannot be read"},
      {"--distance 2,1 --reference r.png", USAGE, "--distance is 2,1, must be MIN,MAX"},
      {"--start --dry-run", USAGE, "--start and --dry-run are both given"},
      {"--replay none", DATA, "none/recording.json: cannot be read"},
      {"--teach none/goal.json", DATA, "none"},
      {"--teach goal.txt", USAGE, "--teach is goal.txt, must be a .json file"},
      {"--teach goal.json --reference frame.png", USAGE, "--teach and --reference are both given"},
      {"--teach none/there.png", DATA, "none"},
      {"--teach there.png --camera blank.png", DATA, "blank.png: reference image has too little texture"},
      {"--teach there.png --camera textured.png", DATA, "textured.png gave no 25 images in succession"},
      {"--eye-to-hand --eMc x.yaml", USAGE, "--eMc is for a camera on the end effector"},
      {"--eye-to-hand --moving-target", USAGE, "--moving-target needs a camera on the robot"},
      {"--eye-to-hand --camera frame.png --robot amor", USAGE, "--eye-to-hand needs --fMc"},
      {"--fMc missing.yaml", DATA, "missing.yaml: cannot be read"},
      {"--fMc noRotation.yaml", DATA, "noRotation.yaml: its upper left 3 x 3 numbers are no rotation"},
      {"--scene missing.json", DATA, "missing.json: cannot be read"},
      {"--scene busy/mine.txt", DATA, "mine.txt: line 1"},
      {"--scene s.json --robot camera", USAGE, "--scene needs the model of the arm, --robot is camera"},
      {"--scene s.json --teach goal.json", USAGE, "--scene is for a robot that moves"},
      {"--margin 0.02", USAGE, "--margin is given without --scene"},
      {"--out busy", DATA, "busy"},
      {"--out notes.txt", DATA, "notes.txt"},
      {"--display", DATA, "--display needs a screen"}};
  for (const Case &one : cases) {
    CAPTURE(one.arguments, run.err());
    CHECK(run(one.arguments + (one.arguments.find("--out") == std::string::npos ? " --out new" : ""), "DISPLAY=") ==
          one.status);
    CHECK(run.err().rfind("visp-servo: ", 0) == 0);
    CHECK(run.err().find(one.sentence) != std::string::npos);
    CHECK(run.err().find('\n') == run.err().size() - 1);
    CHECK(!std::filesystem::exists(run.path("new")));
  }
  CHECK(vpApp::readFile(run.path("busy/mine.txt")) == "do not touch");
}
