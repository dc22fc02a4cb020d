/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "quantity.h"

#include "numberText.h"

#include <cmath>

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
} // namespace thesisReport
