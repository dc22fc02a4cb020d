/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file htmlReport.h
 * \brief A report as one self-contained HTML file: style, figures and videos are embedded.
 */
#ifndef vpApp_htmlReport_h
#define vpApp_htmlReport_h

#include <string>
#include <vector>

namespace vpApp
{
//! Text escaped for HTML, for element content and quoted attributes.
[[nodiscard]] std::string escapeHtml(const std::string &text);
//! Bytes as a `data:` URI. \param mime : "image/svg+xml", "image/png", "image/jpeg", "video/mp4".
[[nodiscard]] std::string dataUri(const std::string &mime, const std::string &bytes);

//! \brief One cell of a table.
struct HtmlCell {
  HtmlCell(std::string cellText = "", std::string cellStyle = "", unsigned int cellSpan = 1)
    : text(std::move(cellText)), style(std::move(cellStyle)), span(cellSpan)
  {}
  std::string text;      //!< Plain text, escaped when written.
  std::string style;     //!< Style names: "best", "worst", "left", "start" (left border), or none.
  unsigned int span = 1; //!< Number of columns covered.
  std::string hint;      //!< Tooltip of the cell.
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

  //! Begin a section, listed in the table of contents.
  void section(const std::string &title);
  void paragraph(const std::string &text);
  //! A highlighted paragraph: the main result.
  void highlight(const std::vector<std::string> &sentences);
  void list(const std::vector<std::string> &items);
  void table(const HtmlTable &table, const std::string &caption);
  //! Two columns: name, value.
  void facts(const std::vector<std::pair<std::string, std::string>> &facts, const std::string &caption);
  //! A figure with its caption. \param uri : See dataUri(). \param alt : Alternative text.
  void picture(const std::string &uri, const std::string &alt, const std::string &caption);
  //! \brief One of several videos side by side.
  struct Video {
    std::string uri;     //!< See dataUri().
    std::string caption; //!< Below the video.
  };
  void videos(const std::vector<Video> &videos);
  //! Everything until endDetails() is collapsed under \e summary.
  void beginDetails(const std::string &summary);
  void endDetails();
  //! Raw markup.
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
