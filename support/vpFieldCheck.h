/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFieldCheck.h
 * \brief Ranges of the fields of a specification.
 */
#ifndef vpFieldCheck_h
#define vpFieldCheck_h

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <cmath>
#include <string>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Checks fields of one owner: "margin of the stop supervisor is -1, must be >= 0 m". All functions throw vpException
 * (badValue) with such a sentence; NaN is never in a range.
 */
class vpFieldCheck
{
public:
  //! \param owner : As in "of the stop supervisor"; must outlive this.
  explicit constexpr vpFieldCheck(const char *owner) : m_owner(owner) {}

  //! \param good : What is required. \param range : In words, with the unit.
  void require(bool good, const char *field, double value, const std::string &range) const
  {
    if (!good) {
      throw vpException(vpException::badValue, "%s of %s is %g, must be %s", field, m_owner, value, range.c_str());
    }
  }
  //! value > 0 and finite.
  void positive(const char *field, double value, const char *unit = "") const
  {
    require(value > 0. && std::isfinite(value), field, value, with("> 0", unit));
  }
  //! value >= 0 and finite.
  void notNegative(const char *field, double value, const char *unit = "") const
  {
    require(value >= 0. && std::isfinite(value), field, value, with(">= 0", unit));
  }
  //! Neither NaN nor infinite.
  void finite(const char *field, double value) const { require(std::isfinite(value), field, value, "finite"); }

private:
  static std::string with(const char *range, const char *unit)
  {
    return *unit == '\0' ? range : std::string(range) + " " + unit;
  }
  const char *m_owner;
};

END_VISP_NAMESPACE
#endif
