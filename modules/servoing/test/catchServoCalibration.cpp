/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Camera parameters and poses as ViSP writes them; ViSP's own writers are the oracle.
#include "vpCatch.h"
#include "vpTestArms.h"
#include "vpTestFile.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpPoseVector.h>
#include <visp3/core/vpXmlParserCamera.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/servoing/vpServoCalibration.h>

#include <cstdio>
#include <fstream>

namespace
{
std::string messageOf(const std::function<void()> &call)
{
  try {
    call();
  }
  catch (const vpException &error) {
    return error.getStringMessage();
  }
  return "";
}

std::string poseMessage(const std::string &content)
{
  const vpTestSupport::File file("pose.txt", content);
  return messageOf([&file]() { static_cast<void>(vpLoadPose(file.name())); });
}

const std::string twoCameras = R"(<?xml version="1.0"?>
<root>
  <!-- two of them -->
  <camera>
    <name>left</name><image_width>640</image_width><image_height>480</image_height>
    <model><type>perspectiveProjWithoutDistortion</type><px>600</px><py>601</py><u0>320</u0><v0>240</v0></model>
    <model><type>perspectiveProjWithDistortion</type>
      <px>610</px><py>611</py><u0>321</u0><v0>241</v0><kud>-0.1</kud><kdu>0.11</kdu></model>
  </camera>
  <camera>
    <name>right</name><image_width>320</image_width><image_height>240</image_height>
    <model><type>perspectiveProjWithoutDistortion</type><px>300</px><py>301</py><u0>160</u0><v0>120</v0></model>
  </camera>
</root>
)";
} // namespace

