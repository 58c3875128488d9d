#pragma once

#include <cstddef>
#include <string>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// The question of a selection that need not reach all labels, with the bound of its answer: "At most 6
/// transceivers were asked for; it is proven that no 6 reach more than 885 of the labels with these signals."
/// Empty without such a question.
std::string partial_sentence(const Words& words, const Placement& placement, std::size_t labels);

}  // namespace shelfbeam
