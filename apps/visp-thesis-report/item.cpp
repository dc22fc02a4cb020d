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
#include <stdexcept>

namespace thesisReport
{
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
  case Verdict::ByConstruction:
    return "by construction";
  case Verdict::NotComparable:
    return "not comparable";
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
  const RowKind kind = quantity.judgement.kind;
  if (kind == RowKind::NotComparable) {
    return Verdict::NotComparable;
  }
  if (quantity.tolerance.holds(*quantity.thesis, quantity.ours)) {
    return kind == RowKind::ByConstruction ? Verdict::ByConstruction : Verdict::Agrees;
  }
  const bool better = (quantity.good == Good::Smaller && std::fabs(quantity.ours) < std::fabs(*quantity.thesis)) ||
                      (quantity.good == Good::Larger && quantity.ours > *quantity.thesis);
  return better && kind != RowKind::ByConstruction ? Verdict::Better : Verdict::Differs;
}

std::optional<double> ratioOf(const Quantity &quantity)
{
  if (!quantity.thesis || *quantity.thesis == 0.) {
    return std::nullopt;
  }
  return quantity.ours / *quantity.thesis;
}

std::string reasonOf(const Quantity &quantity)
{
  const Verdict verdict = verdictOf(quantity);
  if (verdict == Verdict::Agrees || verdict == Verdict::NoValue) {
    return "";
  }
  const bool failed = verdict == Verdict::Differs || verdict == Verdict::Better;
  const std::string &reason = failed && !quantity.reason.empty() ? quantity.reason : quantity.judgement.why;
  return reason.empty() ? "Not explained." : reason;
}

std::string kindOf(const Quantity &quantity)
{
  if (!quantity.thesis) {
    return "ours only";
  }
  const RowKind kind = quantity.judgement.kind;
  return kind == RowKind::Compared && quantity.tolerance.isOneSided() ? "bound" : vpToString(kind);
}

bool couldFail(const Quantity &quantity)
{
  const RowKind kind = quantity.judgement.kind;
  return quantity.thesis && (kind == RowKind::Compared || kind == RowKind::Arithmetic);
}

double shareOfSeeds(const Quantity &quantity)
{
  const Verdict verdict = verdictOf(quantity);
  Quantity single = quantity;
  const auto same = std::count_if(quantity.seeds.begin(), quantity.seeds.end(), [&](double ours) {
    single.ours = ours;
    return verdictOf(single) == verdict;
  });
  return quantity.seeds.empty() ? 1. : static_cast<double>(same) / static_cast<double>(quantity.seeds.size());
}

Verdict verdictOf(const Item &item)
{
  for (const Verdict verdict :
       {Verdict::Differs, Verdict::Better, Verdict::Agrees, Verdict::ByConstruction, Verdict::NotComparable}) {
    if (std::any_of(item.quantities.begin(), item.quantities.end(),
                    [&](const Quantity &quantity) { return verdictOf(quantity) == verdict; })) {
      return verdict;
    }
  }
  return Verdict::NoValue;
}

Item seedsMerged(std::vector<Item> seeds)
{
  Item merged = seeds.front();
  for (std::size_t i = 0; i < merged.quantities.size(); ++i) {
    Quantity &quantity = merged.quantities[i];
    for (const Item &item : seeds) {
      if (item.quantities.size() != merged.quantities.size() || item.quantities[i].name != quantity.name) {
        throw std::runtime_error(item.id + ": not every seed has the row " + quantity.name);
      }
      quantity.seeds.push_back(item.quantities[i].ours);
    }
    const bool known =
        std::none_of(quantity.seeds.begin(), quantity.seeds.end(), [](double x) { return std::isnan(x); });
    const double share = quantity.never ? (quantity.tolerance.isAtLeast() ? 0. : 1.) : 0.5;
    quantity.ours = known ? vpQuantile(quantity.seeds, share) : std::nan("");
  }
  return merged;
}

void addPlot(Item &item, const std::string &name, const std::string &title, const std::string &caption,
             const std::vector<vpApp::Plot> &panels)
{
  item.figures.push_back({name, title, caption, panels});
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
