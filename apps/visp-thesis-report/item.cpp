/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "item.h"

#include "numberText.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numeric>

namespace thesisReport
{
namespace
{
//! A CSV field, quoted if necessary.
std::string field(const std::string &text)
{
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string result = "\"";
  for (const char c : text) {
    result += c == '"' ? "\"\"" : std::string(1, c);
  }
  return result + "\"";
}
} // namespace

bool Tolerance::holds(double thesis, double ours) const
{
  if (!std::isfinite(thesis) || !std::isfinite(ours)) {
    return false;
  }
  switch (m_kind) {
  case Kind::Factor:
    return ours * thesis > 0. && std::fabs(ours) <= std::fabs(thesis) * m_size &&
           std::fabs(ours) * m_size >= std::fabs(thesis);
  case Kind::Distance:
    return std::fabs(ours - thesis) <= m_size;
  case Kind::AtMost:
    return ours <= thesis + m_size;
  case Kind::AtLeast:
    break;
  }
  return ours >= thesis - m_size;
}

std::string Tolerance::text() const
{
  const std::string size = vpApp::number(m_size, 3);
  switch (m_kind) {
  case Kind::Factor:
    return "within a factor " + size;
  case Kind::Distance:
    return "within " + size;
  case Kind::AtMost:
    return m_size > 0. ? "at most, within " + size : "at most";
  case Kind::AtLeast:
    break;
  }
  return m_size > 0. ? "at least, within " + size : "at least";
}

const char *vpToString(Verdict verdict)
{
  switch (verdict) {
  case Verdict::Agrees:
    return "agrees";
  case Verdict::Better:
    return "better";
  case Verdict::Differs:
    return "differs";
  case Verdict::NoValue:
    break;
  }
  return "no value in the thesis";
}

Verdict verdictOf(const Quantity &quantity)
{
  if (!quantity.thesis) {
    return Verdict::NoValue;
  }
  if (quantity.tolerance.holds(*quantity.thesis, quantity.ours)) {
    return Verdict::Agrees;
  }
  const bool better = (quantity.good == Good::Smaller && std::fabs(quantity.ours) < std::fabs(*quantity.thesis)) ||
                      (quantity.good == Good::Larger && quantity.ours > *quantity.thesis);
  return better ? Verdict::Better : Verdict::Differs;
}

std::optional<double> ratioOf(const Quantity &quantity)
{
  if (!quantity.thesis || *quantity.thesis == 0.) {
    return std::nullopt;
  }
  return quantity.ours / *quantity.thesis;
}

std::string remarkOf(const Quantity &quantity)
{
  const Verdict verdict = verdictOf(quantity);
  std::string reason;
  if (verdict == Verdict::Differs) {
    reason = quantity.reason.empty() ? "Not explained." : quantity.reason;
  }
  else if (verdict == Verdict::Better) {
    reason = quantity.reason;
  }
  return quantity.note + (quantity.note.empty() || reason.empty() ? "" : " ") + reason;
}

Verdict verdictOf(const Item &item)
{
  Verdict worst = Verdict::NoValue;
  const auto rank = [](Verdict v) {
    return v == Verdict::Differs ? 3 : v == Verdict::Better ? 2 : v == Verdict::Agrees ? 1 : 0;
  };
  for (const Quantity &quantity : item.quantities) {
    const Verdict verdict = verdictOf(quantity);
    worst = rank(verdict) > rank(worst) ? verdict : worst;
  }
  return worst;
}

std::string csvOf(const std::vector<vpApp::Plot> &panels)
{
  std::string csv = "panel,curve,x_label,y_label,x,y\n";
  for (const vpApp::Plot &panel : panels) {
    for (const vpApp::PlotCurve &curve : panel.curves) {
      const std::string head =
          field(panel.title) + "," + field(curve.label) + "," + field(panel.xLabel) + "," + field(panel.yLabel) + ",";
      for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
        if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) {
          csv += head + vpApp::number(curve.x[i], 9) + "," + vpApp::number(curve.y[i], 9) + "\n";
        }
      }
    }
  }
  return csv;
}

void addPlot(Item &item, const std::string &name, const std::string &title, const std::string &caption,
             const std::vector<vpApp::Plot> &panels)
{
  item.figures.push_back({name, title, caption, vpApp::renderPanels(panels, vpApp::PlotFormat::Svg)});
  item.data.push_back({name + ".csv", csvOf(panels)});
}

const std::string &colour(std::size_t i)
{
  static const std::array<std::string, 8> colours = {"#1f77b4", "#d62728", "#2ca02c", "#ff7f0e",
                                                     "#9467bd", "#17becf", "#8c564b", "#7f7f7f"};
  return colours[i % colours.size()];
}

void addCurve(vpApp::Plot &plot, const std::string &label, std::vector<double> x, std::vector<double> y,
              vpApp::PlotStyle style)
{
  plot.curves.push_back({label, colour(plot.curves.size()), style, 2., std::move(x), std::move(y)});
}

void addBound(vpApp::Plot &plot, double value, bool both, const std::string &label)
{
  vpApp::addLevel(plot, value, label);
  if (both) {
    vpApp::addLevel(plot, -value, "");
  }
}

double Spread::mean() const
{
  return m_values.empty() ? 0. : std::accumulate(m_values.begin(), m_values.end(), 0.) / static_cast<double>(count());
}

double Spread::sigma() const
{
  const double centre = mean();
  double sum = 0.;
  for (const double value : m_values) {
    sum += (value - centre) * (value - centre);
  }
  return count() < 2 ? 0. : std::sqrt(sum / static_cast<double>(count() - 1));
}

double Spread::rms() const
{
  double sum = 0.;
  for (const double value : m_values) {
    sum += value * value;
  }
  return m_values.empty() ? 0. : std::sqrt(sum / static_cast<double>(count()));
}

double Spread::largest() const { return quantile(1.); }

double Spread::quantile(double share) const { return m_values.empty() ? 0. : vpQuantile(m_values, share); }

double coreSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
} // namespace thesisReport
