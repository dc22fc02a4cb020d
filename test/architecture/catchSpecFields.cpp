/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The table of fields of each specification against its header and its validate().
#include "vpCatch.h"

#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/feedforward/vpServoMotionLimits.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/rendering/vpProductPatternSpec.h>
#include <visp3/servoing/vpReferencePose.h>
#include <visp3/servoing/vpVisualServo.h>
#include <visp3/simulation/vpServoPlant.h>
#include <visp3/trajectory/vpTwistShaper.h>

#include <visp3/core/vpException.h>

#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace
{
//! Comments of the members of a struct, continuation lines joined: "Columns of the image, px, 8..16384."
std::map<std::string, std::string> membersOf(const std::string &header, const std::string &type)
{
  std::ifstream stream(std::string(VISP_DIRECT_SOURCE_DIR) + "/modules/" + header);
  REQUIRE(stream);
  std::map<std::string, std::string> comments;
  const std::regex member(R"(^  (?:double|unsigned int) (\w+) = [^;]*; *//!< (.*)$)"), more(R"(^ +//!< (.*)$)");
  std::string line, last;
  bool inside = false;
  while (std::getline(stream, line)) {
    inside = inside ? line != "};" : line == "struct VISP_EXPORT " + type + " {";
    std::smatch found;
    if (inside && std::regex_match(line, found, member)) {
      last = found[1];
      comments[last] = found[2];
    }
    else if (inside && !last.empty() && std::regex_match(line, found, more)) {
      comments[last] += " " + found[1].str();
    }
    else {
      last.clear();
    }
  }
  return comments;
}

template <class Spec> std::string refusalOf(const Spec &spec)
{
  try {
    spec.validate();
  }
  catch (const vpException &error) {
    CHECK(error.getCode() == vpException::badValue);
    return error.getStringMessage();
  }
  return "";
}

template <class Spec> void check(const std::string &header, const std::string &type, std::size_t count)
{
  const std::map<std::string, std::string> comments = membersOf(header, type);
  CAPTURE(type);
  REQUIRE(Spec::fields().size() == count);
  for (const vpField<Spec> &field : Spec::fields()) {
    const std::string unit = field.unit, required = std::string(field.description) + ", " +
                                                    (unit.empty() ? "" : unit + ", ") + field.range.text() + ".";
    CAPTURE(field.name, required);
    REQUIRE(comments.count(field.name) == 1);
    CHECK(comments.at(field.name).compare(0, required.size(), required) == 0);

    CHECK(field.range.contains(field.of(Spec())));
    const bool whole = std::holds_alternative<unsigned int Spec::*>(field.member);
    std::vector<double> outside;
    if (std::isfinite(field.range.low)) {
      outside.push_back(field.range.open ? field.range.low : field.range.low - std::fabs(field.range.low) * 1e-6 - 1.);
    }
    if (std::isfinite(field.range.high)) {
      outside.push_back(field.range.high * (1. + 1e-6) + 1.);
    }
    outside.insert(outside.end(), {NAN, -INFINITY});
    if (!field.range.infinite) {
      outside.push_back(INFINITY);
    }
    for (const double value : outside) {
      CHECK_FALSE(field.range.contains(value));
      if (whole && !(value >= 0. && value <= 4294967295.)) {
        continue; // the member cannot have it
      }
      Spec spec;
      field.set(spec, value);
      CHECK(refusalOf(spec).find(std::string(field.name) + " ") == 0);
      CHECK(refusalOf(spec).find(field.range.text()) != std::string::npos);
    }
  }
  CHECK(refusalOf(Spec()) == "");
}
} // namespace

TEST_CASE("Header, table and validate() of a specification say the same", "[fields]")
{
  check<vpServoGains>("feedforward/include/visp3/feedforward/vpServoLaw.h", "vpServoGains", 7);
  check<vpServoPlant>("simulation/include/visp3/simulation/vpServoPlant.h", "vpServoPlant", 8);
  check<vpCameraFaults>("rendering/include/visp3/rendering/vpPlaneRenderer.h", "vpCameraFaults", 5);
  check<vpServoMotionLimits>("feedforward/include/visp3/feedforward/vpServoMotionLimits.h", "vpServoMotionLimits", 6);
  check<vpReferencePoseSpec>("servoing/include/visp3/servoing/vpReferencePose.h", "vpReferencePoseSpec", 6);
  check<vpVisualServoSpec>("servoing/include/visp3/servoing/vpVisualServo.h", "vpVisualServoSpec", 13);
  check<vpTwistShaperLimits>("trajectory/include/visp3/trajectory/vpTwistShaper.h", "vpTwistShaperLimits", 4);
  check<vpProductPatternSpec>("rendering/include/visp3/rendering/vpProductPatternSpec.h", "vpProductPatternSpec", 25);
}

TEST_CASE("Ranges and names of fields", "[fields]")
{
  CHECK(vpFieldRange().text() == "finite");
  CHECK(vpFieldRange::positive().text() == "> 0");
  CHECK(vpFieldRange::positive(1e6).text() == "> 0, <= 1000000");
  CHECK(vpFieldRange::notNegative().text() == ">= 0");
  CHECK(vpFieldRange{1e-6, 1e12, false, true}.text() == "1e-06..1e+12 or infinite");
  CHECK(vpFieldRange::positive(2.).contains(2.));
  CHECK_FALSE(vpFieldRange::positive().contains(0.));
  CHECK(vpFieldRange::notNegative().contains(0.));
  CHECK_FALSE(vpFieldRange::notNegative().contains(INFINITY));
  CHECK(vpFieldRange{1., 2., false, true}.contains(INFINITY));
  CHECK_FALSE(vpFieldRange{1., 2., false, true}.contains(-INFINITY));
  CHECK(vpFieldFileName("integralLimit", "rad/s") == "integral_limit_radps");
  CHECK(vpFieldFileName("linearJerk", "m/s^3") == "linear_jerk_mps3");
  CHECK(vpFieldFileName("lambda", "1/s") == "lambda");
  CHECK(vpFieldFileName("pitchX", "") == "pitch_x");
  CHECK_THROWS_WITH(vpCheckField("width", "the image", 4., "px", {8., 16.}),
                    "width of the image is 4 px, must be 8..16");
  CHECK_THROWS_WITH(vpCheckField("gain", "", INFINITY, "", vpFieldRange::positive()),
                    "gain is inf, must be > 0 and finite");
}
