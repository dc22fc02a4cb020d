/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "servoRows.h"

#include "numberText.h"
#include "visp-servo-compare/plan.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>

namespace thesisReport
{
double yawError(const vpServoRun &run)
{
  double sum = 0.;
  for (const vpServoSample &s : run.samples) {
    sum += std::pow(vpMath::deg(s.yaw - s.goalYaw), 2);
  }
  return std::sqrt(sum / static_cast<double>(run.samples.size()));
}

std::vector<double> peakReferences(const vpServoRun &run)
{
  std::vector<double> peaks;
  double before = 0., goal = 0.; // yaw
  for (const vpServoSample &s : run.samples) {
    if (peaks.size() <= static_cast<std::size_t>(s.segment)) {
      peaks.push_back(0.);
      before = goal;
    }
    goal = s.goalYaw;
    peaks.back() = std::max(peaks.back(), (s.referenceYaw - before) / (goal - before));
  }
  return peaks;
}

double peakReference(const vpServoRun &run) { return peakReferences(run).front(); }

namespace
{
const vpServoSample &endOfPose2(const vpServoRun &run)
{
  const auto next =
      std::find_if(run.samples.begin(), run.samples.end(), [](const vpServoSample &s) { return s.segment > 0; });
  return *(next - 1);
}
} // namespace

double referenceLeft(const vpServoRun &run)
{
  const double end = endOfPose2(run).time;
  double sum = 0.;
  int count = 0;
  for (const vpServoSample &s : run.samples) {
    if (s.segment == 0 && s.time > end - 1.) {
      sum += vpMath::deg(s.referenceYaw - s.goalYaw);
      ++count;
    }
  }
  return std::fabs(sum / count);
}

double yawRange(const vpServoRun &run) { return run.metrics.yaw_range_deg; }
double idealYawRange(const vpServoRun &run) { return run.metrics.ideal_yaw_range_deg; }
double inView(const vpServoRun &run) { return endOfPose2(run).inView ? 1. : 0.; }
double yawAtPose2(const vpServoRun &run) { return std::fabs(vpMath::deg(endOfPose2(run).yaw)); }

double lostAtPose2(const vpServoRun &run)
{
  const double cycle = 1. / run.spec.plant.loopRate;
  return cycle * static_cast<double>(std::count_if(run.samples.begin(), run.samples.end(),
                                                   [](const vpServoSample &s) { return s.segment == 0 && !s.inView; }));
}

double imageError(const vpServoRun &run)
{
  double sum = 0.;
  int count = 0;
  for (const vpServoSample &s : run.samples) {
    if (s.segment <= 1) {
      sum += s.imageErrorU * s.imageErrorU;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

double largestImageError(const vpServoRun &run)
{
  double largest = 0.;
  for (const vpServoSample &s : run.samples) {
    largest = s.segment <= 1 ? std::max(largest, std::fabs(s.imageErrorU)) : largest;
  }
  return largest;
}

double imageErrorLeft(const vpServoRun &run)
{
  double left = 0.;
  for (const int segment : {0, 1}) {
    double end = 0., sum = 0.;
    int count = 0;
    for (const vpServoSample &s : run.samples) {
      end = s.segment == segment ? s.time : end;
    }
    for (const vpServoSample &s : run.samples) {
      if (s.segment == segment && s.time > end - 1.) {
        sum += s.imageErrorU;
        ++count;
      }
    }
    left = std::max(left, std::fabs(sum / count));
  }
  return left;
}

Quantity equalOrBetter(const std::string &name, double ours, const std::string &reason, const std::string &note)
{
  return {name, "1", 1., ours, Tolerance::atMost(EQUAL), Good::Smaller, reason, note};
}

Quantity greater(const std::string &name, double by, double ours, const std::string &reason, const std::string &note)
{
  return {name, "1", 1. + by, ours, Tolerance::atLeast(), Good::Larger, reason, note};
}

Quantity minimal(const std::string &name, double ours, const std::string &note)
{
  return {name,
          "1",
          1. - EQUAL,
          ours,
          Tolerance::atMost(),
          Good::Smaller,
          "Centring the object asks for the rotation of the goal here, so a law that only centres turns as far.",
          note};
}

std::string inWords(Values values, const std::string &unit)
{
  return "PBVS " + vpApp::number(values[PBVS], 3) + ", Kyrki " + vpApp::number(values[KYRKI], 3) + ", feedforward " +
         vpApp::number(values[FEEDFORWARD], 3) + " " + unit + ".";
}

std::vector<Quantity> errorsLeft(const std::string &on, Values left, const Values &largest, const std::string &reason)
{
  const double scale = std::max_element(largest.begin(), largest.end(), [](const auto &a, const auto &b) {
                         return a.second < b.second;
                       })->second;
  const std::string name = "image error along u that is left in the end over the largest of the three laws, ",
                    note = "Means of the last second at pose 2 and, back, at pose 1, the larger: " +
                           inWords(left, "px of " + vpApp::number(scale, 3));
  return {{on + name + "PBVS", "1", EQUAL, left[PBVS] / scale, Tolerance::atLeast(), Good::Neither, reason, note},
          {on + name + "feedforward", "1", EQUAL, left[FEEDFORWARD] / scale, Tolerance::atMost(), Good::Smaller, reason,
           note}};
}

namespace
{
using Value = std::function<double(const vpServoRun &)>;

const std::vector<std::string> &laws()
{
  static const std::vector<std::string> all = {PBVS, KYRKI, FEEDFORWARD};
  return all;
}

//! Runs of the three laws under one condition.
class Runs
{
public:
  //! \param change : Changes the specification that visp-servo-compare has for plant and robot.
  Runs(const Setting &setting, const servoCompare::RobotOptions &robot, const std::string &plant,
       const std::function<void(vpServoRunSpec &)> &change, const std::function<void()> &done)
  {
    servoCompare::Options options;
    options.laws = laws();
    options.plants = {plant};
    options.measures = {"points"};
    options.seed = setting.seed;
    options.robot = robot;
    for (vpServoRunSpec spec : servoCompare::makePlan(options).runs) {
      change(spec);
      m_runs.push_back(runServoExperiment(spec));
      done();
    }
  }
  [[nodiscard]] Values values(const Value &value) const
  {
    Values all;
    for (const vpServoRun &run : m_runs) {
      all[run.spec.law] = value(run);
    }
    return all;
  }

private:
  std::vector<vpServoRun> m_runs;
};

Item *itemWith(const std::string &id, std::vector<Item> &items)
{
  const auto found = std::find_if(items.begin(), items.end(), [&](const Item &item) { return item.id == id; });
  return found == items.end() ? nullptr : &*found;
}

//! Adds rows to an item if it is wanted.
void add(const std::string &id, std::vector<Quantity> rows, std::vector<Item> &items)
{
  if (Item *const item = itemWith(id, items)) {
    item->quantities.insert(item->quantities.end(), rows.begin(), rows.end());
  }
}

constexpr const char *ARM_PLANT = "B"; // the friction of the arm's file

void addArm(const std::string &drive, const Runs &runs, std::vector<Item> &items)
{
  const bool measured = drive == "measured";
  const std::string on = std::string("AMOR, drives ") +
                         (measured ? "from the measured position (3.18)" : "that integrate in open loop") + ": ";
  const std::string reason = measured ? ""
                                      : "Drives that integrate commands in open loop push sticking joints loose: all "
                                        "laws reach their goals, and the "
                                        "image error of feedforward, which would make a difference, stays small.";
  Values peak = runs.values(peakReference), left = runs.values(referenceLeft), range = runs.values(yawRange),
         error = runs.values(imageError), seen = runs.values(inView), yaw = runs.values(yawAtPose2);
  const std::string peaks = "Peak over goal: " + inWords(peak, "");
  add("fig5.8",
      {greater(on + "peak reference, feedforward over PBVS", EQUAL, peak[FEEDFORWARD] / peak[PBVS], reason, peaks),
       greater(on + "peak reference, feedforward over kyrki-decoupled", EQUAL, peak[FEEDFORWARD] / peak[KYRKI], reason,
               peaks),
       minimal(on + "peak reference, kyrki-decoupled over PBVS", peak[KYRKI] / peak[PBVS], peaks),
       {on + "feedforward: reference minus goal at the end of pose 2", "deg", 0.5, left[FEEDFORWARD],
        Tolerance::atLeast(), Good::Neither, reason,
        "The thesis: by disturbances it does not completely die out. " + inWords(left, "deg")}},
      items);
  const std::string ranges = inWords(range, "deg of 56.8");
  add("fig5.9",
      {greater(on + "yaw range, feedforward over kyrki-decoupled", EQUAL, range[FEEDFORWARD] / range[KYRKI], reason,
               ranges),
       greater(on + "yaw range, feedforward over PBVS", SAME, range[FEEDFORWARD] / range[PBVS], reason, ranges),
       minimal(on + "yaw range, kyrki-decoupled over PBVS", range[KYRKI] / range[PBVS], ranges)},
      items);
  const std::string errors = inWords(error, "px");
  add("fig5.10",
      {equalOrBetter(on + "rms image error along u, feedforward over kyrki-decoupled",
                     error[FEEDFORWARD] / error[KYRKI], reason, errors),
       greater(on + "rms image error along u, PBVS over feedforward", EQUAL, error[PBVS] / error[FEEDFORWARD], reason,
               errors)},
      items);
  add("fig5.10",
      errorsLeft(on, runs.values(imageErrorLeft), runs.values(largestImageError), measured ? HELD_SHORT : reason),
      items);
  const auto view = [&](const char *law, const char *name, std::optional<double> thesis) {
    return Quantity{on + name + ": object in view at the end of pose 2 (1 yes, 0 no)",
                    "1",
                    thesis,
                    seen[law],
                    Tolerance::distance(0.5),
                    Good::Neither,
                    measured
                        ? "The law turns nearly as far as the goal asks: the object is off the middle, but within the "
                          "image."
                        : reason,
                    ""};
  };
  add("fig5.11",
      {view(PBVS, "PBVS", 0.), view(KYRKI, "kyrki-decoupled", std::nullopt), view(FEEDFORWARD, "feedforward", 1.),
       greater(on + "yaw at the end of pose 2, feedforward over kyrki-decoupled", SAME, yaw[FEEDFORWARD] / yaw[KYRKI],
               reason, inWords(yaw, "deg")),
       greater(on + "yaw at the end of pose 2, feedforward over PBVS", SAME, yaw[FEEDFORWARD] / yaw[PBVS], reason,
               inWords(yaw, "deg"))},
      items);
}

// "5 % standard deviation" of section 5.4.3 has no unit. Two readings: 5 % of a pixel, and 5 % of the standard deviation
// of the points about their mean in the view straight ahead.
std::map<std::string, double> noises(const vpServoTask &task)
{
  const double across = task.camera.get_px() * task.objectWidth / task.initial[2][3];
  return {{"0.05 px", 0.05}, {"5 % of the points' spread", 0.05 * across / std::sqrt(12.)}};
}

void addNoise(const std::string &noise, double px, const Runs &runs, std::vector<Item> &items)
{
  const std::string with = "noise of " + noise + " on both views: ";
  Values left = runs.values(referenceLeft), yaw = runs.values(yawError);
  std::string peaks;
  double beyond = HUGE_VAL;
  for (const std::size_t pose : {0, 1, 2}) {
    Values peak = runs.values([pose](const vpServoRun &run) { return peakReferences(run).at(pose); });
    beyond = std::min(beyond, peak[FEEDFORWARD] / peak[PBVS]);
    peaks += (pose == 0 ? "" : " Then ") + inWords(peak, "");
  }
  const std::string note = vpApp::number(px, 3) +
                           " px on u and v of 30 points, in each view and once in the view of "
                           "each pose that gives the goal; as meant in section 5.4.3, where the 5 % have no unit.";
  const std::string tie =
      "On a perfect robot the feedforward has nothing to make up for; it adds a rotation that first "
      "leads the yaw beyond its goal.";
  add("fig5.6",
      {greater(with + "peak of the feedforward's reference over that of PBVS, least of the three new poses", ROUNDING,
               beyond, "The goal itself is that noisy: the reference of PBVS goes as far beyond it.",
               "Peak over goal, pose 2: " + peaks + " " + note),
       {with + "reference of the feedforward minus that of PBVS at the end of pose 2", "deg", 0.,
        std::fabs(left[FEEDFORWARD] - left[PBVS]), Tolerance::atMost(0.5), Good::Smaller, "",
        "The thesis: the feedforward dies out. Reference minus goal, over the last second: " + inWords(left, "deg") +
            " What is left is the noise of the goal."}},
      items);
  const std::string errors = "Rms yaw error: " + inWords(yaw, "deg") + " " + note;
  add("fig5.7",
      {equalOrBetter(with + "rms yaw error, feedforward over PBVS", yaw[FEEDFORWARD] / yaw[PBVS], tie, errors),
       equalOrBetter(with + "rms yaw error, feedforward over kyrki-decoupled", yaw[FEEDFORWARD] / yaw[KYRKI], tie,
                     errors)},
      items);
}
constexpr double HEAVY = 4.; // times the weight of the image term elsewhere

//! The overshoot of figure 5.6 with another weight of the image term, which the thesis does not give.
void addWeight(const Runs &runs, std::vector<Item> &items)
{
  add("fig5.6",
      {{"feedforward with four times the weight of its image term: peak of the reference over the goal", "1",
        std::nullopt, runs.values(peakReference)[FEEDFORWARD], Tolerance::factor(1.1), Good::Neither, "",
        "The constants of (5.26) decide how far the reference goes beyond the goal."}},
      items);
}
} // namespace

void addServoRows(const Setting &setting, std::vector<Item> &items, const std::function<void(double)> &progress)
{
  const bool arm = itemWith("fig5.8", items) || itemWith("fig5.9", items) || itemWith("fig5.10", items) ||
                   itemWith("fig5.11", items);
  const bool noisy = itemWith("fig5.6", items) || itemWith("fig5.7", items);
  const double total = static_cast<double>(laws().size()) * ((arm ? 2. : 0.) + (noisy ? 3. : 0.));
  double count = 0.;
  const auto done = [&] { progress(++count / total); };
  if (noisy) {
    for (const auto &[name, px] : noises(vpServoTask::thesis())) {
      const auto change = [px = px](vpServoRunSpec &spec) {
        spec.plant.pixelNoise = px;
        spec.noisyReference = true;
      };
      addNoise(name, px, Runs(setting, {}, "A", change, done), items);
    }
    const auto heavier = [](vpServoRunSpec &spec) { spec.gains.kappa *= HEAVY; };
    addWeight(Runs(setting, {}, "A", heavier, done), items);
  }
  for (const char *const drive : {"measured", "integrated"}) {
    if (arm) {
      servoCompare::RobotOptions robot;
      robot.robot = "amor";
      robot.drive = drive;
      addArm(drive,
             Runs(
                 setting, robot, ARM_PLANT, [](vpServoRunSpec &) {}, done),
             items);
    }
  }
}
} // namespace thesisReport
