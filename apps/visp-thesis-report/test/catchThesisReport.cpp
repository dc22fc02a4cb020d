/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Verdicts follow from the numbers; the catalogue covers the results of the thesis.
#include "report.h"

#include "vpCatch.h"

#include <cmath>
#include <limits>
#include <set>

using namespace thesisReport;

namespace
{
Quantity quantity(double thesis, double ours, const Tolerance &tolerance, Good good = Good::Neither)
{
  return {"q", "m", thesis, ours, tolerance, good, "because", "noted"};
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

TEST_CASE("A reason is shown where it is owed, and its absence too", "[verdict]")
{
  Quantity q = quantity(1., 1., Tolerance::factor(1.1));
  CHECK(remarkOf(q) == "noted");
  q.ours = 3.;
  CHECK(remarkOf(q) == "noted because");
  q.reason.clear();
  CHECK(remarkOf(q) == "noted Not explained.");
  CHECK(*ratioOf(q) == 3.);
  q.thesis = 0.;
  CHECK_FALSE(ratioOf(q).has_value());
}

TEST_CASE("An item is as its worst quantity", "[verdict]")
{
  Item item;
  CHECK(verdictOf(item) == Verdict::NoValue);
  item.quantities = {quantity(1., 1., Tolerance::factor(1.1))};
  CHECK(verdictOf(item) == Verdict::Agrees);
  item.quantities.push_back(quantity(1., 0.1, Tolerance::factor(1.1), Good::Smaller));
  CHECK(verdictOf(item) == Verdict::Better);
  item.quantities.push_back(quantity(1., 10., Tolerance::factor(1.1), Good::Smaller));
  CHECK(verdictOf(item) == Verdict::Differs);
}

TEST_CASE("Rows of results.json are computed and null where there is nothing", "[results]")
{
  const Part part{"Chapter 6: x", {{"fig6.3", "t"}}, 1., {}};
  Item item;
  item.id = "fig6.3";
  item.quantities = {quantity(2., 1., Tolerance::factor(1.1)), quantity(0., 1., Tolerance::distance(2.)),
                     quantity(1., std::nan(""), Tolerance::distance(2.))};
  const auto rows = resultsJson({{&part, {item}, 0.}});
  REQUIRE(rows.size() == 3);
  CHECK(rows[0]["id"] == "fig6.3");
  CHECK(rows[0]["ratio"] == 0.5);
  CHECK(rows[0]["verdict"] == "differs");
  CHECK(rows[0]["note"] == "noted because");
  CHECK(rows[0]["tolerance"] == "within a factor 1.1");
  CHECK(rows[1]["ratio"].is_null());
  CHECK(rows[1]["verdict"] == "agrees");
  CHECK(rows[2]["ours"].is_null());
  CHECK(rows[2]["verdict"] == "differs");
}

TEST_CASE("Data behind a picture: every finite point, texts in quotes where they need them", "[data]")
{
  vpApp::Plot plot;
  plot.title = "A, b";
  plot.xLabel = "time (s)";
  plot.yLabel = "y \"quoted\"";
  plot.curves = {{"c", "#000000", vpApp::PlotStyle::Solid, 1., {0., 1., 2.}, {5., std::nan(""), 7.}}};
  CHECK(csvOf({plot}) == "panel,curve,x_label,y_label,x,y\n\"A, b\",c,time (s),\"y \"\"quoted\"\"\",0,5\n"
                         "\"A, b\",c,time (s),\"y \"\"quoted\"\"\",2,7\n");
}

TEST_CASE("The catalogue has every figure and table with results, once", "[catalogue]")
{
  const std::set<std::string> expected = {
      "table4.2", "table4.3", "fig5.6",   "fig5.7",  "fig5.8",  "fig5.9",  "fig5.10", "fig5.11",
      "fig6.3",   "fig6.4",   "fig6.5",   "fig6.6",  "fig7.1",  "eq7.1",   "eq7.2",   "table7.1",
      "table7.2", "table7.3", "table7.4", "fig7.10", "fig7.11", "fig7.12", "fig7.13", "fig7.14",
      "fig7.15",  "fig8.6",   "fig8.7",   "fig8.8",  "fig8.9",  "fig8.10", "fig8.13", "table8.1",
      "fig8.14",  "fig8.15",  "fig8.16",  "fig8.17", "tableA.1"};
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
