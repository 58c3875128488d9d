#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace shelfbeam::app {

/// Prints rows with columns as wide as they need, the first `left` of them left-aligned, the others right.
/// The first row is the heading.
void print_table(const std::vector<std::vector<std::string>>& rows, std::size_t left);

}  // namespace shelfbeam::app
