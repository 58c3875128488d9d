#pragma once

#include <span>
#include <string>
#include <vector>

namespace shelfbeam {

/// Ids in their order, those that follow each other as one range: "A-1", "A-2", "A-3", "B" -> "A-1…3", "B". A
/// range shares all but the number at the end, which grows by one and is written with as many leading zeros.
std::vector<std::string> id_ranges(std::span<const std::string> ids);

}  // namespace shelfbeam
