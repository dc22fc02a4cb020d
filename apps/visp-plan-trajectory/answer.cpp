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
} // namespace planTrajectory
