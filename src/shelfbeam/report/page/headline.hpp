#pragma once

#include <string>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

/// The answer in plain words (not yet escaped for HTML).
struct Headline {
  enum class Tone { yes, open, no };

  Tone tone = Tone::open;
  std::string answer;                ///< one sentence
  std::vector<std::string> remarks;  ///< what it rests on, a sentence or two each
};

Headline headline(const ReportData& data);

/// The least number of units that is proven to be needed: the bound rounded up; 0 where no number suffices.
std::size_t least_count(const Placement& placement);

/// (count - least_count) / count.
double count_gap(const Placement& placement);

std::string model_name(CommunicationModel model);
/// "fewest transceivers, then fewest links"
std::string objective_name(const Question& question);
std::string status_name(Status status);

}  // namespace shelfbeam
