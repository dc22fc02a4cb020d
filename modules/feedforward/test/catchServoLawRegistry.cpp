/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Laws of a user's own beside ours. A program of its own: what is added stays.
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/feedforward/vpServoController.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>

namespace
{
using namespace vpServoScene;
using Catch::Contains;

// Moves with its largest speed along the optical axis: shows which limits and gains arrived.
class Forward : public vpServoLaw
{
public:
  Forward(const vpServoGains &gains, const vpServoMotionLimits &motion)
    : vpServoLaw("its own name", gains), m_speed(motion.linearVelocity)
  {}

protected:
  vpServoCommand compute(const vpServoMeasurement &, double) noexcept override
  {
    return {vpTwist(m_gains.lambda, 0., m_speed, 0., 0., 0.), vpServoStatus::Servoing};
  }

private:
  double m_speed;
};

std::unique_ptr<vpServoLaw> makeForward(const vpServoGains &gains, const vpServoMotionLimits &motion)
{
  return std::make_unique<Forward>(gains, motion);
}

bool isKnown(const std::string &id)
{
  const std::vector<std::string> ids = vpServoLaw::ids();
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}
} // namespace

TEST_CASE("a law of one's own is made by its id, alone and in the controller", "[registry]")
{
  auto rng = vpTestSupport::generator(71);
  const std::vector<std::string> before = vpServoLaw::ids();
  const std::string id = "forward-" + std::to_string(before.size()); // anew at each seed
  vpServoLaw::add(id, "Goes ahead.", makeForward);
  std::vector<std::string> after = before;
  after.push_back(id);
  CHECK(vpServoLaw::ids() == after);
  CHECK(vpServoController::ids() == after);
  CHECK(vpServoLaw::sentence(id) == "Goes ahead.");

  const auto points = object(rng, 0.1, 4);
  vpServoMeasurement seen;
  measure(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.7}), points, seen);
  for (const std::string suffix : {"", "+cbf"}) {
    vpServoControllerSpec spec;
    spec.gains.lambda = uniform(rng, 0.01, 0.02);
    spec.motion.linearVelocity = uniform(rng, 0.01, 0.02);
    auto servo = vpServoController::create(id + suffix, spec);
    servo.setGoal(goal(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5}), points));
    const vpServoCommand command = servo.step(seen, 0.01);
    CHECK(servo.law().id() == id);
    CHECK(command.status == vpServoStatus::Servoing);
    CHECK(command.v[0] == Approx(spec.gains.lambda));
    CHECK(command.v[2] == Approx(spec.motion.linearVelocity));
    CHECK(servo.step(vpServoMeasurement(), 0.01).status == vpServoStatus::Holding); // recovery works behind it
  }
}

TEST_CASE("every id has a sentence", "[registry]")
{
  std::set<std::string> sentences;
  for (const std::string &id : vpServoLaw::ids()) {
    CAPTURE(id);
    const std::string sentence = vpServoLaw::sentence(id);
    CHECK(sentence.size() > 10);
    CHECK(sentence.back() == '.');
    CHECK(sentences.insert(sentence).second);
  }
  CHECK_THROWS_WITH(vpServoLaw::sentence("pvbs"), Contains("servo law \"pvbs\" is unknown, known are: pbvs1, "));
}

TEST_CASE("malformed, used and empty entries are refused and change nothing", "[registry][errors]")
{
  const std::vector<std::string> before = vpServoLaw::ids();
  CHECK_THROWS_WITH(vpServoLaw::add("pbvs1", "Mine.", makeForward), "servo law \"pbvs1\" is registered already");
  const std::string tooLong(65, 'a');
  for (const std::string &id :
       {"", "mine+cbf", "a,b", "1st", "-a", "a b", "a\n", "\xc3\xa4", "a\x1b[2J", tooLong.c_str()}) {
    CAPTURE(id);
    CHECK_THROWS_WITH(vpServoLaw::add(id, "Mine.", makeForward), Contains("must have an id of a letter and up to 63"));
  }
  for (const char *sentence : {"", "two\nlines", "\x1b[2J", "\xff"}) {
    CHECK_THROWS_WITH(vpServoLaw::add("mine", sentence, makeForward),
                      "servo law \"mine\" must have a sentence, one printable line");
  }
  CHECK_THROWS_WITH(vpServoLaw::add("mine", "Mine.", nullptr), "servo law \"mine\" has no maker");
  CHECK(vpServoLaw::ids() == before);
}

TEST_CASE("limits are validated before a maker sees them, and its errors arrive", "[registry][errors]")
{
  vpServoMotionLimits motion;
  motion.linearVelocity = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(vpServoLaw::create("pbvs1", {}, motion),
                    Contains("linearVelocity of the servo motion limits is nan"));
  vpServoLaw::add("none", "Makes nothing.", [](const vpServoGains &, const vpServoMotionLimits &) { return nullptr; });
  CHECK_THROWS_WITH(vpServoLaw::create("none"), "the maker of servo law \"none\" returned none");
  vpServoLaw::add("refuses", "Never works.",
                  [](const vpServoGains &, const vpServoMotionLimits &) -> std::unique_ptr<vpServoLaw> {
                    throw std::runtime_error("no licence");
                  });
  CHECK_THROWS_WITH(vpServoLaw::create("refuses+cbf"), Contains("is unknown"));
  CHECK_THROWS_WITH(vpServoController::create("refuses+cbf"), "no licence");
}

TEST_CASE("threads add, list and make laws at the same time", "[registry]")
{
  const std::size_t before = vpServoLaw::ids().size();
  constexpr int threads = 8, each = 25;
  std::vector<int> added(threads, 0), made(threads, 0);
  std::vector<std::thread> all;
  for (int t = 0; t < threads; ++t) {
    all.emplace_back([t, &added, &made] {
      for (int i = 0; i < each; ++i) {
        try { // two threads want each id
          vpServoLaw::add("shared-" + std::to_string(t / 2) + "-" + std::to_string(i), "One of many.", makeForward);
          ++added[t];
        }
        catch (const vpException &) {
        }
        for (const std::string &id : {vpServoLaw::ids().back(), std::string("ff-sum")}) {
          made[t] += vpServoLaw::create(id)->id() == id ? 1 : 0;
        }
      }
    });
  }
  for (std::thread &thread : all) {
    thread.join();
  }
  int sum = 0;
  for (int t = 0; t < threads; ++t) {
    sum += added[t];
    CHECK(made[t] == 2 * each);
  }
  CHECK(sum == threads / 2 * each);
  CHECK(vpServoLaw::ids().size() == before + threads / 2 * each);
  CHECK(isKnown("shared-3-24"));
}
