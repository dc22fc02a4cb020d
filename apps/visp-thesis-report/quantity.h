/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file quantity.h
 * \brief A value of the thesis beside ours, and their comparison.
 */
#ifndef thesisReport_quantity_h
#define thesisReport_quantity_h

#include <optional>
#include <string>

namespace thesisReport
{
//! \brief Tolerance relative to the thesis's value, set before any measurement and part of the report.
class Tolerance
{
public:
  //! Within a factor: thesis / size <= ours <= thesis * size, both of the same sign. \param size : > 1.
  [[nodiscard]] static Tolerance factor(double size) { return {Kind::Factor, size}; }
  //! |ours - thesis| <= size. \param size : In the unit of the quantity, >= 0.
  [[nodiscard]] static Tolerance distance(double size) { return {Kind::Distance, size}; }
  //! A bound, or a claim that something is not larger: ours <= thesis + size.
  [[nodiscard]] static Tolerance atMost(double size = 0.) { return {Kind::AtMost, size}; }
  //! A claim that something is not smaller: ours >= thesis - size.
  [[nodiscard]] static Tolerance atLeast(double size = 0.) { return {Kind::AtLeast, size}; }

  //! True if \e ours is within the tolerance; false for non-finite values.
  [[nodiscard]] bool holds(double thesis, double ours) const;
  //! In words: "within a factor 1.1".
  [[nodiscard]] std::string text() const;

  //! See archive.h.
  template <class Archive> friend void exchange(Archive &archive, Tolerance &tolerance)
  {
    archive(tolerance.m_kind, tolerance.m_size);
  }

private:
  enum class Kind { Factor, Distance, AtMost, AtLeast };
  Tolerance(Kind kind, double size) : m_kind(kind), m_size(size) {}
  Kind m_kind;
  double m_size;
};

//! Direction in which a value is better.
enum class Good { Neither, Smaller, Larger };

//! Result of a comparison.
enum class Verdict {
  Agrees,  //!< Within the tolerance.
  Better,  //!< Outside the tolerance, on the good side.
  Differs, //!< Outside the tolerance.
  NoValue  //!< The thesis gives no value.
};

//! "agrees", "better", "differs", "no value in the thesis".
[[nodiscard]] const char *vpToString(Verdict verdict);

//! \brief One row of results.json.
struct Quantity {
  std::string name;             //!< "rms velocity error".
  std::string unit;             //!< "px/frame"; "1" for a ratio or a count.
  std::optional<double> thesis; //!< Value or claimed bound of the thesis; none: not given.
  double ours = 0.;             //!< Measured in this run.
  Tolerance tolerance = Tolerance::factor(1.1);
  Good good = Good::Neither;
  std::string reason; //!< Reason for a difference; shown only then.
  std::string note;   //!< Measurement method; always shown.
};

//! Comparison, computed only from the numbers.
[[nodiscard]] Verdict verdictOf(const Quantity &quantity);
//! ours / thesis; nullopt without a value or if the thesis's is 0.
[[nodiscard]] std::optional<double> ratioOf(const Quantity &quantity);
//! Note and, if the values disagree, the reason; "not explained" if it is missing.
[[nodiscard]] std::string remarkOf(const Quantity &quantity);
} // namespace thesisReport

#endif
