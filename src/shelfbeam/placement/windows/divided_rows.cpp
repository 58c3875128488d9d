#include "shelfbeam/placement/windows/divided_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam::detail {

namespace {

class RowDivider {
 public:
  RowDivider(std::span<const milp::Row> rows, std::size_t columns, std::span<const double> mass)
      : rows_(rows), mass_(mass), columns_(columns), degree_(rows.size(), 0.0), value_(rows.size()) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const milp::Entry& entry : rows[i].entries) degree_[i] += entry.value;
  }

  void divide(std::vector<std::uint32_t> part, std::size_t parts) {
    if (parts <= 1 || part.size() <= 1) {
      std::sort(part.begin(), part.end());
      if (!part.empty()) divided.push_back(std::move(part));
      return;
    }
    find_eigenvector(part);
    std::ranges::sort(part, {}, [&](std::uint32_t i) { return std::pair(value_[i], i); });
    const std::size_t left = parts / 2;
    double total = 0, sum = 0;
    for (const std::uint32_t i : part) total += mass_[i];
    std::size_t k = 0;
    for (; k < part.size() && sum * static_cast<double>(parts) < total * static_cast<double>(left); ++k)
      sum += mass_[part[k]];
    const auto middle = part.begin() + static_cast<std::ptrdiff_t>(k);
    divide({part.begin(), middle}, left);
    divide({middle, part.end()}, parts - left);
  }

  std::vector<std::vector<std::uint32_t>> divided;

 private:
  // Power iteration: a row's value becomes the mean of its columns, a column's the mean of its rows; the
  // first eigenvector, a constant, is subtracted.
  void find_eigenvector(const std::vector<std::uint32_t>& part) {
    constexpr int steps = 300;
    constexpr double golden = 0.6180339887498949;
    std::vector<double> of_column(columns_), total_of(columns_, 0.0);
    double total = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      value_[part[k]] = std::fmod(golden * static_cast<double>(k), 1.0) - 0.5;
      total += degree_[part[k]];
      for (const milp::Entry& entry : rows_[part[k]].entries) total_of[entry.column] += entry.value;
    }
    for (int step = 0; step < steps; ++step) {
      double mean = 0, square = 0;
      for (const std::uint32_t i : part) mean += value_[i] * degree_[i];
      for (const std::uint32_t i : part) {
        value_[i] -= mean / total;
        square += value_[i] * value_[i];
      }
      if (!(square > 0)) return;
      std::fill(of_column.begin(), of_column.end(), 0.0);
      for (const std::uint32_t i : part)
        for (const milp::Entry& entry : rows_[i].entries)
          of_column[entry.column] += entry.value * value_[i] / (std::sqrt(square) * total_of[entry.column]);
      for (const std::uint32_t i : part) {
        double sum = 0;
        for (const milp::Entry& entry : rows_[i].entries) sum += entry.value * of_column[entry.column];
        value_[i] = degree_[i] > 0 ? sum / degree_[i] : 0;
      }
    }
  }

  std::span<const milp::Row> rows_;
  std::span<const double> mass_;
  std::size_t columns_;
  std::vector<double> degree_, value_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> divided_rows(std::span<const milp::Row> rows, std::size_t columns,
                                                     std::span<const double> mass, std::size_t parts) {
  RowDivider divider(rows, columns, mass);
  divider.divide(all_numbers(rows.size()), parts);
  return std::move(divider.divided);
}

std::vector<std::vector<std::uint32_t>> divided_rows(const CoverMatrix& cover, std::size_t parts) {
  std::vector<milp::Row> rows(cover.rows.size());
  std::vector<double> mass(rows.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const std::uint32_t j : cover.rows[i]) {
      rows[i].entries.push_back({j, 1.0});
      mass[i] = std::min(mass[i], cover.cost[j] / static_cast<double>(cover.columns[j].size()));
    }
  return divided_rows(rows, cover.columns.size(), mass, parts);
}

}  // namespace shelfbeam::detail
