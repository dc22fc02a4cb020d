/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file htmlReport.h
 * \brief A report as one HTML file that needs nothing else: style, pictures and videos are inside.
 */
#ifndef vpApp_htmlReport_h
#define vpApp_htmlReport_h

#include <string>
#include <vector>

namespace vpApp
{
//! Text made safe for HTML, in element content and in quoted attributes.
[[nodiscard]] std::string escapeHtml(const std::string &text);
//! Bytes as a `data:` address. \param mime : "image/svg+xml", "image/png", "image/jpeg", "video/mp4".
[[nodiscard]] std::string dataUri(const std::string &mime, const std::string &bytes);

//! \brief One cell of a table.
struct HtmlCell {
  HtmlCell(std::string cellText = "", std::string cellStyle = "", unsigned int cellSpan = 1)
    : text(std::move(cellText)), style(std::move(cellStyle)), span(cellSpan)
  {}
  std::string text;      //!< Plain text, escaped when written.
  std::string style;     //!< Names of styles: "best", "worst", "left", "start" (left border), or none.
  unsigned int span = 1; //!< Number of columns that it covers.
  std::string hint;      //!< Shown when the pointer rests on the cell.
};

//! \brief A table: rows of header cells, then rows of cells.
struct HtmlTable {
  using Row = std::vector<HtmlCell>;
  std::vector<Row> header;
  std::vector<Row> rows; //!< A row of a single cell is a group title across the table.
};

/*!
 * \brief Builds the page from top to bottom. All text is plain and escaped; only raw() takes markup.
 */
class HtmlReport
{
public:
  //! \param title : Heading and window title. \param lead : A sentence below it.
  HtmlReport(std::string title, std::string lead);

  //! Begin a section; it is listed in the contents.
  void section(const std::string &title);
  void paragraph(const std::string &text);
  //! A paragraph that stands out: the answer.
  void highlight(const std::vector<std::string> &sentences);
  void list(const std::vector<std::string> &items);
  void table(const HtmlTable &table, const std::string &caption);
  //! Two columns: name, value.
  void facts(const std::vector<std::pair<std::string, std::string>> &facts, const std::string &caption);
  //! A picture with its caption. \param uri : See dataUri(). \param alt : What it shows, for those who cannot see it.
  void picture(const std::string &uri, const std::string &alt, const std::string &caption);
  //! \brief One of several videos side by side.
  struct Video {
    std::string uri;     //!< See dataUri().
    std::string caption; //!< Below the video.
  };
  void videos(const std::vector<Video> &videos);
  //! Everything until endDetails() is folded away under \e summary.
  void beginDetails(const std::string &summary);
  void endDetails();
  //! Markup, as it is.
  void raw(const std::string &html);

  //! The whole page.
  [[nodiscard]] std::string html() const;

private:
  std::string m_title;
  std::string m_lead;
  std::vector<std::string> m_sections;
  std::string m_body;
};
} // namespace vpApp

#endif
