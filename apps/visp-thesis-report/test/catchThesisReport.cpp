/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Verdicts follow from the numbers and from what a row can say; the catalogue covers the results of the thesis.
#include "keypointItems.h"
#include "results.h"

#include "dataFile.h"
#include "testFolder.h"
#include "vpCatch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

using namespace thesisReport;

namespace
{
Quantity quantity(double thesis, double ours, const Tolerance &tolerance, Good good = Good::Neither,
                  RowKind kind = RowKind::Compared)
{
  Quantity q{"q", "m", thesis, ours, tolerance, good, "because", "noted"};
  q.judgement.kind = kind;
  return q;
}
} // namespace

TEST_CASE("A verdict is computed from value, tolerance and the good side", "[verdict]")
{
  CHECK(verdictOf(quantity(2., 2.1, Tolerance::factor(1.1))) == Verdict::Agrees);
  CHECK(verdictOf(quantity(2., 1.85, Tolerance::factor(1.1))) == Verdict::Agrees);
  CHECK(verdictOf(quantity(2., 2.3, Tolerance::factor(1.1))) == Verdict::Differs);
  CHECK(verdictOf(quantity(2., 1.7, Tolerance::factor(1.1))) == Verdict::Differs);
  CHECK(verdictOf(quantity(2., 1.7, Tolerance::factor(1.1), Good::Smaller)) == Verdict::Better);
  CHECK(verdictOf(quantity(2., 2.3, Tolerance::factor(1.1), Good::Smaller)) == Verdict::Differs);
  CHECK(verdictOf(quantity(2., 2.3, Tolerance::factor(1.1), Good::Larger)) == Verdict::Better);
  CHECK(verdictOf(quantity(-2., 2., Tolerance::factor(1.1))) == Verdict::Differs);
  CHECK(verdictOf(quantity(-2., -2.1, Tolerance::factor(1.1))) == Verdict::Agrees);
  CHECK(verdictOf(quantity(0., 0.1, Tolerance::distance(0.1))) == Verdict::Agrees);
  CHECK(verdictOf(quantity(0., -0.11, Tolerance::distance(0.1))) == Verdict::Differs);
  CHECK(verdictOf(quantity(1., 1.01, Tolerance::atMost(0.02))) == Verdict::Agrees);
  CHECK(verdictOf(quantity(1., 1.03, Tolerance::atMost(0.02), Good::Smaller)) == Verdict::Differs);
  CHECK(verdictOf(quantity(1., -7., Tolerance::atMost())) == Verdict::Agrees);
  CHECK(verdictOf(quantity(1., 0.99, Tolerance::atLeast())) == Verdict::Differs);
  CHECK(verdictOf(quantity(1., 5., Tolerance::atLeast())) == Verdict::Agrees);
  for (const double odd : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
    for (const Tolerance &tolerance :
         {Tolerance::factor(2.), Tolerance::distance(9.), Tolerance::atMost(9.), Tolerance::atLeast(9.)}) {
      CHECK(verdictOf(quantity(1., odd, tolerance)) == Verdict::Differs);
    }
  }
  Quantity unknown = quantity(1., 1., Tolerance::factor(2.));
  unknown.thesis.reset();
  CHECK(verdictOf(unknown) == Verdict::NoValue);
}

TEST_CASE("What cannot fail is no agreement, and what fails although it cannot is said", "[verdict]")
{
  const auto kind = [](RowKind of, double ours) {
    return quantity(2., ours, Tolerance::factor(1.1), Good::Smaller, of);
  };
  CHECK(verdictOf(kind(RowKind::ByConstruction, 2.)) == Verdict::ByConstruction);
  CHECK(verdictOf(kind(RowKind::ByConstruction, 1.)) == Verdict::Differs); // never better
  CHECK(verdictOf(kind(RowKind::ByConstruction, std::nan(""))) == Verdict::Differs);
  for (const double ours : {2., 1., 9., std::nan("")}) {
    CHECK(verdictOf(kind(RowKind::NotComparable, ours)) == Verdict::NotComparable);
  }
  CHECK(verdictOf(kind(RowKind::Arithmetic, 2.)) == Verdict::Agrees);
  CHECK(couldFail(kind(RowKind::Compared, 2.)));
  CHECK(couldFail(kind(RowKind::Arithmetic, 2.)));
  CHECK_FALSE(couldFail(kind(RowKind::ByConstruction, 2.)));
  CHECK_FALSE(couldFail(kind(RowKind::NotComparable, 2.)));
  CHECK(kindOf(kind(RowKind::Compared, 2.)) == "value");
  CHECK(kindOf(quantity(1., 1., Tolerance::atMost())) == "bound");
  CHECK(kindOf(quantity(1., 1., Tolerance::atLeast(), Good::Neither, RowKind::NotComparable)) == "not comparable");
}

