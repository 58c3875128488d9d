#pragma once

#include <string>
#include <vector>

namespace shelfbeam::bench {

/// What it takes to prove that one unit fewer than the least is not enough: with all candidates, with every
/// second one and every fourth one of their grid, and with all of them if the search knew that mirror images
/// of what it has ruled out need no search.
void print_symmetry(const std::vector<std::string>& files, const std::vector<double>& scales, double limit);

}  // namespace shelfbeam::bench
