#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace shelfbeam::milp {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Column {
  double cost = 0;
  double lower = 0;
  double upper = 1;
  bool integer = true;
  std::string name;
};

struct Entry {
  std::uint32_t column = 0;
  double value = 0;
};

/// lower <= sum of entries <= upper; `entries` names each column at most once.
struct Row {
  double lower = -infinity;
  double upper = infinity;
  std::vector<Entry> entries;
  std::string name;
};

/// A plain sparse mixed-integer model, always minimised.
struct Model {
  std::vector<Column> columns;
  std::vector<Row> rows;
};

}  // namespace shelfbeam::milp
