/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpSelfCollisionStatistics.h>

#include "vpFileReplace.h"
#include "vpJsonObject.h"
#include "vpReading.h"

#include <cmath>
#include <sstream>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double nearlyAlways = 0.95; // of the samples

const char *nameOf(vpContactRule rule)
{
  switch (rule) {
  case vpContactRule::Always:
    return "always";
  case vpContactRule::Default:
    return "default";
  case vpContactRule::Never:
    return "never";
  default:
    return "checked";
  }
}

int countIn(vpJsonObject &object, const std::string &field, int most)
{
  const unsigned int value = object.count(field, 0);
  if (value > static_cast<unsigned int>(most)) {
    throw object.wrong(field, object.value(field), "at most " + std::to_string(most));
  }
  return static_cast<int>(value);
}

vpBodyPairStatistics readPair(vpJsonObject &object, int samples)
{
  vpBodyPairStatistics pair;
  pair.first = object.text("first");
  pair.second = object.text("second");
  static_cast<void>(object.value("touching"));
  pair.touching = countIn(object, "touching", samples);
  pair.atZero = object.flag("at_zero", false);
  pair.exact = object.flag("exact", false);
  if (object.has("least_m")) {
    pair.least = object.number("least_m");
  }
  object.ignore("rule"); // for the reader's eye: it follows from the numbers
  return pair;
}
} // namespace

vpContactRule vpSelfCollisionStatistics::rule(const vpBodyPairStatistics &pair) const noexcept
{
  if (samples <= 0) {
    return vpContactRule::Checked;
  }
  if (pair.touching >= nearlyAlways * samples) {
    return vpContactRule::Always;
  }
  if (pair.atZero) {
    return vpContactRule::Default;
  }
  return pair.touching == 0 ? vpContactRule::Never : vpContactRule::Checked;
}

std::vector<std::pair<std::string, std::string>> vpSelfCollisionStatistics::allowed(bool never) const
{
  std::vector<std::pair<std::string, std::string>> result;
  for (const vpBodyPairStatistics &pair : pairs) {
    const vpContactRule here = rule(pair);
    if (here != vpContactRule::Checked && (never || here != vpContactRule::Never)) {
      result.emplace_back(pair.first, pair.second);
    }
  }
  return result;
}

void vpSelfCollisionStatistics::save(const std::string &file) const
{
  nlohmann::ordered_json content;
  content["arm"] = arm;
  content["samples"] = samples;
  content["seed"] = seed;
  std::ostringstream share;
  share << 300. / samples;
  content["never"] = "touches in less than " + share.str() + " % of random configurations, with 95 % confidence";
  content["pairs"] = nlohmann::json::array();
  for (const vpBodyPairStatistics &pair : pairs) {
    nlohmann::ordered_json one;
    one["first"] = pair.first;
    one["second"] = pair.second;
    one["touching"] = pair.touching;
    one["at_zero"] = pair.atZero;
    one["exact"] = pair.exact;
    if (std::isfinite(pair.least)) {
      one["least_m"] = pair.least;
    }
    one["rule"] = nameOf(rule(pair));
    content["pairs"].push_back(one);
  }
  const std::string text = content.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  const std::string reason = vpReplaceFile(file, text);
  if (!reason.empty()) {
    throw vpException(vpException::ioError, vpPrintable(file + ": the statistics cannot be written" + reason));
  }
}

vpSelfCollisionStatistics vpSelfCollisionStatistics::load(const std::string &file)
{
  return vpReading([&file] {
    const nlohmann::json content = vpReadJson(file);
    vpJsonObject top(content, file);
    vpSelfCollisionStatistics result;
    result.arm = top.text("arm");
    result.samples = countIn(top, "samples", std::numeric_limits<int>::max());
    if (result.samples == 0) {
      throw top.wrong("samples", top.value("samples"), "> 0");
    }
    result.seed = top.count("seed", 1);
    top.ignore("never");
    top.each("pairs", [&result](vpJsonObject &object) { result.pairs.push_back(readPair(object, result.samples)); });
    top.finish();
    return result;
  });
}

END_VISP_NAMESPACE
