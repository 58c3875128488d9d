#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shelfbeam::bench {

/// The mean of independent batches, and the variance of this mean from the spread of the batches.
struct BatchMean {
  void add(double value) {
    ++batches;
    const double step = value - mean;
    mean += step / batches;
    squares += step * (value - mean);
  }
  double variance() const { return squares / (batches * (batches - 1)); }

  double batches = 0, mean = 0, squares = 0;
};

/// Sums over batches of a matrix: of its entries, its rows, its columns, and of the whole matrix.
class BatchSums {
 public:
  BatchSums(std::size_t rows, std::size_t columns)
      : entries(rows * columns), by_row(rows), by_column(columns), contributions(rows * columns) {}

  void add(std::span<const double> matrix) {
    const std::size_t n = by_column.size();
    std::vector<double> columns(n);
    double sum = 0;
    for (std::size_t i = 0; i < by_row.size(); ++i) {
      double row = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const double value = matrix[i * n + j];
        entries[i * n + j].add(value);
        columns[j] += value;
        row += value;
      }
      by_row[i].add(row);
      sum += row;
    }
    for (std::size_t j = 0; j < n; ++j) by_column[j].add(columns[j]);
    all.add(sum);
  }

  std::vector<BatchMean> entries, by_row, by_column;
  BatchMean all;
  std::vector<std::uint32_t> contributions;  ///< number of nonzero contributions to each entry
};

}  // namespace shelfbeam::bench
