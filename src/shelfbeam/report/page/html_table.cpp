#include "shelfbeam/report/page/html_table.hpp"

#include <utility>

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

HtmlTable::HtmlTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

namespace {

std::string class_attribute(const HtmlTable::Column& column) {
  const char* const names[] = {"", " class=\"n\"", " class=\"w\"", " class=\"n w\""};
  return names[(column.number ? 1 : 0) + (column.wraps ? 2 : 0)];
}

}  // namespace

void HtmlTable::add_row(const std::vector<std::string>& cells) {
  rows_ += "<tr>";
  for (std::size_t k = 0; k < cells.size(); ++k)
    rows_ += fmt::format("<td{}>{}</td>", class_attribute(columns_[k]), escape(cells[k]));
  rows_ += "</tr>\n";
}

std::string HtmlTable::html() const {
  std::string head;
  for (const Column& column : columns_)
    head += fmt::format("<th scope=\"col\"{}>{}</th>", class_attribute(column), escape(column.head));
  return fmt::format(
      "<div class=\"scroll\" "
      "tabindex=\"0\"><table>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
      head, rows_);
}

std::string html_section(const std::string& id, const std::string& heading, const std::string& body) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, escape(heading), body);
}

std::string html_figure(const std::string& title, const std::string& picture, const std::string& note) {
  return fmt::format("<figure><figcaption>{}</figcaption>\n{}{}</figure>\n", escape(title), picture,
                     note.empty() ? "" : paragraph(note, "note"));
}

std::string paragraph(const std::string& text, const std::string& css_class) {
  return css_class.empty() ? fmt::format("<p>{}</p>\n", escape(text))
                           : fmt::format("<p class=\"{}\">{}</p>\n", css_class, escape(text));
}

}  // namespace shelfbeam
