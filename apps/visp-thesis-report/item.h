/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file item.h
 * \brief A reproduced figure or table of the thesis: its values beside ours, its curves, and the statistics of what was measured.
 */
#ifndef thesisReport_item_h
#define thesisReport_item_h

#include "judgement.h"
#include "curves.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace thesisReport
{
//! \brief Tolerance relative to the thesis's value, part of the report; rows.json says where it comes from.
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
  //! A bound or a claim: only one side is wrong.
  [[nodiscard]] bool isOneSided() const { return m_kind == Kind::AtMost || m_kind == Kind::AtLeast; }
  //! A lower bound.
  [[nodiscard]] bool isAtLeast() const { return m_kind == Kind::AtLeast; }

  //! See sweep.h.
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

//! Result of a comparison. What cannot fail is not an agreement.
enum class Verdict {
  Agrees,         //!< Within the tolerance.
  Better,         //!< Outside the tolerance, on the good side.
  Differs,        //!< Outside the tolerance.
  ByConstruction, //!< Within the tolerance, as the thesis's value went into the run.
  NotComparable,  //!< Conditions of the thesis that decide the value are not known, or others.
  NoValue         //!< The thesis gives no value.
};

//! "agrees", "better", "differs", "by construction", "not comparable", "no value in the thesis".
[[nodiscard]] const char *vpToString(Verdict verdict);

//! \brief One row of results.json.
struct Quantity {
  std::string name;             //!< "rms velocity error".
  std::string unit;             //!< "px/frame"; "1" for a ratio or a count.
  std::optional<double> thesis; //!< Value or claimed bound of the thesis; none: not given.
  double ours = 0.;             //!< Measured in this run; of several seeds the median, or the worst if #never.
  Tolerance tolerance = Tolerance::factor(1.1);
  Good good = Good::Neither;
  std::string reason;          //!< Reason for a difference; shown only then.
  std::string note;            //!< Measurement method; always shown. Of several seeds that of the first.
  bool never = false;          //!< A bound that no run may break: one that does so is enough.
  Judgement judgement{};       //!< What a second reader needs; see Judgements.
  std::vector<double> seeds{}; //!< #ours of each seed; empty before seedsMerged().
};

//! Comparison, computed only from the numbers and Judgement::kind.
[[nodiscard]] Verdict verdictOf(const Quantity &quantity);
//! ours / thesis; nullopt without a value or if the thesis's is 0.
[[nodiscard]] std::optional<double> ratioOf(const Quantity &quantity);
//! Why the verdict is no agreement, empty for one; "not explained" if it is missing.
[[nodiscard]] std::string reasonOf(const Quantity &quantity);
//! What a row can say: "value", "bound", "arithmetic", "by construction", "not comparable", "ours only".
[[nodiscard]] std::string kindOf(const Quantity &quantity);
//! Whether another result was possible: a value, a bound, or arithmetic with numbers of the thesis.
[[nodiscard]] bool couldFail(const Quantity &quantity);
//! Fraction of the seeds that give verdictOf() alone; 1 without seeds.
[[nodiscard]] double shareOfSeeds(const Quantity &quantity);

//! \brief A figure of the report.
struct Figure {
  std::string name;                  //!< Name within its item: "velocity".
  std::string title;                 //!< Alternative text.
  std::string caption;               //!< Explanation.
  std::vector<vpApp::Plot> panels{}; //!< Below each other, drawn by Python; empty for a picture.
  std::string picture{};             //!< PNG or JPEG data; empty for panels.
  std::string suffix = "png";        //!< "png" or "jpg".
};

//! \brief A table that is kept beside the results.
struct DataFile {
  std::string name;    //!< File name within its item: "velocity.csv".
  std::string content; //!< CSV with a line of names and units.
};

//! \brief One figure or table.
struct Item {
  std::string id;                                              //!< "fig6.3".
  std::vector<Quantity> quantities;                            //!< At least one with a value of the thesis.
  std::vector<Figure> figures;                                 //!< Figures.
  std::vector<DataFile> data;                                  //!< Tables beside the curves of the figures.
  std::vector<std::pair<std::string, std::string>> parameters; //!< Parameters of the run: name, value.
  std::vector<std::string> remarks;                            //!< Results, and choices left open by the thesis.
};

//! The verdict over all quantities: differs if one does, else better, agrees, by construction, not comparable, whichever comes first.
[[nodiscard]] Verdict verdictOf(const Item &item);

/*!
 * The same item from several seeds as one: values become medians and keep those of the seeds; all else is that of the first.
 * \throw std::runtime_error naming the row that not all of them have.
 */
[[nodiscard]] Item seedsMerged(std::vector<Item> seeds);

//! Add a figure of panels below each other to the item.
void addPlot(Item &item, const std::string &name, const std::string &title, const std::string &caption,
             const std::vector<vpApp::Plot> &panels);

//! Colours distinguishable with colour blindness, in order of use.
[[nodiscard]] const std::string &colour(std::size_t i);

//! Add a curve in the next colour.
void addCurve(vpApp::Plot &plot, const std::string &label, std::vector<double> x, std::vector<double> y,
              vpApp::PlotStyle style = vpApp::PlotStyle::Solid);

//! A dashed grey line at \e value (and at -value when \e both) over the width of the curves so far.
void addBound(vpApp::Plot &plot, double value, bool both, const std::string &label = "bound");

//! \brief Collects values. All statistics are 0 without values.
class Spread
{
public:
  void add(double value) { m_values.push_back(value); }
  [[nodiscard]] std::size_t count() const { return m_values.size(); }
  [[nodiscard]] double mean() const;
  //! Standard deviation about the mean, of a sample (n - 1); 0 for a single value.
  [[nodiscard]] double sigma() const;
  [[nodiscard]] double rms() const; //!< Root mean square, about 0.
  [[nodiscard]] double largest() const;
  //! Quantile: the value not exceeded by the fraction \e share. \param share : 0..1.
  [[nodiscard]] double quantile(double share) const;
  [[nodiscard]] double median() const { return quantile(0.5); }

private:
  std::vector<double> m_values;
};

//! CPU time of this thread, s; waiting for a core does not count, as parts of the report and other programs run in
//! parallel.
[[nodiscard]] double coreSeconds();
} // namespace thesisReport

#endif
