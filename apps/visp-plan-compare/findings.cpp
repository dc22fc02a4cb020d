/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "findings.h"

#include "numberText.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <iterator>

namespace planCompare
{
namespace
{
using vpApp::enumerate;
using vpApp::fixed;
using vpApp::number;
using M = vpAvoidanceMetrics;

constexpr double SIGNIFICANT = 0.05;

//! "17 of 20".
std::string countText(int part, std::size_t all) { return std::to_string(part) + " of " + std::to_string(all); }

std::string pText(double p) { return p < 0.001 ? "p < 0.001" : "p = " + number(p, 2); }

//! Scenes in which the method succeeds, touches nothing, and no other is significantly better in paired tests.
std::vector<std::string> unbeatenScenes(const Plan &plan, const Results &results, const std::string &method)
{
  std::vector<std::string> scenes;
  for (const SceneInfo &scene : plan.scenes) {
    const Cell cell = results.cell(scene.id, method);
    bool beaten = cell.successes() == 0 || cell.runsWith(&M::collisions_moving) > 0;
    for (const std::string &other : plan.methods) {
      const Pairing p = pairUp(results, scene.id, other, method);
      beaten = beaten || (p.onlyFirst > p.onlySecond && p.p < SIGNIFICANT);
    }
    if (!beaten) {
      scenes.push_back(scene.id);
    }
  }
  return scenes;
}

//! Of these, the scenes where its median duration is the shortest of all equally good methods.
std::vector<std::string> quickestScenes(const Plan &plan, const Results &results, const std::string &method)
{
  const auto duration = [&](const std::string &scene, const std::string &m) {
    return vpMedian(results.cell(scene, m).values(&M::duration_s, true));
  };
  std::vector<std::string> scenes;
  for (const std::string &scene : unbeatenScenes(plan, results, method)) {
    const bool quickest = std::all_of(plan.methods.begin(), plan.methods.end(), [&](const std::string &other) {
      const std::vector<std::string> good = unbeatenScenes(plan, results, other);
      return std::find(good.begin(), good.end(), scene) == good.end() ||
             duration(scene, method) <= duration(scene, other);
    });
    if (quickest) {
      scenes.push_back(scene);
    }
  }
  return scenes;
}

//! A time in ms; times too short to measure are marked.
std::string msText(double ms) { return ms < 0.001 ? "less than 0.001" : number(ms, 2); }

//! Methods that never touched anything.
std::vector<std::string> safest(const Plan &plan, const Results &results)
{
  std::vector<std::string> names;
  for (const std::string &method : plan.methods) {
    if (results.all(method).runsWith(&M::collisions_moving) == 0) {
      names.push_back(method);
    }
  }
  return names;
}

std::string pairSentence(const Results &results, const std::string &scene,
                         const std::pair<std::string, std::string> &pair, const std::string &where)
{
  const Pairing p = pairUp(results, scene, pair.first, pair.second);
  if (p.onlyFirst + p.onlySecond == 0) {
    return pair.first + " and " + pair.second + " succeed in the same runs" + where + ".";
  }
  const std::string counts = "only " + pair.first + " succeeds in " + std::to_string(p.onlyFirst) + ", only " +
                             pair.second + " in " + std::to_string(p.onlySecond) + " of " +
                             std::to_string(p.both + p.onlyFirst + p.onlySecond + p.neither) + " paired runs" + where;
  const std::string verdict =
      p.p >= SIGNIFICANT ? "no significant difference."
                         : (p.onlyFirst > p.onlySecond ? pair.first : pair.second) + " does significantly better.";
  return "Pair by pair " + counts + " (McNemar's exact test, " + pText(p.p) + "): " + verdict;
}
} // namespace

std::string heroOf(const Plan &plan, const Results &results, const std::string &scene)
{
  std::string best = plan.methods.front();
  int most = -1;
  double shortest = 0.;
  for (const std::string &method : plan.methods) {
    const Cell cell = results.cell(scene, method);
    const double duration = vpMedian(cell.values(&vpAvoidanceMetrics::duration_s, true));
    if (cell.successes() > most || (cell.successes() == most && duration < shortest)) {
      best = method;
      most = cell.successes();
      shortest = duration;
    }
  }
  return best;
}

std::vector<std::string> answerOf(const Plan &plan, const Results &results)
{
  std::vector<std::string> answer;
  if (results.records.empty()) {
    return answer;
  }
  std::vector<std::string> order = plan.methods;
  std::stable_sort(order.begin(), order.end(), [&](const std::string &a, const std::string &b) {
    return results.all(a).successes() > results.all(b).successes();
  });
  const Cell best = results.all(order.front()), worst = results.all(order.back());
  const auto with = [&](int count) {
    std::vector<std::string> methods;
    std::copy_if(order.begin(), order.end(), std::back_inserter(methods),
                 [&](const std::string &method) { return results.all(method).successes() == count; });
    return methods;
  };
  const std::vector<std::string> leaders = with(best.successes());
  const Interval interval = best.interval();
  std::string sentence = "Of " + std::to_string(best.runs.size()) + " runs " + enumerate(leaders) +
                         (leaders.size() == 1 ? " solves the most, " : " solve the most, each ") +
                         std::to_string(best.successes()) + " (95 % interval " + fixed(100. * interval.low, 1) +
                         " to " + fixed(100. * interval.high, 1) + " %)";
  if (worst.successes() < best.successes()) {
    sentence += "; " + enumerate(with(worst.successes())) + " the fewest, " + std::to_string(worst.successes());
  }
  answer.push_back(sentence + ".");
  const std::vector<std::string> safe = safest(plan, results);
  answer.push_back(safe.empty() ? "Every method touched something while it moved in at least one run."
                                : enumerate(safe) + " never touched anything while moving" +
                                      (safe.size() == plan.methods.size() ? "; no other method was compared."
                                                                          : "; all others did."));
  for (const auto &pair : pairsOf(plan)) {
    answer.push_back(pairSentence(results, "", pair, " over all scenes"));
  }
  return answer;
}

std::string verdictOf(const Plan &plan, const Results &results, const std::string &method)
{
  const Cell cell = results.all(method);
  const std::vector<std::string> good = unbeatenScenes(plan, results, method);
  const int touched = cell.runsWith(&M::collisions_moving);
  const int overTool = cell.runsWith(&M::tool_a_violations), overSpeed = cell.runsWith(&M::tool_v_violations);
  const int overJoints = std::max(cell.runsWith(&M::joint_v_violations), cell.runsWith(&M::joint_a_violations));
  std::string text = good.empty() ? "Good for none of these scenes: it touches something, or another method does "
                                    "significantly better. "
                                  : "Good for " + enumerate(good) +
                                        ", where it touches nothing and no other method does significantly better. ";
  const std::vector<std::string> quick = quickestScenes(plan, results, method);
  text += quick.empty() ? "" : "The quickest of those in " + enumerate(quick) + ". ";
  text += touched == 0 ? "It touched nothing in " + std::to_string(cell.runs.size()) + " runs. "
                       : "It touched something while moving in " + countText(touched, cell.runs.size()) + " runs. ";
  text += overJoints == 0
              ? "The joints' limits were always kept; "
              : "The joints' limits were exceeded in " + countText(overJoints, cell.runs.size()) + " runs; ";
  text += overTool + overSpeed == 0 ? "so were the tool's bounds. "
                                    : "the tool's bound of speed was exceeded in " + std::to_string(overSpeed) +
                                          " runs, that of acceleration in " + std::to_string(overTool) + ". ";
  const std::vector<double> replan = cell.replanTimes();
  text += replan.empty() ? ""
                         : "Looking again takes " + msText(vpMedian(replan)) + " ms (median) and " +
                               msText(vpQuantile(replan, .99)) + " ms (99 %).";
  const int falseStops = cell.sum(&M::false_stops), stops = cell.sum(&M::stops);
  if (stops > 0) {
    text += " " + countText(falseStops, static_cast<std::size_t>(stops)) + " stops were false.";
  }
  return text;
}

std::vector<std::string> findingsOf(const Plan &plan, const Results &results, const SceneInfo &scene)
{
  std::vector<std::string> findings;
  const std::string hero = heroOf(plan, results, scene.id);
  const Cell best = results.cell(scene.id, hero);
  if (best.successes() == 0) {
    findings.push_back("No method solves this scene.");
    return findings;
  }
  findings.push_back(hero + " succeeds in " + countText(best.successes(), best.runs.size()) + " runs, in " +
                     fixed(vpMedian(best.values(&M::duration_s, true)), 2) + " s (median).");
  std::vector<std::string> touching;
  for (const std::string &method : plan.methods) {
    const Cell cell = results.cell(scene.id, method);
    const int touched = cell.runsWith(&M::collisions_moving);
    if (touched > 0) {
      touching.push_back(method + " in " + countText(touched, cell.runs.size()));
    }
  }
  findings.push_back(touching.empty() ? "No arm touched anything while it moved."
                                      : "Touched something while moving: " + enumerate(touching) + " runs.");
  for (const auto &pair : pairsOf(plan)) {
    findings.push_back(pairSentence(results, scene.id, pair, ""));
  }
  return findings;
}

std::string validatorFinding(const std::vector<ValidatorRow> &rows)
{
  int certified = 0, sampled = 0, certifiedLies = 0, lies = 0;
  for (const ValidatorRow &row : rows) {
    const bool proven = row.validator == "certified";
    (proven ? certified : sampled) += row.solved;
    (proven ? certifiedLies : lies) += row.colliding;
  }
  if (rows.empty()) {
    return "";
  }
  return "Looked at again at 10,000 places, " + countText(certifiedLies, static_cast<std::size_t>(certified)) +
         " certified paths and " + countText(lies, static_cast<std::size_t>(sampled)) +
         " paths checked by samples (a step of 0.05 rad) touch something.";
}

std::string selfMotionFinding(const std::vector<SelfMotionRow> &rows)
{
  if (rows.empty()) {
    return "";
  }
  double drift = 0., most = 0.;
  std::string where;
  for (const SelfMotionRow &row : rows) {
    drift = std::max(drift, row.run.tcp_drift_m);
    for (const SelfMotionRow &none : rows) {
      const double change = row.run.mean_distance_m - none.run.mean_distance_m;
      if (none.sense == "none" && none.index == row.index && std::abs(change) > std::abs(most)) {
        most = change;
        where = row.sense + " with the " + row.index + " index";
      }
    }
  }
  return "The tool never drifts by more than " + number(1e6 * drift, 2) +
         " um from its way; joint 4 is moved most, by " + fixed(1000. * most, 0) + " mm on average, by " + where + ".";
}
} // namespace planCompare
