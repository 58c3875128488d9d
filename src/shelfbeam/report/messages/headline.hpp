#pragma once

#include <string>
#include <vector>

#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

/// The answer in plain words, as the page begins with it (not yet escaped for HTML).
struct Headline {
  enum class Tone { yes, open, no };

  Tone tone = Tone::open;
  std::string answer;                ///< one sentence
  std::vector<std::string> remarks;  ///< what it rests on, a sentence or two each
};

Headline headline(const ReportData& data);

}  // namespace shelfbeam
