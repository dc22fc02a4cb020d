/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file item.h
 * \brief A reproduced figure or table of the thesis.
 */
#ifndef thesisReport_item_h
#define thesisReport_item_h

#include "quantity.h"

#include "plot.h"

#include <string>
#include <utility>
#include <vector>

namespace thesisReport
{
//! \brief A figure of the report.
struct Figure {
  std::string name;    //!< Name within its item: "velocity".
  std::string title;   //!< Alternative text.
  std::string caption; //!< Explanation.
  std::string picture; //!< SVG, PNG or JPEG data.
  std::string mime = "image/svg+xml";
};

//! \brief Data of a figure or a table.
struct DataFile {
  std::string name;    //!< File name within its item: "velocity.csv".
  std::string content; //!< CSV with a line of names and units.
};

//! \brief One figure or table.
struct Item {
  std::string id;                                              //!< "fig6.3".
  std::vector<Quantity> quantities;                            //!< At least one with a value of the thesis.
  std::vector<Figure> figures;                                 //!< Figures.
  std::vector<DataFile> data;                                  //!< Data files.
  std::vector<std::pair<std::string, std::string>> parameters; //!< Parameters of the run: name, value.
  std::vector<std::string> remarks;                            //!< Results, and choices left open by the thesis.
};

//! The verdict over all quantities: differs if one does, else better if one is, else agrees.
[[nodiscard]] Verdict verdictOf(const Item &item);

//! Points of all curves of a figure as CSV: panel, curve, x, y; axis labels in a second line of names.
[[nodiscard]] std::string csvOf(const std::vector<vpApp::Plot> &panels);

//! Draw panels below each other and add the figure and its data to the item.
void addPlot(Item &item, const std::string &name, const std::string &title, const std::string &caption,
             const std::vector<vpApp::Plot> &panels);
} // namespace thesisReport

#endif
