#pragma once

#include <string>
#include <vector>

#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/messages/headline.hpp"

namespace shelfbeam {

/// The first page for a manager: sentences about the shop, as plain text that is not yet escaped for HTML.
/// Terms of statistics and of optimisation, except the confidence, are left to `headline`.
struct Summary {
  Headline::Tone tone = Headline::Tone::open;
  std::string verdict;                ///< a few words
  std::string answer;                 ///< one sentence
  std::string assumed;                ///< assumed_sentence
  std::vector<std::string> remarks;   ///< price, proof, and whether a second simulation confirms it
  std::vector<std::string> achieves;  ///< coverage and reserve; empty without a selection
  std::vector<std::string> risks;     ///< empty without a selection
};

Summary summary_of(const ReportData& data);

}  // namespace shelfbeam
