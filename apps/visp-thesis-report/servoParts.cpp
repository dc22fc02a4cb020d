/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figures 5.6 to 5.11: the laws on the task of section 5.4.2, by the runs of visp-servo-compare.
#include "part.h"
#include "servoRows.h"

#include "numberText.h"

#include "visp-servo-compare/replay.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>

namespace thesisReport
{
namespace
{
using servoCompare::Plan;
using servoCompare::Results;

constexpr const char *POINTS = "points";
constexpr const char *PERFECT = "A", *HARD = "D";
constexpr double DIED_OUT = 0.5;            // deg
constexpr const char *KYRKI_FULL = "kyrki"; // (5.22), corrected
const char *const BOTH_KYRKIS =
    "(5.22) is the full law; section 5.4.4 says that its \"rotational control only relies on an "
    "image error\", which may mean that the translation is not compensated. Both are compared.";
constexpr const char *OURS = "ff-lookat-pi"; // successor of the law of the thesis

using Value = std::function<double(const vpServoRun &)>;

//! Runs of all laws, with their samples.
class Runs
{
public:
  Runs(const Setting &setting, double share) : m_results({})
  {
    servoCompare::Options options;
    options.laws = {PBVS, KYRKI, KYRKI_FULL, FEEDFORWARD, OURS};
    options.plants = {PERFECT, HARD};
    options.measures = {POINTS};
    options.seed = setting.seed;
    m_plan = servoCompare::makePlan(options);
    std::vector<vpServoRun> runs;
    for (const vpServoRunSpec &spec : m_plan.runs) {
      runs.push_back(runServoExperiment(spec));
      setting.progress(share * static_cast<double>(runs.size()) / static_cast<double>(m_plan.runs.size()));
    }
    m_results = Results(std::move(runs));
  }

