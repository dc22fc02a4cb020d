/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file judgement.h
 * \brief Where each value of the thesis stands, what a comparison with it can say, and what supports a reason.
 */
#ifndef thesisReport_judgement_h
#define thesisReport_judgement_h

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace thesisReport
{
//! What a comparison with the thesis can say.
enum class RowKind {
  Compared,       //!< Another result was possible.
  Arithmetic,     //!< Computed from other numbers of the thesis: says whether these fit together.
  ByConstruction, //!< The thesis's value, or what it follows from, was an input of the run or fitted to it.
  NotComparable   //!< What decides the value is not known, or was another.
};

//! "value", "arithmetic", "by construction", "not comparable".
[[nodiscard]] const char *vpToString(RowKind kind);

//! \brief What a second reader needs for a row that has a value of the thesis.
struct Judgement {
  RowKind kind = RowKind::Compared;
  std::string where;     //!< Section, figure, table or equation.
  std::string quote;     //!< A few words of the thesis, to be searched for.
  std::string tolerance; //!< Where the tolerance comes from.
  std::string why;       //!< Reason, for by construction and not comparable, or where Quantity::reason is empty.
  std::string support;   //!< A command, a test ("catchName, \"case\"") or a row that shows the reason.
};

//! \brief The judgements of all rows, by id and name; a star in a name stands for any text.
class Judgements
{
public:
  //! \param file : data/thesis/rows.json. \throw vpFileError naming the field.
  explicit Judgements(const std::string &file);
  //! \throw std::runtime_error naming the row when there is none.
  [[nodiscard]] const Judgement &of(const std::string &id, const std::string &row) const;
  //! All of them, with the pattern of the row's name, by id.
  [[nodiscard]] const std::map<std::string, std::vector<std::pair<std::string, Judgement>>> &all() const
  {
    return m_all;
  }

private:
  std::map<std::string, std::vector<std::pair<std::string, Judgement>>> m_all;
};

//! Whether \e text is like \e pattern, in which a star stands for any text.
[[nodiscard]] bool isLike(const std::string &text, const std::string &pattern);
} // namespace thesisReport

#endif
