#include "shelfbeam/report/chart/svg.hpp"

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

std::string coordinate(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string path_through(std::span<const Point> points, bool is_open) {
  std::string data;
  for (const Point& p : points)
    data += fmt::format("{}{} {}", data.empty() ? "M" : "L", coordinate(p.x), coordinate(p.y));
  return is_open ? data : data + "Z";
}

void SvgCanvas::close_element(std::string_view name, std::string_view title) {
  if (title.empty())
    body_ += "/>\n";
  else
    body_ += fmt::format("><title>{}</title></{}>\n", escape(title), name);
}

void SvgCanvas::rect(const Point& corner, double width, double height, std::string_view css_class,
                     std::string_view title) {
  body_ +=
      fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"{}\"", coordinate(corner.x),
                  coordinate(corner.y), coordinate(width), coordinate(height), css_class);
  close_element("rect", title);
}

void SvgCanvas::line(const Point& from, const Point& to, std::string_view css_class) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" class=\"{}\"/>\n", coordinate(from.x),
                       coordinate(from.y), coordinate(to.x), coordinate(to.y), css_class);
}

void SvgCanvas::polygon(std::span<const Point> points, std::string_view css_class, std::string_view title) {
  path(path_through(points), css_class, title);
}

void SvgCanvas::path(std::string_view data, std::string_view css_class, std::string_view title) {
  body_ += fmt::format("<path d=\"{}\" class=\"{}\"", data, css_class);
  close_element("path", title);
}

void SvgCanvas::text(const Point& at, std::string_view text, std::string_view css_class, double turn_deg) {
  const std::string x = coordinate(at.x), y = coordinate(at.y);
  const std::string turn =
      turn_deg == 0 ? "" : fmt::format(" transform=\"rotate({} {} {})\"", coordinate(turn_deg), x, y);
  body_ +=
      fmt::format("<text x=\"{}\" y=\"{}\" class=\"{}\"{}>{}</text>\n", x, y, css_class, turn, escape(text));
}

void SvgCanvas::use(std::string_view symbol, const Point& at, std::string_view title) {
  body_ += fmt::format("<use href=\"#{}\" x=\"{}\" y=\"{}\"", symbol, coordinate(at.x), coordinate(at.y));
  close_element("use", title);
}

std::string inline_svg(double width, double height, std::string_view css_class, std::string_view description,
                       std::string_view body) {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" class=\"{}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
                     coordinate(width), coordinate(height), css_class, escape(description), body);
}

std::string legend_item(std::string_view symbol, std::string_view text) {
  return fmt::format(
      "<li><svg class=\"key\" viewBox=\"-14 -14 28 28\" aria-hidden=\"true\"><use "
      "href=\"#{}\"/></svg>{}</li>",
      symbol, escape(text));
}

}  // namespace shelfbeam
