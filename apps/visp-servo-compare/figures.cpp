/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "figures.h"

#include "catalogue.h"
#include "format.h"
#include "jobs.h"
#include "plot.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>

namespace servoCompare
{
namespace
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

constexpr std::size_t CURVE_POINTS = 600; // more would not be visible
constexpr std::size_t FEW = 5;            // distinguishable curves

//! A figure before drawing by gnuplot.
struct Draft {
  std::string name;
  Plot plot;
  std::string caption;
};

using Value = std::function<double(const vpServoSample &)>;

PlotCurve curveOf(const vpServoRun &run, const Value &value, PlotStyle style, int lastSegment)
{
  const LawInfo info = lawInfo(run.spec.law);
  PlotCurve curve;
  curve.label = info.name;
  curve.colour = info.colour;
  curve.style = style;
  const std::size_t stride = std::max<std::size_t>(1, run.samples.size() / CURVE_POINTS);
  for (std::size_t i = 0; i < run.samples.size() && run.samples[i].segment <= lastSegment; i += stride) {
    curve.x.push_back(run.samples[i].time);
    curve.y.push_back(value(run.samples[i]));
  }
  return curve;
}

//! The goal as a thin grey line.
PlotCurve goalCurve(const vpServoRun &run, int lastSegment)
{
  PlotCurve curve = curveOf(
      run, [](const vpServoSample &s) { return vpMath::deg(s.goalYaw); }, PlotStyle::Dotted, lastSegment);
  curve.label = "goal";
  curve.colour = "#555555";
  return curve;
}

std::vector<vpApp::PlotMark> segmentMarks(const vpServoTask &task, int lastSegment)
{
  std::vector<vpApp::PlotMark> marks;
  double time = 0.;
  for (std::size_t i = 0; i < task.segments.size() && static_cast<int>(i) <= lastSegment; ++i) {
    marks.push_back({time, "to pose " + task.segments[i].name});
    time += task.segments[i].duration;
  }
  return marks;
}

//! A number of each law as text: "PBVS-1 34.5, FF sum 45.7".
std::string perLaw(const Plan &plan, const Results &results, const std::vector<std::string> &laws,
                   const std::string &plant, Metric metric, int decimals)
{
  std::vector<std::string> items;
  for (const std::string &law : laws) {
    if (const auto spread = results.spread(law, plant, plan.mainMeasure(), metric)) {
      items.push_back(lawInfo(law).name + " " + fixed(spread->median, decimals));
    }
  }
  return enumerate(items);
}

//! The sentence, if all its values are present.
std::string ifAll(const std::vector<std::string> &laws, const std::vector<std::string> &needed,
                  const std::string &sentence)
{
  const bool all = std::all_of(needed.begin(), needed.end(), [&](const std::string &law) {
    return std::find(laws.begin(), laws.end(), law) != laws.end();
  });
  return all ? sentence : "";
}

//! Creates the drafts; holds their common data.
class FigureWriter
{
public:
  FigureWriter(const Plan &plan, const Results &results) : m_plan(plan), m_results(results) {}

  [[nodiscard]] Draft reference(const std::string &name, const std::string &figure, const vpServoPlant &plant,
                                const std::vector<std::string> &laws, const std::string &caption) const
  {
    Draft draft = timePlot(
        name, figure + ": reference yaw on plant " + plant.name, "reference yaw (deg)", plant, laws,
        [](const vpServoSample &s) { return vpMath::deg(s.referenceYaw); }, last());
    addGoal(draft, plant, laws);
    draft.caption = caption;
    return draft;
  }

  //! Overshoot of a law's reference beyond the goal of a segment, deg; 0 if it was not run.
  [[nodiscard]] double overshoot(const std::string &law, const vpServoPlant &plant) const
  {
    const vpServoRun *run = find(law, plant);
    double largest = 0.;
    double from = 0.;
    for (std::size_t i = 0; run != nullptr && i < run->samples.size(); ++i) {
      const vpServoSample &s = run->samples[i];
      if (i > 0 && run->samples[i - 1].segment != s.segment) {
        from = run->samples[i - 1].goalYaw;
      }
      largest = std::max(largest, (s.goalYaw >= from ? 1. : -1.) * (s.referenceYaw - s.goalYaw));
    }
    return vpMath::deg(largest);
  }

