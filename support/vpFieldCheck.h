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
#include <visp3/direct_core/vpField.h>

#include <string>

BEGIN_VISP_NAMESPACE

/*!
 * \brief vpCheckField() for the fields of one owner: "margin of the stop supervisor is -1 m, must be >= 0". All functions
 * throw vpException (badValue) with such a sentence; NaN is never in a range.
 */
class vpFieldCheck
{
public:
  //! \param owner : As in "of the stop supervisor"; must outlive this.
  explicit constexpr vpFieldCheck(const char *owner) : m_owner(owner) {}

  //! The value is in the range. \param unit : Of the value, for the message.
  void in(const char *field, double value, const vpFieldRange &range, const char *unit = "") const
  {
    vpCheckField(field, m_owner, value, unit, range);
  }
  //! value > 0 and finite.
  void positive(const char *field, double value, const char *unit = "") const
  {
    in(field, value, vpFieldRange::positive(), unit);
  }
  //! value >= 0 and finite.
  void notNegative(const char *field, double value, const char *unit = "") const
  {
    in(field, value, vpFieldRange::notNegative(), unit);
  }
  //! Neither NaN nor infinite.
  void finite(const char *field, double value) const { in(field, value, {}); }
  //! A condition that no interval expresses. \param good : What is required. \param range : The same in words.
  void require(bool good, const char *field, double value, const std::string &range) const
  {
    if (!good) {
      throw vpException(vpException::badValue, "%s of %s is %g, must be %s", field, m_owner, value, range.c_str());
    }
  }

private:
  const char *m_owner;
};

END_VISP_NAMESPACE
#endif
