/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "judgement.h"

#include "jsonReader.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace thesisReport
{
namespace
{
constexpr std::array<RowKind, 4> KINDS = {RowKind::Compared, RowKind::Arithmetic, RowKind::ByConstruction,
                                          RowKind::NotComparable};

RowKind kindIn(vpApp::JsonObject &row)
{
  const std::string text = row.text("kind", vpToString(RowKind::Compared));
  const auto kind = std::find_if(KINDS.begin(), KINDS.end(), [&](RowKind k) { return text == vpToString(k); });
  if (kind == KINDS.end()) {
    throw row.wrong("kind", row.value("kind"), "value, arithmetic, by construction or not comparable");
  }
  return *kind;
}

//! The texts of an entry; what it does not have is that of its item. \param line : Of the item.
Judgement judgementIn(vpApp::JsonObject &row, const Judgement &item, const std::string &line)
{
  Judgement judgement;
  judgement.kind = kindIn(row);
  judgement.where = row.text("where", item.where) + ", line " + row.text("line", line) + " of the transcription";
  judgement.quote = row.text("quote", item.quote);
  judgement.tolerance = row.text("tolerance", item.tolerance);
  judgement.why = row.text("why", "");
  judgement.support = row.text("support", "");
  const bool decided = judgement.kind == RowKind::ByConstruction || judgement.kind == RowKind::NotComparable;
  if (decided && judgement.why.empty()) {
    throw row.wrong("why", nlohmann::json(""), "a reason, as the row is not compared");
  }
  if (!judgement.why.empty() && judgement.support.empty()) {
    throw row.wrong("support", nlohmann::json(""), "a command, a test or a row that shows why");
  }
  return judgement;
}
} // namespace

const char *vpToString(RowKind kind)
{
  switch (kind) {
  case RowKind::Compared:
    return "value";
  case RowKind::Arithmetic:
    return "arithmetic";
  case RowKind::ByConstruction:
    return "by construction";
  case RowKind::NotComparable:
    break;
  }
  return "not comparable";
}

bool isLike(const std::string &text, const std::string &pattern)
{
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) {
    return text == pattern;
  }
  if (text.compare(0, star, pattern, 0, star) != 0) {
    return false;
  }
  const std::string rest = pattern.substr(star + 1);
  for (std::size_t from = star; from <= text.size(); ++from) {
    if (isLike(text.substr(from), rest)) {
      return true;
    }
  }
  return false;
}

Judgements::Judgements(const std::string &file)
{
  const nlohmann::json content = vpApp::readJsonFile(file);
  vpApp::JsonObject all(content, file);
  for (const auto &entry : content.items()) {
    vpApp::JsonObject item = all.object(entry.key());
    Judgement common;
    common.where = item.text("where");
    const std::string line = item.text("line");
    common.quote = item.text("quote", "");
    common.tolerance = item.text("tolerance", "");
    item.each("rows", [&](vpApp::JsonObject &row) {
      m_all[entry.key()].emplace_back(row.text("row"), judgementIn(row, common, line));
    });
    item.finish();
  }
}

const Judgement &Judgements::of(const std::string &id, const std::string &row) const
{
  const auto item = m_all.find(id);
  if (item != m_all.end()) {
    for (const auto &entry : item->second) {
      if (isLike(row, entry.first)) {
        return entry.second;
      }
    }
  }
  throw std::runtime_error(id + ": the row \"" + row +
                           "\" has a value of the thesis but no entry in data/thesis/rows.json");
}
} // namespace thesisReport
