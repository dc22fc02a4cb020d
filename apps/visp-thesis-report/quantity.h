/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file quantity.h
 * \brief A value of the thesis beside ours, and what comes of comparing them.
 */
#ifndef thesisReport_quantity_h
#define thesisReport_quantity_h

#include <optional>
#include <string>

namespace thesisReport
{
//! \brief How near a value must be to the thesis's. Stated before anything is measured, and part of the report.
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

  //! True if \e ours is within it. What is not finite never is.
  [[nodiscard]] bool holds(double thesis, double ours) const;
  //! In words: "within a factor 1.1".
  [[nodiscard]] std::string text() const;

private:
  enum class Kind { Factor, Distance, AtMost, AtLeast };
  Tolerance(Kind kind, double size) : m_kind(kind), m_size(size) {}
  Kind m_kind;
  double m_size;
};

//! Which way a value is better than another.
enum class Good { Neither, Smaller, Larger };

//! What a comparison says.
enum class Verdict {
  Agrees,  //!< Within the tolerance.
  Better,  //!< Outside, on the good side.
  Differs, //!< Outside.
  NoValue  //!< The thesis gives none; ours stands for itself.
};

//! "agrees", "better", "differs", "no value in the thesis".
[[nodiscard]] const char *toString(Verdict verdict);

//! \brief One row of results.json.
struct Quantity {
  std::string name;             //!< "rms velocity error".
  std::string unit;             //!< "px/frame"; "1" for a ratio or a count.
  std::optional<double> thesis; //!< Its value, or the bound that it claims; none: not told.
  double ours = 0.;             //!< Measured in this run.
  Tolerance tolerance = Tolerance::factor(1.1);
  Good good = Good::Neither;
  std::string reason; //!< Why it differs when it does; shown only then.
  std::string note;   //!< How it was measured; always shown.
};

//! Compare. Computed from the numbers alone.
[[nodiscard]] Verdict verdictOf(const Quantity &quantity);
//! ours / thesis; nothing without a value or where the thesis's is 0.
[[nodiscard]] std::optional<double> ratioOf(const Quantity &quantity);
//! Note and, where it does not agree, the reason; "not explained" where one is owed and there is none.
[[nodiscard]] std::string remarkOf(const Quantity &quantity);
} // namespace thesisReport

#endif