TEST_CASE("A reason is shown where it is owed, and its absence too", "[verdict]")
{
  Quantity q = quantity(1., 1., Tolerance::factor(1.1));
  q.judgement.why = "why";
  CHECK(reasonOf(q).empty());
  q.ours = 3.;
  CHECK(reasonOf(q) == "because");
  q.reason.clear();
  CHECK(reasonOf(q) == "why");
  q.judgement.why.clear();
  CHECK(reasonOf(q) == "Not explained.");
  CHECK(*ratioOf(q) == 3.);
  q.thesis = 0.;
  CHECK_FALSE(ratioOf(q).has_value());
  q = quantity(1., 1., Tolerance::factor(1.1), Good::Neither, RowKind::ByConstruction);
  q.judgement.why = "why";
  CHECK(reasonOf(q) == "why"); // not the reason for a difference
}

TEST_CASE("An item is as its worst quantity", "[verdict]")
{
  Item item;
  CHECK(verdictOf(item) == Verdict::NoValue);
  const auto add = [&](double ours, RowKind kind) {
    item.quantities.push_back(quantity(1., ours, Tolerance::factor(1.1), Good::Smaller, kind));
    return verdictOf(item);
  };
  CHECK(add(1., RowKind::NotComparable) == Verdict::NotComparable);
  CHECK(add(1., RowKind::ByConstruction) == Verdict::ByConstruction);
  CHECK(add(1., RowKind::Compared) == Verdict::Agrees);
  CHECK(add(0.1, RowKind::Compared) == Verdict::Better);
  CHECK(add(10., RowKind::Compared) == Verdict::Differs);
}

TEST_CASE("Seeds become a median, a spread and the share that agrees with its verdict", "[seeds]")
{
  const auto item = [](double ours) {
    Item one;
    one.id = "fig6.3";
    one.quantities = {quantity(2., ours, Tolerance::factor(1.1))};
    return one;
  };
  const Item merged = seedsMerged({item(2.1), item(9.), item(2.)});
  REQUIRE(merged.quantities.size() == 1);
  CHECK(merged.quantities[0].ours == 2.1);
  CHECK(shareOfSeeds(merged.quantities[0]) == Approx(2. / 3.));
  const Part part{"Chapter 6: x", {{"fig6.3", "t"}}, 1., {}};
  const auto row = resultsJson({{&part, {merged}, 0.}})[0];
  CHECK(row["spread"].get<double>() ==
        Approx(4.012896).epsilon(1e-5)); // by hand: sqrt((2.267^2 + 4.633^2 + 2.367^2) / 2)
  CHECK(row["least"] == 2.);
  CHECK(row["largest"] == 9.);
  CHECK(row["seeds"] == 3);
  const auto bound = [&](double ours) {
    Item one = item(ours);
    one.quantities[0].never = true;
    return one;
  };
  CHECK(seedsMerged({bound(2.1), bound(9.), bound(2.)}).quantities[0].ours == 9.);
  const auto always = [&](double ours) {
    Item one = bound(ours);
    one.quantities[0].tolerance = Tolerance::atLeast();
    return one;
  };
  CHECK(seedsMerged({always(2.1), always(9.), always(2.)}).quantities[0].ours == 2.);
  for (const Item &unknown : {item(std::nan("")), bound(std::nan(""))}) {
    CHECK(verdictOf(seedsMerged({unknown, bound(2.), bound(2.)}).quantities[0]) == Verdict::Differs);
  }
  Item other = item(2.);
  other.quantities[0].name = "p";
  CHECK_THROWS_WITH(seedsMerged({item(2.), other}), "fig6.3: not every seed has the row q");
  other.quantities.clear();
  CHECK_THROWS_WITH(seedsMerged({item(2.), other}), "fig6.3: not every seed has the row q");
}

TEST_CASE("The time of the core stands still while the thread waits, and while another one works", "[time]")
{
  const double begin = coreSeconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  std::thread([] {
    const double start = coreSeconds();
    while (coreSeconds() < start + 0.2) {
    }
  }).join();
  CHECK(coreSeconds() - begin < 0.1);
}

