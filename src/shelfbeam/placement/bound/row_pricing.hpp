#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

/// Finds labels whose rows a fractional selection violates, spread over the shop: labels with the same
/// strongest unit are neighbours, and one of them is enough at a time.
class RowPricing {
 public:
  /// For answers of at most so many units.
  RowPricing(const SignalTable& table, const Question& question, std::size_t most_units);

  /// For every strongest unit the label that could get least, in ascending order.
  std::vector<std::uint32_t> hardest() const;

  struct Violated {
    double by = 0;
    std::uint32_t label = 0;
  };

  /// The labels that `x` violates by more than `tolerance`, the worst of every strongest unit, worst first,
  /// at most so many; `known` (one a label) are left out. One scan of the table on the threads of the present
  /// arena.
  std::vector<Violated> violated(std::span<const double> x, double tolerance, std::size_t most,
                                 const std::vector<bool>& known) const;

 private:
  std::size_t rows_;
  std::size_t columns_;
  CoverRows cover_;
  std::vector<std::uint32_t> strongest_;  ///< per label; columns_ where nothing reaches it
  std::vector<double> total_;             ///< per label: sum_j a_ij
};

}  // namespace shelfbeam::detail
