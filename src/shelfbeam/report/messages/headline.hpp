#pragma once

#include <string>
#include <vector>

#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

/// The first lines of the page, as plain text that is not yet escaped for HTML.
struct Headline {
  enum class Tone { yes, open, no };

  Tone tone = Tone::open;
  std::string answer;                ///< one sentence
  std::vector<std::string> remarks;  ///< one or two sentences each
};

/// "yes", "open", "no": in keys of the catalogue and as a CSS class.
constexpr const char* key_of(Headline::Tone tone) {
  constexpr const char* keys[] = {"yes", "open", "no"};
  return keys[static_cast<std::size_t>(tone)];
}

Headline headline(const ReportData& data);

}  // namespace shelfbeam