  [[nodiscard]] Draft yawError(const std::vector<std::string> &laws) const
  {
    const vpServoPlant &plant = m_plan.easyPlant();
    Draft draft = timePlot(
        "figure-5.7", "Figure 5.7 again: yaw error on plant " + plant.name, "goal yaw - yaw (deg)", plant, laws,
        [](const vpServoSample &s) { return vpMath::deg(s.goalYaw - s.yaw); }, last());
    draft.caption = "How far the camera still has to turn. Laws whose curves lie on each other turn equally fast; what "
                    "differs is where the "
                    "object is in the image meanwhile, at worst, px: " +
                    perLaw(m_plan, m_results, laws, plant.name, &vpServoMetrics::max_image_error_px, 1) + "." +
                    ifAll(laws, {"kyrki", "kyrki-decoupled"},
                          " The thesis shows one curve for Kyrki; here the full law and the decoupled one, which the "
                          "thesis uses, are "
                          "separate.");
    return draft;
  }

  [[nodiscard]] Draft motion(const std::string &name, const vpServoPlant &plant,
                             const std::vector<std::string> &laws) const
  {
    Draft draft = timePlot(
        name, "Figure 5.9 again: yaw on plant " + plant.name + ", reference thin, motion thick", "yaw (deg)", plant,
        laws, [](const vpServoSample &s) { return vpMath::deg(s.yaw); }, last());
    for (PlotCurve &curve : draft.plot.curves) {
      curve.width = 3.;
    }
    for (const std::string &law : laws) {
      if (const vpServoRun *run = find(law, plant)) {
        PlotCurve curve = curveOf(
            *run, [](const vpServoSample &s) { return vpMath::deg(s.referenceYaw); }, PlotStyle::Solid, last());
        curve.label.clear();
        curve.width = 0.7;
        draft.plot.curves.push_back(curve);
      }
    }
    addGoal(draft, plant, laws);
    draft.caption = "Where each law wants to turn to (thin) and how the camera turns (thick). The camera moves "
                    "smoothly although vision "
                    "is slow. The range of yaw is what the thesis calls exploration: of " +
                    fixed(m_results.runs().front().metrics.ideal_yaw_range_deg, 1) +
                    " deg between the goals, the laws reach, deg: " +
                    perLaw(m_plan, m_results, laws, plant.name, &vpServoMetrics::yaw_range_deg, 1) +
                    ". In the thesis the references are steps because vision alone updates them; here odometry fills "
                    "in between frames.";
    return draft;
  }

  [[nodiscard]] Draft imageError(const std::string &name, const vpServoPlant &plant,
                                 const std::vector<std::string> &laws) const
  {
    const int lastSegment = std::min(1, last());
    Draft draft = timePlot(
        name, "Figure 5.10 again: image error on plant " + plant.name, "u of the object's centre - goal (px)", plant,
        laws, [](const vpServoSample &s) { return s.imageErrorU; }, lastSegment);
    draft.caption = "How far the object is from its desired image position, to the right positive, for the first two "
                    "segments (1-2-1 in the "
                    "thesis). A curve that ends a segment level but away from zero is held by friction. Root mean "
                    "square over the whole task, px: " +
                    perLaw(m_plan, m_results, laws, plant.name, &vpServoMetrics::rms_image_error_px, 0) + "." +
                    ifAll(laws, {"kyrki", "kyrki-decoupled"},
                          " The large error of Kyrki in the thesis is that of the decoupled law.");
    return draft;
  }

  [[nodiscard]] Draft path(const std::vector<std::string> &laws) const
  {
    const vpServoPlant &plant = m_plan.hardPlant();
    const vpServoTask &task = m_plan.scenario.task;
    Draft draft;
    draft.name = "path";
    draft.plot.title = "The camera's path from above on plant " + plant.name;
    draft.plot.xLabel = "to the right (m)";
    draft.plot.yLabel = "towards the object (m)";
    draft.plot.equalAxes = true;
    draft.plot.height = 560;
    for (const std::string &law : laws) {
      if (const vpServoRun *run = find(law, plant)) {
        PlotCurve curve = curveOf(
            *run, [](const vpServoSample &s) { return s.wMc[2][3]; }, PlotStyle::Solid, last());
        for (std::size_t i = 0, k = 0; k < curve.x.size(); ++k) {
          curve.x[k] = run->samples[i].wMc[0][3];
          i += std::max<std::size_t>(1, run->samples.size() / CURVE_POINTS);
        }
        curve.width = 3.;
        draft.plot.curves.push_back(curve);
      }
    }
    for (const std::string &law : laws) {
      if (const vpServoRun *run = find(law, plant)) {
        draft.plot.curves.push_back(gazes(*run));
      }
    }
    PlotCurve object{"object", "#111111", PlotStyle::Solid, 5., {}, {}};
    for (const double side : {-0.5, 0.5}) {
      const vpTranslationVector edge =
          (task.initial * vpHomogeneousMatrix(side * task.objectWidth, 0., 0., 0., 0., 0.)).getTranslationVector();
      object.x.push_back(edge[0]);
      object.y.push_back(edge[2]);
    }
    draft.plot.curves.push_back(object);
    PlotCurve goals{"where goals look", "#888888", PlotStyle::Dashed, 1.5, {}, {}};
    for (const vpServoSegment &segment : task.segments) {
      addGaze(goals, task.initial * segment.cdMo.inverse(), segment.cdMo[2][3]);
    }
    draft.plot.curves.push_back(goals);
    draft.caption =
        "The camera's way (thick, from (0, 0)) and, thin in the same colour, where it looks when a segment ends; "
        "dashed, where it should look. A camera that friction keeps from turning to the end looks past the "
        "centre of the object. Length of the way, m: " +
        perLaw(m_plan, m_results, laws, plant.name, &vpServoMetrics::path_length_m, 2) +
        ". The thesis has no such figure.";
    return draft;
  }

