/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "answer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace planTrajectory
{
namespace
{
using Json = nlohmann::ordered_json;

Json begun(std::size_t line, const Json &id, const std::string &status, const std::string &sentence)
{
  Json answer;
  answer["line"] = line;
  if (!id.is_null()) {
    answer["id"] = id;
  }
  answer["status"] = status;
  answer["message"] = sentence;
  return answer;
}

std::string oneLine(const Json &json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json plansOf(const Motion &motion)
{
  Json plans = Json::array();
  for (const PlanInForce &plan : motion.plans) {
    plans.push_back({{"t", plan.begin},
                     {"arrival", plan.begin + plan.plan.duration()},
                     {"form", vpToString(plan.plan.form())},
                     {"status", vpToString(plan.status.result)}});
  }
  return plans;
}

Json numberOrNull(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

template <class Numbers> Json listOf(const Numbers &numbers)
{
  Json list = Json::array();
  for (const double x : numbers) {
    list.push_back(numberOrNull(x));
  }
  return list;
}

//! Polynomials from the time \e begin on.
Json segmentsOf(const std::vector<vpTrajectoryPiece> &pieces, double begin)
{
  Json segments = Json::array();
  for (const vpTrajectoryPiece &piece : pieces) {
    segments.push_back(
        {{"t0_s", begin + piece.begin}, {"duration_s", piece.duration}, {"coefficients", piece.coefficients}});
  }
  return segments;
}

//! Goal and limits while they were in force.
Json inputOf(const Input &input, double begin, double end)
{
  return {{"begin_s", begin},
          {"end_s", end},
          {"goal", listOf(input.goal.q)},
          {"min_position", listOf(input.minPosition)},
          {"max_position", listOf(input.maxPosition)},
          {"max_velocity", listOf(input.maxVelocity)},
          {"max_acceleration", listOf(input.maxAcceleration)},
          {"max_jerk", listOf(input.maxJerk)}};
}

Json inputsOf(const Problem &problem, double duration)
{
  Json inputs = Json::array();
  const Input *input = &problem.input;
  double begin = 0.;
  for (const Event &event : problem.events) {
    inputs.push_back(inputOf(*input, begin, event.t));
    input = &event.input;
    begin = event.t;
  }
  inputs.push_back(inputOf(*input, begin, std::max(duration, begin)));
  return inputs;
}

//! Those of the last plan.
Json viasOf(const Problem &problem, const Motion &motion)
{
  const PlanInForce &last = motion.plans.back();
  const Input &input = problem.events.empty() ? problem.input : problem.events.back().input;
  Json vias = Json::array();
  const std::size_t first = input.vias.size() - std::min<std::size_t>(input.vias.size(), last.plan.vias());
  for (int k = 0; k < last.plan.vias(); ++k) {
    vias.push_back(
        {{"t_s", last.begin + last.plan.viaTime(k)}, {"q", listOf(input.vias[first + static_cast<std::size_t>(k)].q)}});
  }
  return vias;
}

//! Replaced plans as they would have gone on.
Json formerOf(const Motion &motion)
{
  Json former = Json::array();
  for (std::size_t i = 0; i + 1 < motion.plans.size(); ++i) {
    const PlanInForce &plan = motion.plans[i];
    former.push_back({{"end_s", plan.end}, {"segments", segmentsOf(plan.plan.pieces(), plan.begin)}});
  }
  return former;
}
} // namespace

std::string answerLine(const Problem &problem, const Motion &motion)
{
  Json answer = begun(problem.line, problem.id, vpToString(motion.result), motion.message);
  Json velocity = Json::array();
  Json acceleration = Json::array();
  Json jerk = Json::array();
  for (const vpTrajectoryPeaks &peaks : motion.peaks) {
    velocity.push_back(peaks.velocity);
    acceleration.push_back(peaks.acceleration);
    jerk.push_back(peaks.jerk);
  }
  answer["duration"] = motion.duration();
  answer["peak_velocity"] = velocity;
  answer["peak_acceleration"] = acceleration;
  answer["peak_jerk"] = jerk;
  answer["form"] = vpToString(motion.form);
  if (motion.excess.limit != vpTrajectoryLimit::None) {
    answer["excess"] = {{"limit", vpToString(motion.excess.limit)},
                        {"index", motion.excess.index},
                        {"value", motion.excess.value},
                        {"bound", motion.excess.bound},
                        {"amount", motion.excess.amount()}};
  }
  if (motion.plans.size() > 1) {
    answer["plans"] = plansOf(motion);
  }
  if (motion.plans.back().plan.vias() > 0) {
    answer["vias"] = viasOf(problem, motion);
  }
  Json segments = Json::array();
  for (const vpTrajectoryPiece &piece : motion.pieces) {
    segments.push_back(
        {{"t0", piece.begin}, {"t1", piece.end}, {"duration", piece.duration}, {"coefficients", piece.coefficients}});
  }
  answer["segments"] = segments;
  return oneLine(answer);
}

std::string refusalLine(std::size_t line, const Json &id, const std::string &sentence)
{
  return oneLine(begun(line, id, vpToString(vpTrajectoryResult::InvalidInput), sentence));
}

std::string csvOf(const Problem &problem, const Motion &motion)
{
  const double cycles = std::floor(motion.duration() / problem.dt * (1. + 1e-12));
  std::ostringstream csv;
  csv.imbue(std::locale::classic());
  if (cycles > maxCycles) {
    csv << problem.place << ": dt is " << problem.dt << " s, too short to sample a motion of " << motion.duration()
        << " s, at most " << maxCycles << " rows are written";
    throw std::runtime_error(csv.str());
  }
  csv << "t";
  for (int i = 0; i < problem.axes(); ++i) {
    csv << ",q" << i << ",v" << i << ",a" << i << ",j" << i;
  }
  csv << '\n';
  csv.precision(std::numeric_limits<double>::max_digits10);
  const auto row = [&](double t) {
    csv << t;
    for (int i = 0; i < problem.axes(); ++i) {
      for (const double x : motion.at(i, t)) {
        csv << ',' << x;
      }
    }
    csv << '\n';
  };
  for (long k = 0; k <= static_cast<long>(cycles); ++k) {
    row(std::min(static_cast<double>(k) * problem.dt, motion.duration()));
  }
  if (motion.duration() > cycles * problem.dt) {
    row(motion.duration());
  }
  return csv.str();
}

nlohmann::ordered_json dataOf(const Problem &problem, const Motion &motion)
{
  Json peaks = Json::array();
  for (const vpTrajectoryPeaks &peak : motion.peaks) {
    peaks.push_back({{"min_position", peak.minPosition},
                     {"max_position", peak.maxPosition},
                     {"velocity", peak.velocity},
                     {"acceleration", peak.acceleration},
                     {"jerk", peak.jerk}});
  }
  Json events = Json::array();
  for (const Event &event : problem.events) {
    events.push_back(event.t);
  }
  return {{"line", problem.line},
          {"id", problem.id},
          {"place", problem.place},
          {"status", vpToString(motion.result)},
          {"message", motion.message},
          {"form", vpToString(motion.form)},
          {"duration_s", motion.duration()},
          {"peaks", peaks},
          {"events_s", events},
          {"inputs", inputsOf(problem, motion.duration())},
          {"vias", viasOf(problem, motion)},
          {"segments", segmentsOf(motion.pieces, 0.)},
          {"former", formerOf(motion)}};
}
} // namespace planTrajectory
