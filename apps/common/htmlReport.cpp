/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "htmlReport.h"

#include "vpPrintable.h"

namespace vpApp
{
namespace
{
constexpr const char *STYLE = R"css(
body { font: 16px/1.5 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; color: #1c1c1c; background: #fff;
  max-width: 1180px; margin: 2em auto; padding: 0 1.2em; }
h1 { font-size: 1.7em; line-height: 1.2; margin-bottom: .2em; }
h2 { font-size: 1.25em; margin: 2.2em 0 .5em; padding-bottom: .2em; border-bottom: 2px solid #d8dee6; }
p, li { max-width: 62em; }
.lead { color: #555; margin-top: 0; }
.answer { background: #eef4fb; border-left: 5px solid #2b6cb0; padding: .6em 1em; margin: 1em 0; }
.answer p { margin: .35em 0; }
nav { font-size: .92em; margin: .6em 0 1em; } nav a { margin-right: 1.1em; }
a { color: #2b6cb0; }
figure { margin: 1.4em 0; } figure img { width: 100%; height: auto; border: 1px solid #e3e7ec; }
figcaption, .caption { font-size: .9em; color: #444; max-width: 68em; margin-top: .4em; }
.scroll { overflow-x: auto; margin-top: 1em; }
table { border-collapse: collapse; font-size: .8em; font-variant-numeric: tabular-nums; }
th, td { padding: .28em .42em; text-align: right; white-space: nowrap; }
th { background: #f2f4f7; font-weight: 600; } thead th { border-bottom: 1px solid #b9c2cc; text-align: center; }
td { border-bottom: 1px solid #e7eaee; }
.left { text-align: left; } .start { border-left: 1px solid #b9c2cc; }
.wrap { white-space: normal; min-width: 16em; }
.group td { background: #fafbfc; font-weight: 600; text-align: left; padding-top: .8em; }
.best { background: #d9f0dd; } .best::after { content: " \25B2"; color: #1b7a34; }
.worst { background: #fbe0dd; } .worst::after { content: " \25BC"; color: #b3261e; }
.videos { display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); gap: 1em; }
.videos figure { margin: 0; } .videos video { width: 100%; background: #000; }
details { margin: 1em 0; } summary { cursor: pointer; color: #2b6cb0; }
@media print { .videos, nav { display: none; } }
)css";

std::string cellHtml(const HtmlCell &cell, const char *tag)
{
  std::string html = std::string("<") + tag;
  if (!cell.style.empty()) {
    html += " class=\"" + escapeHtml(cell.style) + "\"";
  }
  if (cell.span != 1) {
    html += " colspan=\"" + std::to_string(cell.span) + "\"";
  }
  if (!cell.hint.empty()) {
    html += " title=\"" + escapeHtml(cell.hint) + "\"";
  }
  return html + ">" + escapeHtml(cell.text) + "</" + tag + ">";
}

unsigned int widthOf(const HtmlTable &table)
{
  unsigned int width = 0;
  for (const std::vector<HtmlTable::Row> *part : {&table.header, &table.rows}) {
    for (const HtmlTable::Row &row : *part) {
      unsigned int columns = 0;
      for (const HtmlCell &cell : row) {
        columns += cell.span;
      }
      width = std::max(width, columns);
    }
  }
  return width;
}

std::string paragraphs(const std::vector<std::string> &texts, const char *tag)
{
  std::string html;
  for (const std::string &text : texts) {
    html += std::string("<") + tag + ">" + escapeHtml(text) + "</" + tag + ">\n";
  }
  return html;
}
} // namespace

std::string escapeHtml(const std::string &text)
{
  std::string html;
  html.reserve(text.size());
  for (const char c : vpEscapeUnprintable(text, "\n\t")) {
    switch (c) {
    case '&':
      html += "&amp;";
      break;
    case '<':
      html += "&lt;";
      break;
    case '>':
      html += "&gt;";
      break;
    case '"':
      html += "&quot;";
      break;
    case '\'':
      html += "&#39;";
      break;
    default:
      html += c;
    }
  }
  return html;
}

std::string dataUri(const std::string &mime, const std::string &bytes)
{
  static constexpr char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = "data:" + mime + ";base64,";
  uri.reserve(uri.size() + 4 * ((bytes.size() + 2) / 3));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const auto byte = [&](std::size_t k) {
      return k < left ? static_cast<unsigned int>(static_cast<unsigned char>(bytes[i + k])) : 0u;
    };
    const unsigned int triple = (byte(0) << 16) | (byte(1) << 8) | byte(2);
    uri += DIGITS[triple >> 18];
    uri += DIGITS[(triple >> 12) & 63];
    uri += left > 1 ? DIGITS[(triple >> 6) & 63] : '=';
    uri += left > 2 ? DIGITS[triple & 63] : '=';
  }
  return uri;
}

HtmlReport::HtmlReport(std::string title, std::string lead) : m_title(std::move(title)), m_lead(std::move(lead)) {}

void HtmlReport::section(const std::string &title)
{
  m_sections.push_back(title);
  m_body += "<h2 id=\"s" + std::to_string(m_sections.size()) + "\">" + escapeHtml(title) + "</h2>\n";
}

void HtmlReport::paragraph(const std::string &text) { m_body += paragraphs({text}, "p"); }

void HtmlReport::highlight(const std::vector<std::string> &sentences)
{
  m_body += "<div class=\"answer\">\n" + paragraphs(sentences, "p") + "</div>\n";
}

void HtmlReport::list(const std::vector<std::string> &items)
{
  m_body += "<ul>\n" + paragraphs(items, "li") + "</ul>\n";
}

void HtmlReport::table(const HtmlTable &table, const std::string &caption)
{
  const std::string width = std::to_string(widthOf(table));
  m_body += "<div class=\"scroll\"><table>\n<thead>\n";
  for (const HtmlTable::Row &row : table.header) {
    m_body += "<tr>";
    for (const HtmlCell &cell : row) {
      m_body += cellHtml(cell, "th");
    }
    m_body += "</tr>\n";
  }
  m_body += "</thead>\n<tbody>\n";
  for (const HtmlTable::Row &row : table.rows) {
    if (row.size() == 1) {
      m_body += "<tr class=\"group\"><td colspan=\"" + width + "\">" + escapeHtml(row[0].text) + "</td></tr>\n";
      continue;
    }
    m_body += "<tr>";
    for (const HtmlCell &cell : row) {
      m_body += cellHtml(cell, "td");
    }
    m_body += "</tr>\n";
  }
  m_body += "</tbody>\n</table></div>\n<p class=\"caption\">" + escapeHtml(caption) + "</p>\n";
}

void HtmlReport::facts(const std::vector<std::pair<std::string, std::string>> &facts, const std::string &caption)
{
  HtmlTable twoColumns;
  for (const auto &fact : facts) {
    twoColumns.rows.push_back({HtmlCell(fact.first, "left"), HtmlCell(fact.second, "left wrap")});
  }
  table(twoColumns, caption);
}

void HtmlReport::picture(const std::string &uri, const std::string &alt, const std::string &caption)
{
  m_body += "<figure><img src=\"" + uri + "\" alt=\"" + escapeHtml(alt) + "\">\n<figcaption>" + escapeHtml(caption) +
            "</figcaption></figure>\n";
}

void HtmlReport::videos(const std::vector<Video> &videos)
{
  m_body += "<div class=\"videos\">\n";
  for (const Video &video : videos) {
    m_body += "<figure><video controls muted loop playsinline preload=\"auto\" src=\"" + video.uri +
              "\"></video>\n<figcaption>" + escapeHtml(video.caption) + "</figcaption></figure>\n";
  }
  m_body += "</div>\n";
}

void HtmlReport::beginDetails(const std::string &summary)
{
  m_body += "<details><summary>" + escapeHtml(summary) + "</summary>\n";
}

void HtmlReport::endDetails() { m_body += "</details>\n"; }

void HtmlReport::raw(const std::string &html) { m_body += html; }

std::string HtmlReport::html() const
{
  std::string contents;
  for (std::size_t i = 0; i < m_sections.size(); ++i) {
    contents += "<a href=\"#s" + std::to_string(i + 1) + "\">" + escapeHtml(m_sections[i]) + "</a>\n";
  }
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escapeHtml(m_title) + "</title>\n<style>" + STYLE + "</style>\n</head>\n<body>\n<h1>" + escapeHtml(m_title) +
         "</h1>\n<p class=\"lead\">" + escapeHtml(m_lead) + "</p>\n<nav>\n" + contents + "</nav>\n" + m_body +
         "</body>\n</html>\n";
}
} // namespace vpApp
