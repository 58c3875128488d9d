#pragma once

#include <string>

namespace shelfbeam {

/// The style sheet of pages: light and dark, screen and paper. What is handed in are further CSS variables.
std::string page_style(const std::string& light_colours = {}, const std::string& dark_colours = {});

}  // namespace shelfbeam
