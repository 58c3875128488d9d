#include "shelfbeam/report/page/html.hpp"

#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

// colours.css and page.css, made by cmake/embed.cmake. The planner has the same colours.
namespace embedded {
extern const std::string_view page_colours, page_css;
}  // namespace embedded

namespace {

std::string class_attribute(const HtmlTable::Column& column) {
  const char* const names[] = {"", " class=\"n\"", " class=\"w\"", " class=\"n w\""};
  return names[(column.number ? 1 : 0) + (column.wraps ? 2 : 0)];
}

}  // namespace

void HtmlTable::add_row(const std::vector<std::string>& cells, const std::string& link) {
  rows_ += "<tr>";
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::string text = escape(cells[k]);
    const std::string label = narrow_ == Narrow::cards
                                  ? fmt::format(" data-label=\"{}\"", escape(columns_[k].head))
                                  : std::string();
    rows_ += fmt::format(
        "<td{}{}>{}</td>", label, class_attribute(columns_[k]),
        k == 0 && !link.empty() ? fmt::format("<a href=\"{}\">{}</a>", escape(link), text) : text);
  }
  rows_ += "</tr>\n";
}

std::string HtmlTable::html() const {
  std::string head;
  for (const Column& column : columns_)
    head += fmt::format("<th scope=\"col\"{}>{}</th>", class_attribute(column), escape(column.head));
  return fmt::format(
      "<div class=\"scroll\" "
      "tabindex=\"0\"><table{}>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
      narrow_ == Narrow::cards ? " class=\"cards\"" : "", head, rows_);
}

std::string html_header(const PageHeader& header) {
  std::string html = fmt::format(
      "<header class=\"{}\">\n<p class=\"kicker\">{}</p>\n<h1>{}</h1>\n<p class=\"answer\">{}</p>\n",
      header.tone, header.kicker, escape(header.title), escape(header.answer));
  for (const std::string& remark : header.remarks) html += paragraph(remark, "remark");
  return html + "</header>\n";
}

std::string html_section(const std::string& id, const std::string& heading, const std::string& body) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, escape(heading), body);
}

std::string html_figure(const std::string& title, const std::string& picture, const std::string& note) {
  return fmt::format("<figure><figcaption>{}</figcaption>\n{}{}</figure>\n", escape(title), picture,
                     note.empty() ? "" : paragraph(note, "note"));
}

std::string html_list(const std::vector<std::string>& items) {
  std::string html = "<ul>\n";
  for (const std::string& item : items) html += fmt::format("<li>{}</li>\n", escape(item));
  return html + "</ul>\n";
}

std::string paragraph(const std::string& text, const std::string& css_class) {
  return css_class.empty() ? fmt::format("<p>{}</p>\n", escape(text))
                           : fmt::format("<p class=\"{}\">{}</p>\n", css_class, escape(text));
}

std::string html_page(const Words& words, const std::string& title, const std::string& body,
                      const std::string& light_colours, const std::string& dark_colours) {
  std::string css(embedded::page_colours);
  css += embedded::page_css;
  const auto put = [&](std::string_view mark, const std::string& colours) {
    css.replace(css.find(mark), mark.size(), colours);
  };
  put("/*light*/", light_colours);
  put("/*dark*/", dark_colours);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      escape(words("page.language")), escape(title), css, body);
}

}  // namespace shelfbeam
