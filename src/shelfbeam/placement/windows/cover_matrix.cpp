#include "shelfbeam/placement/windows/cover_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

namespace {

class RowDivider {
 public:
  explicit RowDivider(const CoverMatrix& cover) : cover_(cover), value_(cover.rows.size()) {}

  void divide(std::vector<std::uint32_t> rows, std::size_t parts) {
    if (parts <= 1 || rows.size() <= 1) {
      std::sort(rows.begin(), rows.end());
      if (!rows.empty()) divided.push_back(std::move(rows));
      return;
    }
    find_eigenvector(rows);
    std::sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(value_[a], a) < std::pair(value_[b], b);
    });
    const std::size_t left = parts / 2;
    double total = 0, sum = 0;
    for (const std::uint32_t i : rows) total += share(i);
    std::size_t k = 0;
    for (; k < rows.size() && sum * static_cast<double>(parts) < total * static_cast<double>(left); ++k)
      sum += share(rows[k]);
    const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(k);
    divide({rows.begin(), middle}, left);
    divide({middle, rows.end()}, parts - left);
  }

  std::vector<std::vector<std::uint32_t>> divided;

 private:
  // The share of a row in the cost of a cover: the smallest share of its columns.
  double share(std::uint32_t i) const {
    double min_share = std::numeric_limits<double>::infinity();
    for (const std::uint32_t j : cover_.rows[i])
      min_share = std::min(min_share, cover_.cost[j] / static_cast<double>(cover_.columns[j].size()));
    return min_share;
  }

  // Power iteration: a row's value becomes the mean of its columns, a column's the mean of its rows; the
  // first eigenvector, a constant, is subtracted.
  void find_eigenvector(const std::vector<std::uint32_t>& rows) {
    constexpr int steps = 300;
    constexpr double golden = 0.6180339887498949;
    std::vector<double> of_column(cover_.columns.size());
    std::vector<int> count(cover_.columns.size(), 0);
    double total = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      value_[rows[k]] = std::fmod(golden * static_cast<double>(k), 1.0) - 0.5;
      total += static_cast<double>(cover_.rows[rows[k]].size());
      for (const std::uint32_t j : cover_.rows[rows[k]]) ++count[j];
    }
    for (int step = 0; step < steps; ++step) {
      double mean = 0, square = 0;
      for (const std::uint32_t i : rows) mean += value_[i] * static_cast<double>(cover_.rows[i].size());
      for (const std::uint32_t i : rows) {
        value_[i] -= mean / total;
        square += value_[i] * value_[i];
      }
      if (!(square > 0)) return;
      std::fill(of_column.begin(), of_column.end(), 0.0);
      for (const std::uint32_t i : rows)
        for (const std::uint32_t j : cover_.rows[i])
          of_column[j] += value_[i] / (std::sqrt(square) * count[j]);
      for (const std::uint32_t i : rows) {
        double sum = 0;
        for (const std::uint32_t j : cover_.rows[i]) sum += of_column[j];
        value_[i] = sum / static_cast<double>(cover_.rows[i].size());
      }
    }
  }

  const CoverMatrix& cover_;
  std::vector<double> value_;
};

}  // namespace

CoverMatrix::CoverMatrix(const SignalTable& table, const PlacementProblem& problem,
                         std::span<const double> costs, const Reduction& reduction) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(table.columns(), none);
  for (const CoverPart& part : reduction.parts)
    for (const std::uint32_t j : part.columns) {
      place[j] = static_cast<std::uint32_t>(column_of.size());
      column_of.push_back(j);
      cost.push_back(costs[j]);
    }
  columns.resize(column_of.size());
  const CoverRows cover(table, problem);
  for (const CoverPart& part : reduction.parts)
    for (const std::uint32_t label : part.labels) {
      const auto i = static_cast<std::uint32_t>(rows.size());
      std::vector<std::uint32_t>& row = rows.emplace_back();
      cover.for_entries(label, [&](std::uint32_t j, double) {
        if (place[j] != none) row.push_back(place[j]);
      });
      std::sort(row.begin(), row.end());
      for (const std::uint32_t j : row) columns[j].push_back(i);
    }
}

std::vector<std::vector<std::uint32_t>> divided_rows(const CoverMatrix& cover, std::size_t parts) {
  RowDivider divider(cover);
  std::vector<std::uint32_t> all(cover.rows.size());
  std::iota(all.begin(), all.end(), 0U);
  divider.divide(std::move(all), parts);
  return std::move(divider.divided);
}

}  // namespace shelfbeam::detail
