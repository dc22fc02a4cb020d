/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpField.h
 * \brief The numbers of a specification: name, range, unit and description of each, in one table.
 */
#ifndef vpField_h
#define vpField_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <limits>
#include <string>
#include <variant>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_direct_core
 * \brief An interval of numbers. NaN is in no range, infinity only where #infinite says so.
 */
struct VISP_EXPORT vpFieldRange {
  double low = -std::numeric_limits<double>::infinity(); //!< Lower bound.
  double high = std::numeric_limits<double>::infinity(); //!< Upper bound, included.
  bool open = false;                                     //!< True: #low is excluded.
  bool infinite = false;                                 //!< True: infinity is allowed, and means no limit.

  //! value > 0. \param high : Largest value.
  [[nodiscard]] static vpFieldRange positive(double high = std::numeric_limits<double>::infinity());
  //! value >= 0. \param high : Largest value.
  [[nodiscard]] static vpFieldRange notNegative(double high = std::numeric_limits<double>::infinity());
  //! True if \e value is in the range.
  [[nodiscard]] bool contains(double value) const noexcept;
  //! "> 0", ">= 0", "0..5", "> 0, <= 1e+06", or "finite"; with "or infinite" behind it.
  [[nodiscard]] std::string text() const;
};

/*!
 * \ingroup group_direct_core
 * \brief One number of a specification: what its docstring, its validation, files and command lines say about it.
 *
 * \code
 * const vpServoGains gains;
 * for (const auto &field : vpServoGains::fields()) {
 *   std::cout << field.name << " " << field.of(gains) << " " << field.unit << ": " << field.description << "\n";
 * }
 * \endcode
 */
template <class Spec> struct vpField {
  const char *name;                                          //!< Name of the member, "integralLimit".
  std::variant<double Spec::*, unsigned int Spec::*> member; //!< The member itself.
  vpFieldRange range;                                        //!< Allowed values.
  const char *unit;                                          //!< "rad/s"; empty for a pure number.
  const char *description;                                   //!< Without unit and range; no full stop.

  //! Value of the field.
  [[nodiscard]] double of(const Spec &spec) const
  {
    return std::visit([&spec](auto pointer) { return static_cast<double>(spec.*pointer); }, member);
  }
  //! Sets the field to \e value, which is whole and >= 0 where the member is unsigned; not validated.
  void set(Spec &spec, double value) const
  {
    std::visit(
        [&spec, value](auto pointer) {
          auto &number = spec.*pointer;
          number = static_cast<std::decay_t<decltype(number)>>(value);
        },
        member);
  }
};

//! \ingroup group_direct_core
//! \brief All numbers of a specification, in the order of its header.
template <class Spec> using vpFields = std::vector<vpField<Spec>>;

//! \ingroup group_direct_core
//! \brief Name of a field in files, from its name in C++ and its unit: `integral_limit_radps`, `lag_s`; a pure number and
//! "1/s" add nothing.
[[nodiscard]] VISP_EXPORT std::string vpFieldFileName(const std::string &name, const std::string &unit);

/*!
 * \ingroup group_direct_core
 * \brief Requires a value to be in its range.
 * \param name : Name of the field. \param owner : As in "of the servo gains"; empty: not mentioned.
 * \param value : Value of the field. \param unit : Its unit, for the message. \param range : Allowed values.
 * \throw vpException (badValue): "integralLimit of the servo gains is -1 rad/s, must be > 0".
 */
VISP_EXPORT void vpCheckField(const char *name, const char *owner, double value, const char *unit,
                              const vpFieldRange &range);

/*!
 * \ingroup group_direct_core
 * \brief Requires all fields of \e spec to be in their ranges; \e owner as for vpCheckField().
 * \throw vpException (badValue), see vpCheckField().
 */
template <class Spec> void vpCheckFields(const Spec &spec, const vpFields<Spec> &fields, const char *owner)
{
  for (const vpField<Spec> &field : fields) {
    vpCheckField(field.name, owner, field.of(spec), field.unit, field.range);
  }
}

END_VISP_NAMESPACE
#endif