  //! One dot per seed above each law.
  [[nodiscard]] Draft seeds(const std::string &name, const std::string &title, const std::string &unit,
                            Metric metric) const
  {
    const vpServoPlant &plant = m_plan.hardPlant();
    Draft draft;
    draft.name = name;
    draft.plot.title = title + " on plant " + plant.name + ", " + std::to_string(m_plan.repetitions) + " seeds";
    draft.plot.yLabel = unit;
    draft.plot.height = 480;
    draft.plot.fromZero = true;
    draft.plot.xRange = {-0.6, m_plan.laws.size() - 0.4};
    for (std::size_t i = 0; i < m_plan.laws.size(); ++i) {
      const LawInfo info = lawInfo(m_plan.laws[i]);
      draft.plot.categories.push_back(info.name);
      PlotCurve curve{"", info.colour, PlotStyle::Points, 1., {}, {}};
      for (const double value : m_results.values(m_plan.laws[i], plant.name, m_plan.mainMeasure(), metric)) {
        // Spread horizontally, so that equal values do not hide each other.
        curve.x.push_back(i + 0.36 * (std::fmod(0.618 * curve.x.size(), 1.) - 0.5));
        curve.y.push_back(value);
      }
      draft.plot.curves.push_back(curve);
    }
    draft.caption =
        "One dot for each seed (noise and feature points differ); left to right within a law means nothing.";
    return draft;
  }

private:
  //! A line from the camera along its optical axis, seen from above.
  static void addGaze(PlotCurve &curve, const vpHomogeneousMatrix &wMc, double length)
  {
    for (const double depth : {0., length}) {
      const vpTranslationVector p = (wMc * vpHomogeneousMatrix(0., 0., depth, 0., 0., 0.)).getTranslationVector();
      curve.x.push_back(p[0]);
      curve.y.push_back(p[2]);
    }
    curve.x.push_back(NAN);
    curve.y.push_back(NAN);
  }

  //! Viewing direction of the camera at the end of each segment.
  static PlotCurve gazes(const vpServoRun &run)
  {
    PlotCurve curve{"", lawInfo(run.spec.law).colour, PlotStyle::Solid, 1., {}, {}};
    for (std::size_t i = 0; i < run.samples.size(); ++i) {
      if (i + 1 == run.samples.size() || run.samples[i + 1].segment != run.samples[i].segment) {
        addGaze(curve, run.samples[i].wMc, run.samples[i].cMo[2][3]);
      }
    }
    return curve;
  }

  [[nodiscard]] int last() const { return static_cast<int>(m_plan.scenario.task.segments.size()) - 1; }

  //! End of a segment, s.
  [[nodiscard]] double endOf(int segment) const
  {
    double time = 0.;
    for (int i = 0; i <= segment; ++i) {
      time += m_plan.scenario.task.segments[i].duration;
    }
    return time;
  }

  [[nodiscard]] const vpServoRun *find(const std::string &law, const vpServoPlant &plant) const
  {
    return m_results.find(law, plant.name, m_plan.mainMeasure());
  }

  [[nodiscard]] Draft timePlot(const std::string &name, const std::string &title, const std::string &yLabel,
                               const vpServoPlant &plant, const std::vector<std::string> &laws, const Value &value,
                               int lastSegment) const
  {
    Draft draft;
    draft.name = name;
    draft.plot.title = title;
    draft.plot.xLabel = "time (s)";
    draft.plot.xRange = {0., endOf(lastSegment)};
    draft.plot.yLabel = yLabel;
    draft.plot.marks = segmentMarks(m_plan.scenario.task, lastSegment);
    for (const std::string &law : laws) {
      if (const vpServoRun *run = find(law, plant)) {
        draft.plot.curves.push_back(
            curveOf(*run, value, isFiltered(law) ? PlotStyle::Dashed : PlotStyle::Solid, lastSegment));
      }
    }
    return draft;
  }

