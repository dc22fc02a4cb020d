/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "findings.h"

#include "catalogue.h"
#include "format.h"

#include <algorithm>
#include <cmath>

namespace servoCompare
{
namespace
{
constexpr double ARRIVED = 0.2; // deg, at the end of every segment

//! Metrics of one law on one plant used in the sentences.
struct Figures {
  std::string law;
  double rotation; // deg, end of segments
  double yaw;      // deg
  double rms;      // px
  double out;      // s
};

//! Name of a plant in a sentence.
std::string plantName(const Plan &plan, const vpServoPlant &plant)
{
  if (plant.deadband <= 0.) {
    return "plant " + plant.name;
  }
  return "plant " + plant.name +
         (plan.arm ? " (" + number(plant.deadband / 0.1, 2) + " times the joint friction)"
                   : " (friction " + number(plant.deadband, 2) + " rad/s)");
}

//! Reads the medians of one plant and measure.
class Reader
{
public:
  Reader(const Plan &plan, const Results &results, std::string plant, std::string measure)
    : m_plan(plan), m_results(results), m_plant(std::move(plant)), m_measure(std::move(measure))
  {}

  [[nodiscard]] std::optional<Figures> of(const std::string &law) const
  {
    const auto median = [&](Metric metric) { return m_results.spread(law, m_plant, m_measure, metric)->median; };
    if (m_results.find(law, m_plant, m_measure) == nullptr) {
      return std::nullopt;
    }
    return Figures{law, median(&vpServoMetrics::end_rotation_deg), median(&vpServoMetrics::yaw_range_deg),
                   median(&vpServoMetrics::rms_image_error_px), median(&vpServoMetrics::out_of_view_s)};
  }
  [[nodiscard]] std::vector<Figures> all() const
  {
    std::vector<Figures> list;
    for (const std::string &law : m_plan.laws) {
      if (const auto figures = of(law)) {
        list.push_back(*figures);
      }
    }
    return list;
  }
  [[nodiscard]] double idealYaw() const
  {
    return m_results.runs().front().metrics.ideal_yaw_range_deg; // depends only on the task
  }

private:
  const Plan &m_plan;
  const Results &m_results;
  std::string m_plant;
  std::string m_measure;
};

std::string withRotation(const Figures &f) { return f.law + " (" + fixed(f.rotation, 2) + " deg)"; }

//! Laws that end each segment at the goal.
std::string arrival(const Plan &plan, const Reader &reader)
{
  std::vector<Figures> laws = reader.all();
  std::sort(laws.begin(), laws.end(), [](const Figures &a, const Figures &b) { return a.rotation < b.rotation; });
  std::vector<std::string> arrived;
  for (const Figures &law : laws) {
    if (law.rotation <= ARRIVED) {
      arrived.push_back(withRotation(law));
    }
  }
  const std::string where = "On " + plantName(plan, plan.hardPlant()) + ", ";
  const std::string goal = " within " + number(ARRIVED, 2) + " deg of every goal";
  const std::string count = std::to_string(laws.size());
  if (arrived.empty()) {
    return where + "none of the " + count + " laws ends" + goal + "; the closest is " + withRotation(laws.front()) +
           ".";
  }
  if (arrived.size() == laws.size()) {
    return where + (laws.size() == 1 ? "the law ends" : "all " + count + " laws end") + goal + ": " +
           enumerate(arrived) + ".";
  }
  return where + (arrived.size() == 1 ? "only 1" : std::to_string(arrived.size())) + " of " + count + " laws end" +
         (arrived.size() == 1 ? "s" : "") + goal + ": " + enumerate(arrived) + "; the next is " +
         withRotation(laws[arrived.size()]) + ".";
}

std::string turning(const Figures &f, double ideal)
{
  return f.law + " turns over " + fixed(f.yaw, 1) + " of " + fixed(ideal, 1) + " deg with " + fixed(f.rms, 0) +
         " px rms image error and ends " + fixed(f.rotation, 1) + " deg off";
}

//! Practically equal: 2 deg of yaw, 2 px or a tenth of the image error, half a degree at the end.
bool tie(const Figures &a, const Figures &b)
{
  return std::abs(a.yaw - b.yaw) < 2. && std::abs(a.rms - b.rms) < std::max(2., 0.1 * std::max(a.rms, b.rms)) &&
         std::abs(a.rotation - b.rotation) < 0.5;
}

//! Compares feedforward with the full law of Kyrki at the same gain.
std::optional<std::string> matchedRival(const Plan &plan, const Reader &reader)
{
  const auto feedforward = reader.of("ff-lookat");
  const auto rival = reader.of("kyrki-rot2");
  if (!feedforward || !rival) {
    return std::nullopt;
  }
  const std::string numbers = turning(*feedforward, reader.idealYaw()) + ", " + turning(*rival, reader.idealYaw());
  const std::string head = "At equal rotation gain and without integral, feedforward and the full law of Kyrki ";
  if (tie(*feedforward, *rival)) {
    const auto integral = reader.of("ff-lookat-pi");
    const bool better = integral && integral->rotation < 0.5 * std::min(feedforward->rotation, rival->rotation);
    return head + "tie on " + plantName(plan, plan.hardPlant()) + ": " + numbers +
           "; at equal gain the form of the law makes no difference there" +
           (better ? ", what does is the integral of ff-lookat-pi." : ".");
  }
  return head + "differ on " + plantName(plan, plan.hardPlant()) + ": " + numbers + ".";
}

//! Benefit of feedforward: the rotation gain can rise without the object leaving its image position.
std::optional<std::string> benefit(const Plan &plan, const Results &results)
{
  const Reader reader(plan, results, plan.easyPlant().name, plan.mainMeasure());
  if (!reader.of("pbvs1-rot2") || !reader.of("ff-lookat")) {
    return std::nullopt;
  }
  const auto error = [&](const std::string &law) {
    return results.spread(law, plan.easyPlant().name, plan.mainMeasure(), &vpServoMetrics::max_image_error_px)->median;
  };
  return "The doubled rotation gain moves the object in the image by up to " + fixed(error("pbvs1-rot2"), 1) +
         " px with PBVS-1 and by up to " + fixed(error("ff-lookat"), 1) + " px with ff-lookat on " +
         plantName(plan, plan.easyPlant()) + ".";
}

//! The statement of the thesis, tested against the laws that the thesis compares with.
std::optional<std::string> thesisOrder(const Plan &plan, const Reader &reader)
{
  const auto sum = reader.of("ff-sum");
  const auto pbvs = reader.of("pbvs1");
  const auto kyrki = reader.of("kyrki-decoupled");
  if (!sum || !pbvs || !kyrki) {
    return std::nullopt;
  }
  const auto notWorse = [&](const Figures &rival) {
    return sum->yaw >= rival.yaw && sum->rms <= rival.rms && sum->out <= rival.out && sum->rotation <= rival.rotation;
  };
  const bool holds = notWorse(*pbvs) && notWorse(*kyrki);
  return "The order of the thesis (its law at least as good as PBVS and Kyrki, figures 5.8 to 5.10) " +
         std::string(holds ? "holds" : "does not hold in all figures") + " on " + plantName(plan, plan.hardPlant()) +
         " against the rivals of the thesis: " + turning(*sum, reader.idealYaw()) + ", " +
         turning(*pbvs, reader.idealYaw()) + ", " + turning(*kyrki, reader.idealYaw()) +
         ". These rivals have half its effective rotation gain; see the matched group of the table.";
}

std::string outOfView(const Plan &plan, const Reader &reader)
{
  std::vector<std::string> losers;
  for (const Figures &law : reader.all()) {
    if (law.out > 0.) {
      losers.push_back(law.law + " (" + fixed(law.out, 1) + " s)");
    }
  }
  const std::string where = " on " + plantName(plan, plan.hardPlant());
  if (losers.empty()) {
    return "No law lets a corner of the object leave the image" + where + ".";
  }
  return "A corner of the object leaves the image" + where + " with " + enumerate(losers) + ".";
}

//! The view filter's guarantee holds only for a robot that executes its commands exactly.
std::optional<std::string> filterAgainstFriction(const Plan &plan, const Reader &reader)
{
  std::vector<std::string> losers;
  for (const Figures &law : reader.all()) {
    if (isFiltered(law.law) && law.out > 0.) {
      losers.push_back(law.law + " (" + fixed(law.out, 1) + " s)");
    }
  }
  if (losers.empty()) {
    return std::nullopt;
  }
  return "The view filter takes the robot's obedience for granted; on " + plantName(plan, plan.hardPlant()) +
         ", which does not execute all that is commanded, a corner is lost in spite of it: " + enumerate(losers) + ".";
}

//! Compares the results of rendered views and of points.
std::optional<std::string> imageAgainstPoints(const Plan &plan, const Results &results)
{
  std::vector<std::string> pairs;
  for (const std::string &law : plan.laws) {
    const Reader byPoints(plan, results, plan.hardPlant().name, "points");
    const Reader byImage(plan, results, plan.hardPlant().name, "image");
    const auto points = byPoints.of(law);
    const auto image = byImage.of(law);
    if (points && image) {
      pairs.push_back(law + " " + fixed(image->rotation, 2) + " instead of " + fixed(points->rotation, 2) +
                      " deg and " + fixed(image->rms, 0) + " instead of " + fixed(points->rms, 0) + " px rms");
    }
  }
  if (pairs.empty()) {
    return std::nullopt;
  }
  return "Measured in rendered views instead of by noisy points, the laws end on " + plantName(plan, plan.hardPlant()) +
         " with: " + enumerate(pairs) + ".";
}

std::optional<std::string> unfinished(const Results &results)
{
  std::vector<std::string> list;
  for (const vpServoRun &run : results.runs()) {
    const bool lacksTorque = run.armMetrics && run.armMetrics->shortfall.joint >= 0 && run.armMetrics->status != "ok";
    if ((run.metrics.status != "ok" || lacksTorque) && list.size() < 5) {
      list.push_back(run.spec.law + " on " + run.spec.plant.name + " by " + run.spec.measure +
                     (run.spec.shape ? ", shaped" : "") + " (seed " + std::to_string(run.spec.seed) +
                     "): " + (lacksTorque ? run.armMetrics->status : run.metrics.status));
    }
  }
  if (list.empty()) {
    return std::nullopt;
  }
  return "Runs that did not end well: " + enumerate(list) + ".";
}
} // namespace

Findings findingsOf(const Plan &plan, const Results &results)
{
  const Reader reader(plan, results, plan.hardPlant().name, plan.mainMeasure());
  Findings findings;
  findings.answer.push_back(arrival(plan, reader));
  if (const auto sentence = matchedRival(plan, reader)) {
    findings.answer.push_back(*sentence);
  }
  for (const auto &sentence :
       {benefit(plan, results), thesisOrder(plan, reader), std::optional<std::string>(outOfView(plan, reader)),
        filterAgainstFriction(plan, reader), imageAgainstPoints(plan, results), unfinished(results)}) {
    if (sentence) {
      findings.more.push_back(*sentence);
    }
  }
  return findings;
}
} // namespace servoCompare
