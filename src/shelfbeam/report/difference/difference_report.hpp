#pragma once

#include <string>

#include "shelfbeam/report/messages/difference.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

struct DifferenceReport {
  DifferenceInput input;
  const Scene& after;  ///< of the second plan
  std::string before_name, after_name;
};

/// A self-contained page: the answer, a floor plan with both selections, and the tables of the terminal with
/// more rows.
std::string difference_html(const DifferenceReport& report);

}  // namespace shelfbeam