  void addGoal(Draft &draft, const vpServoPlant &plant, const std::vector<std::string> &laws) const
  {
    if (const vpServoRun *run = find(laws.front(), plant)) {
      draft.plot.curves.push_back(goalCurve(*run, last()));
    }
  }

  const Plan &m_plan;
  const Results &m_results;
};
} // namespace

std::vector<std::string> figureLaws(const Plan &plan, const std::vector<std::string> &preferred)
{
  std::vector<std::string> chosen;
  for (const std::string &law : preferred) {
    if (std::find(plan.laws.begin(), plan.laws.end(), law) != plan.laws.end()) {
      chosen.push_back(law);
    }
  }
  if (chosen.size() >= std::min<std::size_t>(2, plan.laws.size()) && plan.laws.size() > FEW) {
    return chosen;
  }
  return {plan.laws.begin(), plan.laws.begin() + std::min(FEW, plan.laws.size())};
}

std::vector<Figure> drawFigures(const Plan &plan, const Results &results, unsigned int jobs)
{
  const FigureWriter draw(plan, results);
  const vpServoPlant &easy = plan.easyPlant();
  const vpServoPlant &hard = plan.hardPlant();
  const std::vector<std::string> all =
      figureLaws(plan, {"pbvs1", "kyrki", "kyrki-decoupled", "ff-sum", "ff-lookat-pi"});
  std::vector<Draft> drafts;
  const std::vector<std::string> ideal = figureLaws(plan, {"pbvs1", "ff-sum", "ff-lookat"});
  drafts.push_back(draw.reference(
      "figure-5.6", "Figure 5.6 again", easy, ideal,
      "The yaw that a law aims at: where its angular velocity would lead if it decayed as its rotation error does." +
          ifAll(ideal, {"pbvs1"}, " PBVS aims at the goal from the first instant, a constant.") +
          ifAll(ideal, {"ff-sum"},
                " FF sum goes beyond the goal while the object is off its place in the image, by at most " +
                    fixed(draw.overshoot("ff-sum", easy), 1) +
                    " deg here; in the thesis the overshoot is plain to see.") +
          ifAll(ideal, {"ff-lookat"},
                " FF look-at, which is not in the thesis, turns no faster than the translation asks for, "
                "so its reference reaches the goal later.")));
  drafts.push_back(draw.yawError(figureLaws(plan, {"pbvs1", "kyrki", "kyrki-decoupled", "ff-sum", "ff-lookat"})));
  drafts.push_back(draw.reference(
      "figure-5.8", "Figure 5.8 again", hard, all,
      "The same on plant " + hard.name + ". Where friction stops the camera before the goal, an image error remains." +
          ifAll(all, {"ff-sum"},
                " It keeps the feedforward term of FF sum alive: its reference goes up to " +
                    fixed(draw.overshoot("ff-sum", hard), 1) + " deg beyond the goal, which the thesis shows too.") +
          ifAll(all, {"ff-lookat-pi"},
                " The reference of FF look-at PI rises with its integral until the camera turns.") +
          ifAll(all, {"kyrki-decoupled"},
                " That of the decoupled Kyrki, the one of the thesis, follows from the image error "
                "alone.")));
  drafts.push_back(
      draw.motion("figure-5.9", hard, figureLaws(plan, {"kyrki", "kyrki-decoupled", "ff-sum", "ff-lookat-pi"})));
  drafts.push_back(draw.imageError("figure-5.10", hard, all));
  drafts.push_back(draw.path(all));
  if (plan.repetitions > 1) {
    drafts.push_back(draw.seeds("seeds-rotation", "Rotation error at the end of the segments", "deg",
                                &vpServoMetrics::end_rotation_deg));
    drafts.push_back(draw.seeds("seeds-image-error", "Root mean square of the image error", "px",
                                &vpServoMetrics::rms_image_error_px));
  }

  std::vector<Figure> figures(drafts.size());
  vpApp::runJobs(drafts.size(), jobs, [&](std::size_t i) {
    figures[i] = {drafts[i].name, vpApp::renderSvg(drafts[i].plot), drafts[i].plot.title, drafts[i].caption};
  });
  return figures;
}
} // namespace servoCompare
