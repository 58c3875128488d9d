#pragma once

#include <span>
#include <string>
#include <string_view>

namespace shelfbeam {

/// A point of a drawing in SVG user units, y downwards.
struct Point {
  double x = 0, y = 0;
};

/// A coordinate rounded to a tenth of a user unit, without trailing zeros.
std::string coordinate(double value);

/// The data of a path through these points, back to the first unless it is open.
std::string path_through(std::span<const Point> points, bool is_open = false);

/// Collects SVG elements, styled by CSS classes. Texts are escaped here, class names are not.
class SvgCanvas {
 public:
  void rect(const Point& corner, double width, double height, std::string_view css_class,
            std::string_view title = {});
  void line(const Point& from, const Point& to, std::string_view css_class);
  void polygon(std::span<const Point> points, std::string_view css_class, std::string_view title = {});
  void path(std::string_view data, std::string_view css_class, std::string_view title = {});
  void text(const Point& at, std::string_view text, std::string_view css_class, double turn_deg = 0);
  /// A copy of the symbol with this id, with its origin at `at`; `title` is the tooltip.
  void use(std::string_view symbol, const Point& at, std::string_view title = {});
  void raw(std::string_view markup) { body_ += markup; }

  const std::string& body() const { return body_; }

 private:
  void close_element(std::string_view name, std::string_view title);

  std::string body_;
};

/// An inline <svg> that scales with its box; `description` is for screen readers.
std::string inline_svg(double width, double height, std::string_view css_class, std::string_view description,
                       std::string_view body);

/// <li> of a legend: a symbol of about 28 x 28 units, and plain text.
std::string legend_item(std::string_view symbol, std::string_view text);

}  // namespace shelfbeam
