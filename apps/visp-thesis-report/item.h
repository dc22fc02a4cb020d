/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file item.h
 * \brief A figure or table of the thesis that was repeated.
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
//! \brief A picture of the report.
struct Figure {
  std::string name;    //!< Within its item: "velocity".
  std::string title;   //!< For those who cannot see it.
  std::string caption; //!< What to see.
  std::string picture; //!< SVG, PNG or JPEG, the bytes.
  std::string mime = "image/svg+xml";
};

//! \brief Data behind a picture or a table.
struct DataFile {
  std::string name;    //!< Within its item, with its suffix: "velocity.csv".
  std::string content; //!< CSV with a line of names and units.
};

//! \brief All about one figure or table.
struct Item {
  std::string id;                                              //!< "fig6.3".
  std::vector<Quantity> quantities;                            //!< At least one with a value of the thesis.
  std::vector<Figure> figures;                                 //!< Pictures.
  std::vector<DataFile> data;                                  //!< Files.
  std::vector<std::pair<std::string, std::string>> parameters; //!< What was run: name, value.
  std::vector<std::string> remarks;                            //!< What came out, and what the thesis leaves open.
};

//! The verdict over all quantities: differs if one does, else better if one is, else agrees.
[[nodiscard]] Verdict verdictOf(const Item &item);

//! Points of all curves of a picture as CSV: panel, curve, x, y; the axes' labels in a second line of names.
[[nodiscard]] std::string csvOf(const std::vector<vpApp::Plot> &panels);

//! Draw panels below each other and put the picture and the data behind it into the item.
void addPlot(Item &item, const std::string &name, const std::string &title, const std::string &caption,
             const std::vector<vpApp::Plot> &panels);
} // namespace thesisReport

#endif
