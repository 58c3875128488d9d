#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::bench {

/// A class of random weighted covers. Either every entry is 1 with probability `density` (as in the classes 4
/// to D of Beasley, Eur. J. Oper. Res. 31, 1987), or every column reaches `min_length` to `max_length` random
/// rows. Prices are uniform integers from 1 to `max_price`.
struct CoverClass {
  std::string name;
  std::uint32_t rows = 0, columns = 0;
  double density = 0;  ///< 0: columns of the given lengths
  std::uint32_t min_length = 2, max_length = 12;
  std::uint32_t max_price = 100;
};

/// The classes of the comparison with MIP solvers, by name ("200 x 1000, 2 %").
std::vector<CoverClass> dense_classes();

/// Covers of 500 rows by 60,000 columns of 2 to 12 rows.
CoverClass wide_class();

/// A cover of the class, to be solved as a non-cooperative weighted problem. Every column reaches a row, and
/// every row is reached by two columns.
SignalTable random_cover(const CoverClass& of, std::uint64_t seed);

}  // namespace shelfbeam::bench