TEST_CASE("Rows of results.json are computed and null where there is nothing", "[results]")
{
  const Part part{"Chapter 6: x", {{"fig6.3", "t"}}, 1., {}, false};
  Item item;
  item.id = "fig6.3";
  item.quantities = {quantity(2., 1., Tolerance::factor(1.1)), quantity(0., 1., Tolerance::distance(2.)),
                     quantity(1., std::nan(""), Tolerance::distance(2.))};
  item.quantities[0].judgement.where = "here";
  item.quantities[0].judgement.support = "that";
  item.quantities[1].judgement.support = "that";
  const std::vector<Played> all = {{&part, {seedsMerged({item})}, 0.}};
  const auto rows = resultsJson(all);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0]["id"] == "fig6.3");
  CHECK(rows[0]["ratio"] == 0.5);
  CHECK(rows[0]["verdict"] == "differs");
  CHECK(rows[0]["reason"] == "because");
  CHECK(rows[0]["support"] == "that");
  CHECK(rows[0]["where"] == "here");
  CHECK(rows[0]["tolerance"] == "within a factor 1.1");
  CHECK(rows[0]["deterministic"] == true);
  CHECK(rows[0]["spread"].is_null());
  CHECK(rows[1]["ratio"].is_null());
  CHECK(rows[1]["verdict"] == "agrees");
  CHECK(rows[1]["support"] == "");
  CHECK(rows[2]["ours"].is_null());
  CHECK(rows[2]["verdict"] == "differs");
  const auto summary = summaryJson(all, {}, "", 0.);
  CHECK(summary["could_fail"]["value"] ==
        nlohmann::ordered_json({{"agrees", 1}, {"better", 0}, {"differs", 2}, {"rows", 3}}));
  CHECK(summary["could_fail"]["all"] == summary["could_fail"]["value"]);
  CHECK(summary["rows"]["differs"] == 2);
  CHECK(summary["items"]["differs"] == 1);
}

TEST_CASE("Curves: every point, gaps where the line is interrupted, texts apart from the numbers", "[data]")
{
  vpApp::Plot plot;
  plot.title = "A, b";
  plot.xRange = {0., 2.};
  plot.curves = {{"c", "#000000", vpApp::PlotStyle::Dashed, 1., {0., 1., 2.}, {5., std::nan(""), 7.}}};
  const Part part{"Chapter 6: x", {{"fig6.3", "t"}}, 1., {}};
  Item item;
  item.id = "fig6.3";
  addPlot(item, "motion", "title", "caption", {vpApp::Plot(), plot});
  const std::vector<Played> all = {{&part, {item}, 0.}};
  CHECK(curvesCsv(all) == "item,figure,panel,curve,x,y\nfig6.3,motion,1,0,0,5\nfig6.3,motion,1,0,1,\n"
                          "fig6.3,motion,1,0,2,7\n");
  const auto panel = itemsJson(all)[0]["figures"][0]["panels"][1];
  CHECK(panel["title"] == "A, b");
  CHECK(panel["x_range"] == nlohmann::ordered_json({0., 2.}));
  CHECK(panel["curves"][0]["style"] == "dashed");
}

TEST_CASE("What the means of table 4.3 say of the sentences below it", "[errata]")
{
  // By hand, from the printed means: (0.23 + 0.32) / 2 / 0.78, (1.30 + 1.05) / 2 / 0.67, (0.44 + 0.37) / 2 / 0.53, ...
  const std::vector<double> expected = {0.352564, 1.753731, 0.764151, 0.348101, 3.945946, 4.783784};
  const std::vector<Quantity> orders = ownOrders();
  REQUIRE(orders.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(orders[i].name);
    CHECK(orders[i].ours == Approx(expected[i]).epsilon(1e-5));
    CHECK((verdictOf(orders[i]) == Verdict::Differs) ==
          (i == 0 || i == 2)); // roll and yaw are better at 30 deg than at 0
  }
}

TEST_CASE("A star in a row's name stands for any text", "[judgement]")
{
  CHECK(isLike("abc", "abc"));
  CHECK(isLike("abc", "*"));
  CHECK(isLike("", "*"));
  CHECK(isLike("abc", "a*c"));
  CHECK(isLike("abcbc", "a*bc"));
  CHECK(isLike("aXbYc", "a*b*c"));
  CHECK_FALSE(isLike("abc", "ab"));
  CHECK_FALSE(isLike("ab", "abc"));
  CHECK_FALSE(isLike("abcd", "a*c"));
  CHECK_FALSE(isLike("ba", "a*"));
}

