#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/kernels/search_kernels.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// M_ij / (gamma_i tau_i) in single precision, column by column, for some rows of a table. A guide: whoever
/// decides anything by it leaves a margin of `search_tolerance`, or asks the table. Only whether a link alone
/// reaches a label (non-cooperative) is as the rule has it: at 1 or above.
class SearchMatrix {
 public:
  static constexpr std::size_t block = 16;  ///< rows are padded to a multiple, with zeros

  SearchMatrix(const SignalTable& table, CommunicationModel model, std::vector<std::uint32_t> rows);
  /// Of all rows.
  SearchMatrix(const SignalTable& table, CommunicationModel model);

  std::size_t rows() const { return rows_.size(); }
  std::size_t padded_rows() const { return padded_; }
  std::size_t columns() const { return columns_; }
  std::uint32_t row(std::size_t i) const { return rows_[i]; }  ///< of the table
  const float* column(std::size_t j) const { return values_.data() + j * padded_; }

 private:
  std::vector<std::uint32_t> rows_;
  std::size_t padded_ = 0, columns_ = 0;
  std::vector<float> values_;
};

/// What float arithmetic may be off, relatively, in sums over a selection.
inline constexpr double search_tolerance = 2e-5;

Receiving receiving(const Question& question);

/// How well a selection does, by the contract's rule in double precision.
struct Margin {
  double smallest = 0;      ///< of what labels receive over what they require; infinite without labels
  std::uint32_t label = 0;  ///< where that is; where labels are not met, the one that gets least
  bool is_met = true;       ///< every label is met
};

/// `all` holds all rows of the table. `received` is memory to work in.
Margin margin_of(const SignalTable& table, const Question& question, const SearchMatrix& all,
                 std::span<const std::uint32_t> selected, std::vector<float>& received);

/// A question as searches over selections see it: costs as whole numbers, so that sums do not depend on their
/// order and equal costs are equal, and which columns exclude one another.
struct SearchProblem {
  SearchProblem(const SignalTable& table, const Question& question);

  const SignalTable& table;
  const Question& question;
  /// The second objective (lexicographic; zeros for count) or the whole sum (weighted) of a column, in units
  /// of `cost_unit`, a power of two of which all columns together cost 2^60 at most, whatever they are:
  /// whole numbers are exact unless they differ by some fifteen digits. Each is off by half a unit at most.
  std::vector<std::int64_t> cost;
  double cost_unit = 1;
  bool has_costs = false;                            ///< any is not zero
  std::vector<std::vector<std::uint32_t>> excludes;  ///< by column
  std::vector<std::uint32_t> installed;
  std::vector<bool> available;  ///< neither installed nor excluded by what is

  std::vector<std::uint32_t> place_by_id;  ///< of a column among all, in the order of their ids

  /// Of two selections of equal size, each ascending: whether the ids of the first, in order, come before
  /// those of the second, in order.
  bool is_first_by_id(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) const;

  std::int64_t cost_of(std::span<const std::uint32_t> selected) const {
    std::int64_t sum = 0;
    for (const std::uint32_t j : selected) sum += cost[j];
    return sum;
  }
};

}  // namespace shelfbeam::detail