TEST_CASE("Poses come back from every file in which ViSP writes them", "[servoing]")
{
  const std::string file = "catchServoCalibration-pose";
  for (int i = 0; i < vpTestSupport::longer(200); ++i) {
    std::mt19937_64 rng = vpTestSupport::generator(static_cast<unsigned int>(i));
    vpRigidTransform pose;
    pose.R = vpSO3::exp(vpTestArms::uniform(rng, 0., 3.1) * vpTestArms::randomVector(3, rng).normalized());
    pose.p = 2. * vpTestArms::randomVector(3, rng);
    const vpHomogeneousMatrix M = pose.toHomogeneous();
    const vpPoseVector vector(M);
    switch (i % 4) {
    case 0:
      vpPoseVector::saveYAML(file, vector, "# eMc\n");
      break;
    case 1:
      vpHomogeneousMatrix::saveYAML(file, M);
      break;
    case 2: {
      std::ofstream stream(file);
      M.save(stream);
      break;
    }
    default: {
      std::ofstream stream(file);
      vpPoseVector copy = vector;
      copy.save(stream);
      break;
    }
    }
    const vpRigidTransform read = vpLoadPose(file);
    CAPTURE(i);
    CHECK((read.R - pose.R).norm() < 2e-5); // six digits
    CHECK((read.p - pose.p).norm() < 2e-5);
    CHECK((read.R * read.R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-14);
  }
  std::remove(file.c_str());
}

TEST_CASE("A file that has no pose is refused with a sentence", "[servoing]")
{
  CHECK(messageOf([]() { static_cast<void>(vpLoadPose("absent.yaml")); }) ==
        "absent.yaml: cannot be read (there is no such file)");
  CHECK_THAT(poseMessage("1 2 3"), Catch::EndsWith("has 3 numbers, must have 6 (translation, theta u) or 16 (a 4 x 4 "
                                                   "matrix)"));
  CHECK_THAT(poseMessage("1 0 0 0  0 1 0 0  0 0 1.01 0  0 0 0 1"),
             Catch::EndsWith("its upper left 3 x 3 numbers are no rotation"));
  CHECK_THAT(poseMessage("1 0 0 0  0 1 0 0  0 0 -1 0  0 0 0 1"),
             Catch::EndsWith("its upper left 3 x 3 numbers are no rotation"));
  CHECK_THAT(poseMessage("1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 2"), Catch::EndsWith("its last row is not 0 0 0 1"));
  CHECK_THAT(poseMessage("rows: 6\ncols: 1\ndata:\n  - [0]\n  - [nan]\n"),
             Catch::EndsWith("number 2 is \"nan\", must be a finite number"));
  CHECK_THAT(poseMessage("0 0 0 0 0 x"), Catch::EndsWith("number 6 is \"x\", must be a finite number"));
  CHECK_THAT(poseMessage("0 0 0 90 0 0"), Catch::EndsWith("is no rotation vector in rad: its angle is 90.000000"));
  CHECK_THAT(poseMessage("0 2000 0 1 0 0"), Catch::EndsWith("its translation is longer than 1000 m"));
}

TEST_CASE("Camera parameters come back from the XML that ViSP writes", "[servoing]")
{
  const std::string file = "catchServoCalibration-camera.xml";
  for (int i = 0; i < vpTestSupport::longer(20); ++i) {
    std::mt19937_64 rng = vpTestSupport::generator(static_cast<unsigned int>(i));
    const auto random = [&rng](double low, double high) { return vpTestArms::uniform(rng, low, high); };
    vpCameraParameters camera(random(100., 2000.), random(100., 2000.), random(10., 900.), random(10., 900.));
    if (i % 2 == 0) {
      camera.initPersProjWithDistortion(camera.get_px(), camera.get_py(), camera.get_u0(), camera.get_v0(),
                                        random(-0.5, 0.5), random(-0.5, 0.5));
    }
    std::remove(file.c_str());
    vpXmlParserCamera writer;
    REQUIRE(writer.save(camera, file, "Camera", 640, 480) == vpXmlParserCamera::SEQUENCE_OK);
    const vpCalibratedCamera read = vpLoadCalibratedCamera(file, "Camera", 640, 480);
    CHECK(read.parameters == camera);
    CHECK(read.name == "Camera");
    CHECK(read.width == 640);
    CHECK(read.height == 480);
  }
  std::remove(file.c_str());
}

TEST_CASE("Of several cameras one is chosen by name or size, of several models the one with distortion", "[servoing]")
{
  const vpTestSupport::File file("cameras.xml", twoCameras);
  CHECK(vpLoadCalibratedCamera(file.name(), "left").parameters.get_kud() == -0.1);
  CHECK(vpLoadCalibratedCamera(file.name(), "left").parameters.get_px() == 610.);
  CHECK(vpLoadCalibratedCamera(file.name(), "", 320, 240).parameters.get_px() == 300.);
  CHECK_THAT(messageOf([&file]() { static_cast<void>(vpLoadCalibratedCamera(file.name())); }),
             Catch::EndsWith("has more than one camera; there are: left (640 x 480 px), right (320 x 240 px)"));
  CHECK_THAT(messageOf([&file]() { static_cast<void>(vpLoadCalibratedCamera(file.name(), "middle", 640, 480)); }),
             Catch::EndsWith("has no camera with the name middle for 640 x 480 px; there are: left (640 x 480 px), "
                             "right (320 x 240 px)"));
}

TEST_CASE("A file that has no camera is refused with a sentence", "[servoing]")
{
  const auto message = [](std::string content, const std::string &from, const std::string &to) {
    const std::size_t at = content.find(from);
    REQUIRE(at != std::string::npos);
    const vpTestSupport::File file("camera.xml", content.replace(at, from.size(), to));
    return messageOf([&file]() { static_cast<void>(vpLoadCalibratedCamera(file.name(), "left")); });
  };
  CHECK(messageOf([]() { static_cast<void>(vpLoadCalibratedCamera("absent.xml")); }) ==
        "absent.xml: cannot be read (there is no such file)");
  CHECK_THAT(message(twoCameras, twoCameras, "no XML"),
             Catch::EndsWith("line 1, column 1: is no XML, which begins with <"));
  CHECK_THAT(message(twoCameras, twoCameras, "<root></root>"), Catch::EndsWith("has no camera with the name left"));
  CHECK_THAT(message(twoCameras, "</model>", ""), Catch::Contains("does not end element model"));
  CHECK_THAT(message(twoCameras, "<px>610</px>", "<px>-610</px>"),
             Catch::EndsWith("px and py are -610 and 611, must be >= 0.001"));
  CHECK_THAT(message(twoCameras, "<py>611</py>", ""), Catch::EndsWith("py is \"\", must be a finite number"));
  CHECK_THAT(message(twoCameras, "<image_width>640<", "<image_width>0<"),
             Catch::EndsWith("image_width is 0, must be whole and 1..1000000"));
  const std::string fish = R"(<root><camera><name>left</name><model><type>ProjWithKannalaBrandtDistortion</type></model>
                              </camera></root>)";
  CHECK_THAT(message(fish, "left", "left"),
             Catch::EndsWith("projection model ProjWithKannalaBrandtDistortion is not supported, must be "
                             "perspectiveProjWithDistortion or perspectiveProjWithoutDistortion"));
}