TEST_CASE("The rows that a support names", "[judgement]")
{
  using Rows = std::vector<std::pair<std::string, std::string>>;
  CHECK(rowsNamedIn("`catchNothing`, \"case\"").empty());
  CHECK(rowsNamedIn("rows of sec4.6; `catchNothing`, \"case\"").empty());
  CHECK(rowsNamedIn("row of fig5.6 \"a: b\"") == Rows{{"fig5.6", "a: b"}});
  CHECK(rowsNamedIn("rows of tableA.1 \"a\" and \"*b\", alike; row of eq7.2 \"c\"") ==
        Rows{{"tableA.1", "a"}, {"tableA.1", "*b"}, {"eq7.2", "c"}});
}

TEST_CASE("Judgements: each has a place and words of the thesis and a tolerance, and names what is wrong",
          "[judgement]")
{
  const Judgements judgements(vpApp::dataFile("thesis/rows.json"));
  const std::vector<std::string> ids = allIds();
  for (const auto &item : judgements.all()) {
    CAPTURE(item.first);
    CHECK(std::count(ids.begin(), ids.end(), item.first) == 1);
    for (const auto &row : item.second) {
      CAPTURE(row.first);
      CHECK_FALSE(row.second.where.empty());
      CHECK_THAT(row.second.where, Catch::Matchers::Matches(".*, line [0-9]+( (to|and) [0-9]+)? of the transcription"));
      CHECK_FALSE(row.second.quote.empty());
      CHECK_FALSE(row.second.tolerance.empty());
    }
  }
  CHECK(judgements.of("fig7.13", "mean velocity").kind == RowKind::ByConstruction);
  CHECK_THROWS_WITH(judgements.of("fig7.13", "nothing"), Catch::Contains("fig7.13: the row \"nothing\""));
  const auto wrong = [](const std::string &row) {
    const TestFolder folder;
    return Judgements(folder.write("rows.json", R"({"fig6.3": {"where": "w", "line": "7", "rows": [)" + row + "]}}"))
        .all()
        .size();
  };
  CHECK(wrong(R"({"row": "a"})") == 1);
  CHECK_THROWS_WITH(wrong(R"({"row": "a", "kind": "sure"})"),
                    Catch::Contains("rows[0].kind is \"sure\", must be value"));
  CHECK_THROWS_WITH(wrong(R"({"row": "a", "kind": "by construction"})"), Catch::Contains("why is"));
  CHECK_THROWS_WITH(wrong(R"({"row": "a", "why": "b"})"), Catch::Contains("support is"));
  CHECK_THROWS_WITH(wrong(R"({"kind": "value"})"), Catch::Contains("rows[0].row is missing"));
  CHECK_THROWS_WITH(wrong(R"({"row": "a", "quotation": "b"})"), Catch::Contains("unknown field"));
}

TEST_CASE("The catalogue has every figure and table with results, once", "[catalogue]")
{
  const std::set<std::string> expected = {
      "table4.2", "table4.3", "sec4.6",  "eq5.31",   "fig6.1",   "eq6.10",   "sec9.2",   "fig5.6",  "fig5.7",
      "fig5.8",   "fig5.9",   "fig5.10", "fig5.11",  "fig6.3",   "fig6.4",   "fig6.5",   "fig6.6",  "fig7.1",
      "fig7.3",   "eq7.1",    "eq7.2",   "table7.1", "table7.2", "table7.3", "table7.4", "fig7.10", "fig7.11",
      "fig7.12",  "fig7.13",  "fig7.14", "fig7.15",  "fig8.6",   "fig8.7",   "fig8.8",   "fig8.9",  "fig8.10",
      "fig8.13",  "table8.1", "fig8.14", "fig8.15",  "fig8.16",  "fig8.17",  "tableA.1"};
  const std::vector<std::string> ids = allIds();
  CHECK(std::set<std::string>(ids.begin(), ids.end()) == expected);
  CHECK(ids.size() == expected.size());
  for (const Part &part : catalogue()) {
    CHECK(part.cost > 0.);
    CHECK((chapterName(part).rfind("chapter", 0) == 0 || chapterName(part) == "appendixA"));
    for (const Entry &entry : part.entries) {
      CHECK_FALSE(entry.title.empty());
    }
  }
}
