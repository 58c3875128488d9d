#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
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

/// lower <= sum of these columns <= upper.
template <class Columns>
Row sum_row(const Columns& columns, double lower, double upper, std::string name = {}) {
  Row row{lower, upper, {}, std::move(name)};
  for (const std::uint32_t j : columns) row.entries.push_back({j, 1.0});
  return row;
}

/// A sparse mixed-integer linear model, always minimised.
struct Model {
  std::vector<Column> columns;
  std::vector<Row> rows;
};

/// Both writers preserve numbers exactly. Names are made safe for both formats (letters, digits and
/// underscores, unique, at most 60 characters) and are the same in both. A row with two different bounds
/// becomes two rows; a row without a bound is omitted. Throws InputError if `path` cannot be written.

/// Free-format MPS.
void write_mps(const Model& model, const std::filesystem::path& path);

/// CPLEX LP format.
void write_lp(const Model& model, const std::filesystem::path& path);

}  // namespace shelfbeam::milp
