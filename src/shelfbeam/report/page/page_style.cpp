#include "shelfbeam/report/page/page_style.hpp"

#include <string_view>

namespace shelfbeam {

// page.css, made by cmake/embed.cmake.
namespace embedded {
extern const std::string_view page_css;
}  // namespace embedded

std::string page_style(const std::string& light_colours, const std::string& dark_colours) {
  std::string css(embedded::page_css);
  const auto put = [&](std::string_view mark, const std::string& colours) {
    css.replace(css.find(mark), mark.size(), colours);
  };
  put("/*light*/", light_colours);
  put("/*dark*/", dark_colours);
  return css;
}

}  // namespace shelfbeam
