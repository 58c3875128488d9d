#include "random_covers.hpp"

#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "shelfbeam/math/random.hpp"

namespace shelfbeam::bench {

namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t key) : bits_(key) {}
  double uniform() { return to_uniform(next()); }
  std::uint32_t index(std::uint32_t n) { return to_index(next(), n); }

 private:
  std::uint32_t next() { return static_cast<std::uint32_t>(bits_() >> 32); }
  std::mt19937_64 bits_;
};

std::vector<std::uint32_t> random_column(const CoverClass& of, Draw& draw) {
  std::vector<std::uint32_t> rows;
  if (of.density > 0) {
    for (std::uint32_t i = 0; i < of.rows; ++i)
      if (draw.uniform() < of.density) rows.push_back(i);
    if (rows.empty()) rows.push_back(draw.index(of.rows));
    return rows;
  }
  const std::uint32_t length = of.min_length + draw.index(of.max_length - of.min_length + 1);
  while (rows.size() < length) {
    const std::uint32_t i = draw.index(of.rows);
    if (std::find(rows.begin(), rows.end(), i) == rows.end()) rows.push_back(i);
  }
  return rows;
}

}  // namespace

std::vector<CoverClass> dense_classes() {
  std::vector<CoverClass> all;
  for (const auto& [rows, columns] : {std::pair(200U, 1000U), {200U, 2000U}, {300U, 3000U}, {400U, 4000U}})
    for (const double density : {0.02, 0.05})
      all.push_back({fmt::format("{} x {}, {:g} %", rows, columns, 100 * density), rows, columns, density});
  return all;
}

CoverClass wide_class() {
  return {"500 x 60000", 500, 60'000};
}

SignalTable random_cover(const CoverClass& of, std::uint64_t seed) {
  Draw draw(mix_key(seed, std::uint64_t{of.rows} << 32 | of.columns));
  std::vector<std::vector<std::uint32_t>> columns_of(of.rows);
  SignalTable table;
  for (std::uint32_t j = 0; j < of.columns; ++j) {
    table.transceivers.push_back({fmt::format("T{}", j), 1.0 + draw.index(of.max_price)});
    for (const std::uint32_t i : random_column(of, draw)) columns_of[i].push_back(j);
  }
  table.row_begin = {0};
  for (auto& columns : columns_of) {
    while (columns.size() < 2) {
      const std::uint32_t j = draw.index(of.columns);
      if (std::find(columns.begin(), columns.end(), j) == columns.end()) columns.push_back(j);
    }
    std::sort(columns.begin(), columns.end());
    table.labels.push_back({fmt::format("L{}", table.labels.size()), 1, 1});
    for (const std::uint32_t j : columns) table.entries.push_back({j, 1});
    table.row_begin.push_back(table.entries.size());
  }
  return table;
}

}  // namespace shelfbeam::bench
