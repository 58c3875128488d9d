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

Headline headline(const ReportData& data);

}  // namespace shelfbeam