  [[nodiscard]] const Plan &plan() const { return m_plan; }
  [[nodiscard]] const Results &results() const { return m_results; }
  //! A value of a law's run.
  [[nodiscard]] double of(const std::string &law, const std::string &plant, const Value &value) const
  {
    return value(*m_results.find(law, plant, POINTS));
  }
  //! Ratio of the values of two laws.
  [[nodiscard]] double ratio(const std::string &law, const std::string &other, const std::string &plant,
                             const Value &value) const
  {
    return of(law, plant, value) / of(other, plant, value);
  }

private:
  Plan m_plan;
  Results m_results;
};

Item reference(const Runs &runs)
{
  Item item;
  item.id = "fig5.6";
  const Value least = [](const vpServoRun &run) {
    const std::vector<double> peaks = peakReferences(run);
    return *std::min_element(peaks.begin(), peaks.end());
  };
  item.quantities = {greater("feedforward: peak of the reference over the goal, least of the three new poses", ROUNDING,
                             runs.of(FEEDFORWARD, PERFECT, least), ""),
                     {"feedforward: reference minus goal at the end of pose 2", "deg", 0.,
                      runs.of(FEEDFORWARD, PERFECT, referenceLeft), Tolerance::atMost(DIED_OUT), Good::Smaller, "",
                      "The thesis: it dies out. Mean over the last second."}};
  item.quantities[0].note = "The thesis: an overshoot at every new pose. Pose 2: " +
                            vpApp::fixed(runs.of(FEEDFORWARD, PERFECT, peakReference), 3) +
                            "; PBVS: " + vpApp::fixed(runs.of(PBVS, PERFECT, peakReference), 3) + ".";
  item.remarks = {"Feedforward is the sum of the thesis with its signs corrected (ff-sum).",
                  "That PBVS has a constant reference is what it is and not compared: its reference is the goal."};
  return item;
}

Item performance(const Runs &runs)
{
  Item item;
  item.id = "fig5.7";
  const std::string tie = "On a perfect robot there is nothing for the feedforward to make up for; it adds a rotation "
                          "that first leads the yaw beyond its goal.";
  item.quantities = {
      equalOrBetter("rms yaw error, feedforward over PBVS", runs.ratio(FEEDFORWARD, PBVS, PERFECT, yawError), tie),
      equalOrBetter("rms yaw error, feedforward over kyrki-decoupled",
                    runs.ratio(FEEDFORWARD, KYRKI, PERFECT, yawError), tie),
      equalOrBetter("rms yaw error, feedforward over Kyrki's full law",
                    runs.ratio(FEEDFORWARD, KYRKI_FULL, PERFECT, yawError), tie, BOTH_KYRKIS),
      {"rms yaw error, look-at feedforward over PBVS", "1", std::nullopt, runs.ratio(OURS, PBVS, PERFECT, yawError),
       Tolerance::factor(1.1), Good::Neither, "", "The law recommended here."}};
  return item;
}

Item hardReference(const Runs &runs)
{
  Item item;
  item.id = "fig5.8";
  item.quantities = {
      greater("peak reference, feedforward over PBVS", EQUAL, runs.ratio(FEEDFORWARD, PBVS, HARD, peakReference), ""),
      greater("peak reference, feedforward over kyrki-decoupled", EQUAL,
              runs.ratio(FEEDFORWARD, KYRKI, HARD, peakReference), ""),
      minimal("peak reference, kyrki-decoupled over PBVS", runs.ratio(KYRKI, PBVS, HARD, peakReference)),
      {"peak reference, feedforward over the sum of PBVS and kyrki-decoupled", "1", 1.,
       runs.of(FEEDFORWARD, HARD, peakReference) /
           (runs.of(PBVS, HARD, peakReference) + runs.of(KYRKI, HARD, peakReference)),
       Tolerance::factor(1.5), Good::Neither, "", ""},
      {"feedforward: reference minus goal at the end of pose 2", "deg", DIED_OUT,
       runs.of(FEEDFORWARD, HARD, referenceLeft), Tolerance::atLeast(), Good::Neither, "",
       "The thesis: by disturbances it does not completely die out, so more must be left than is negligible in "
       "figure "
       "5.6."}};
  return item;
}

Item range(const Runs &runs)
{
  Item item;
  item.id = "fig5.9";
  item.quantities = {
      greater("yaw range, feedforward over kyrki-decoupled", EQUAL, runs.ratio(FEEDFORWARD, KYRKI, HARD, yawRange), ""),
      greater("yaw range, feedforward over Kyrki's full law", EQUAL,
              runs.ratio(FEEDFORWARD, KYRKI_FULL, HARD, yawRange), "", BOTH_KYRKIS),
      greater("yaw range, feedforward over PBVS", SAME, runs.ratio(FEEDFORWARD, PBVS, HARD, yawRange), ""),
      minimal("yaw range, kyrki-decoupled over PBVS", runs.ratio(KYRKI, PBVS, HARD, yawRange)),
      {"yaw range of the feedforward law", "deg", std::nullopt, runs.of(FEEDFORWARD, HARD, yawRange),
       Tolerance::factor(1.1), Good::Larger, "",
       "Of " + vpApp::fixed(runs.of(FEEDFORWARD, HARD, idealYawRange), 1) +
           " deg between the goals. The \"roughly 60 degrees\" of section 5.4.2 are the geometry of the "
           "task, no result of a law."},
      {"yaw range of look-at feedforward with an integral", "deg", std::nullopt, runs.of(OURS, HARD, yawRange),
       Tolerance::factor(1.1), Good::Larger, "", "The law recommended here; its integral takes care of the friction."},
      {"yaw range of PBVS", "deg", std::nullopt, runs.of(PBVS, HARD, yawRange), Tolerance::factor(1.1), Good::Neither,
       "", ""}};
  item.remarks = {
      "The image term of ff-sum doubles its rotation gain. PBVS and Kyrki's full law with that gain turn as "
      "far (catchServoComparison, \"the benefit of the feedforward is the gain that it allows: kyrki-rot2 at "
      "the same gain ties\"): the rows say that the law turns farther, not that it needs the image for it."};
  return item;
}

Item imageErrors(const Runs &runs)
{
  Item item;
  item.id = "fig5.10";
  item.quantities = {
      equalOrBetter("rms image error along u, feedforward over kyrki-decoupled",
                    runs.ratio(FEEDFORWARD, KYRKI, HARD, imageError), ""),
      greater("rms image error along u, PBVS over feedforward", EQUAL, runs.ratio(PBVS, FEEDFORWARD, HARD, imageError),
              ""),
      equalOrBetter("rms image error along u, feedforward over Kyrki's full law",
                    runs.ratio(FEEDFORWARD, KYRKI_FULL, HARD, imageError), "",
                    std::string(BOTH_KYRKIS) + " At its doubled rotation gain it would tie: see visp-servo-compare."),
      {"rms image error along u, look-at feedforward with an integral", "px", std::nullopt,
       runs.of(OURS, HARD, imageError), Tolerance::factor(1.1), Good::Neither, "", ""},
      {"image error along u that is left in the end, look-at feedforward with an integral", "px", std::nullopt,
       runs.of(OURS, HARD, imageErrorLeft), Tolerance::factor(1.1), Good::Neither, "",
       "Its integral takes care of the friction."}};
  Values remains, largest;
  for (const char *const law : {PBVS, KYRKI, FEEDFORWARD}) {
    remains[law] = runs.of(law, HARD, imageErrorLeft);
    largest[law] = runs.of(law, HARD, largestImageError);
  }
  const std::vector<Quantity> left = errorsLeft("", remains, largest, HELD_SHORT);
  item.quantities.insert(item.quantities.end(), left.begin(), left.end());
  return item;
}

Item views(const Runs &runs)
{
  Item item;
  item.id = "fig5.11";
  const auto view = [&](const char *law, const char *name, std::optional<double> thesis, const std::string &reason) {
    return Quantity{std::string(name) + ": object in view at the end of pose 2 (1 yes, 0 no)",
                    "1",
                    thesis,
                    runs.of(law, HARD, inView),
                    Tolerance::distance(0.5),
                    Good::Neither,
                    reason,
                    ""};
  };
  const std::string size = "The size of the object decides, 0.18 m here; the thesis does not give it.";
  item.quantities = {
      view(PBVS, "PBVS", 0., size + " PBVS leaves it off the middle, but within the image, at this pose."),
      view(KYRKI, "kyrki-decoupled", std::nullopt, ""), // the thesis says nothing of its view
      view(FEEDFORWARD, "feedforward", 1., size),
      greater("yaw at the end of pose 2, feedforward over kyrki-decoupled", SAME,
              runs.ratio(FEEDFORWARD, KYRKI, HARD, yawAtPose2), ""),
      greater("yaw at the end of pose 2, feedforward over PBVS", SAME, runs.ratio(FEEDFORWARD, PBVS, HARD, yawAtPose2),
              ""),
      {"time out of view until the end of pose 2, PBVS", "s", std::nullopt, runs.of(PBVS, HARD, lostAtPose2),
       Tolerance::factor(1.1), Good::Neither, "", "Of 8 s."},
      {"time out of view, PBVS", "s", std::nullopt,
       runs.of(PBVS, HARD, [](const vpServoRun &run) { return run.metrics.out_of_view_s; }), Tolerance::factor(1.1),
       Good::Neither, "", "Of 24 s."},
      {"time out of view, feedforward", "s", std::nullopt,
       runs.of(FEEDFORWARD, HARD, [](const vpServoRun &run) { return run.metrics.out_of_view_s; }),
       Tolerance::factor(1.1), Good::Neither, "", ""}};
  return item;
}

std::vector<std::pair<std::string, std::string>> parameters(const Plan &plan)
{
  const auto &gains = plan.scenario.gains;
  return {{"task", "pose 1 - 2 - 1 - 3, 0.2 m sideways and 0.1 m forward, 8 s each, from 0.47 m; 30 points on 0.18 x "
                   "0.18 m, f = 800 px, 640 x 480"},
          {"gains", "lambda " + std::to_string(gains.lambda).substr(0, 4) + " 1/s for all laws"},
          {"plant A (figures 5.6, 5.7)", "perfect"},
          {"plant D (figures 5.8 to 5.11)", "10 Hz vision, 100 ms latency, 100 Hz loop with odometry, 0.5 px noise, 30 "
                                            "ms lag, friction that takes 0.2 rad/s off every rotation axis"},
          {"curves", "of the first seed"}};
}

using SampleValue = std::function<double(const vpServoSample &)>;

//! What a figure shows: a value of some laws on a plant, up to a segment.
struct Curves {
  const char *title, *yLabel, *plant;
  std::vector<const char *> laws;
  SampleValue value;
  int last;
};

//! Every tenth sample is enough to be seen.
vpApp::PlotCurve curveOf(const vpServoRun &run, const Curves &what, const SampleValue &value)
{
  constexpr std::size_t STRIDE = 10;
  const std::string &law = run.spec.law;
  vpApp::PlotCurve curve{law, colourOf(law), vpApp::PlotStyle::Solid, 2., {}, {}};
  for (std::size_t i = 0; i < run.samples.size() && run.samples[i].segment <= what.last; i += STRIDE) {
    curve.x.push_back(run.samples[i].time);
    curve.y.push_back(value(run.samples[i]));
  }
  return curve;
}

double goalYaw(const vpServoSample &s) { return vpMath::deg(s.goalYaw); }
double yaw(const vpServoSample &s) { return vpMath::deg(s.yaw); }
double referenceYaw(const vpServoSample &s) { return vpMath::deg(s.referenceYaw); }
double yawLeft(const vpServoSample &s) { return vpMath::deg(s.goalYaw - s.yaw); }
double errorU(const vpServoSample &s) { return s.imageErrorU; }

vpApp::Plot panelOf(const Runs &runs, const Curves &what)
{
  vpApp::Plot plot = vpApp::timePlot(what.title, what.yLabel, 380);
  for (const char *law : what.laws) {
    plot.curves.push_back(curveOf(*runs.results().find(law, what.plant, POINTS), what, what.value));
  }
  if (what.yLabel == std::string("yaw (deg)")) {
    vpApp::PlotCurve goal = curveOf(*runs.results().find(PBVS, what.plant, POINTS), what, goalYaw);
    goal.label = "goal";
    goal.colour = "#555555";
    goal.style = vpApp::PlotStyle::Dotted;
    plot.curves.push_back(goal);
  }
  return plot;
}

//! The curves of an item, of the first seed.
void illustrate(const Runs &runs, Item &item)
{
  constexpr int END = 3, TWO = 1;
  const std::vector<const char *> all = {PBVS, KYRKI, KYRKI_FULL, FEEDFORWARD, OURS};
  const char *const laws = "First seed. Kyrki's method is shown as published and decoupled, by the image error alone.";
  const auto add = [&](const std::string &caption, const std::vector<Curves> &panels) {
    std::vector<vpApp::Plot> plots;
    for (const Curves &panel : panels) {
      plots.push_back(panelOf(runs, panel));
    }
    addPlot(item, "curves", plots.front().title, caption, plots);
  };
  if (item.id == "fig5.6") {
    add("The yaw that a law aims at: where its angular velocity would lead if it decayed as its rotation error does.",
        {{"Reference yaw on the perfect robot", "yaw (deg)", PERFECT, {PBVS, FEEDFORWARD, OURS}, referenceYaw, END}});
  }
  else if (item.id == "fig5.7") {
    add(laws, {{"Yaw error on the perfect robot", "goal - yaw (deg)", PERFECT, all, yawLeft, END}});
  }
  else if (item.id == "fig5.8") {
    add(laws,
        {{"Reference yaw on the disturbed robot", "yaw (deg)", HARD, {PBVS, KYRKI, FEEDFORWARD}, referenceYaw, END}});
  }
  else if (item.id == "fig5.9") {
    add("Vision steps every 0.1 s; odometry carries the reference on in between. First seed.",
        {{"Yaw on the disturbed robot", "yaw (deg)", HARD, all, yaw, END},
         {"Reference", "yaw (deg)", HARD, {KYRKI, FEEDFORWARD}, referenceYaw, END}});
  }
  else if (item.id == "fig5.10") {
    add(laws, {{"Image error on the disturbed robot, pose 1 to 2 and back", "u of the centre - goal (px)", HARD, all,
                errorU, TWO}});
  }
  item.parameters = parameters(runs.plan());
}

std::vector<Item> play(const Setting &setting)
{
  const Runs runs(setting, 0.4);
  std::vector<Item> items;
  const std::vector<std::pair<const char *, Item (*)(const Runs &)>> makers = {
      {"fig5.6", reference}, {"fig5.7", performance},  {"fig5.8", hardReference},
      {"fig5.9", range},     {"fig5.10", imageErrors}, {"fig5.11", views}};
  for (const auto &maker : makers) {
    if (setting.wants(maker.first)) {
      items.push_back(maker.second(runs));
      illustrate(runs, items.back());
    }
  }
  addServoRows(setting, items, [&](double share) { setting.progress(0.45 + 0.5 * share); });
  if (setting.wants("fig5.11")) {
    const servoCompare::FilmStrip strip = servoCompare::drawFilmStrip(runs.plan(), runs.results());
    items.back().figures.push_back(
        {"views",
         "What the camera sees on the way to pose 2",
         "The object in yellow, its desired image position in blue. Rendered views of a photograph.",
         {},
         strip.jpeg,
         "jpg"});
  }
  return items;
}
} // namespace

const std::string &colourOf(const std::string &law)
{
  static const std::vector<std::string> laws = {PBVS, "kyrki", FEEDFORWARD, KYRKI, OURS, "dtg", "ff-dtg"};
  return colour(static_cast<std::size_t>(std::find(laws.begin(), laws.end(), law) - laws.begin()));
}

std::vector<Part> servoParts()
{
  return {{"Chapter 5: feedforward visual servoing",
           {{"fig5.6", "reference of feedforward and PBVS, simulated"},
            {"fig5.7", "yaw error of feedforward, PBVS and Kyrki, simulated"},
            {"fig5.8", "references on the disturbed robot"},
            {"fig5.9", "range of the yaw on the disturbed robot"},
            {"fig5.10", "image error from pose 1 to 2 and back"},
            {"fig5.11", "what the camera sees at the end of pose 2"}},
           70.,
           play}};
}
} // namespace thesisReport
