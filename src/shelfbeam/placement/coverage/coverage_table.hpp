#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam::detail {

/// A max coverage problem without its settled parts: the labels that further units decide, the candidates
/// that can help them, and their signals in single precision by candidate.
///
/// A signal is M_ij / (gamma_i tau_i), at most 1; in the non-cooperative model it is 1 or 0. A label is
/// reached only if the signals of the chosen units, without the largest if `omits_best`, add up to `target`.
/// In the cooperative model, `target` is lower than the rule by more than the rounding errors, so that
/// `weight` has to confirm a selection.
class CoverageTable {
 public:
  CoverageTable(const Instance& instance, const LabelWeights& weights);

  std::span<const ColumnId> installed() const { return instance_.installed; }  ///< columns
  std::span<const ColumnId> candidates() const { return candidates_; }         ///< columns
  bool exclude_each_other(std::uint32_t candidate, std::uint32_t other) const;
  /// The mounting point of a candidate; candidates of one point have equal numbers.
  std::uint32_t point(std::uint32_t candidate) const {
    return instance_.mounts.first_option(candidates_[candidate]);
  }

  std::size_t labels() const { return rows_.size(); }
  std::span<const LabelId> rows() const { return rows_; }  ///< the labels of the table
  /// Weight that the installed units reach without the labels of this table.
  double settled_weight() const { return settled_; }
  double label_weight(std::size_t label) const { return weights_[rows_[label]]; }

  /// The weight of all labels that a selection of columns reaches, by the exact rule. Precondition:
  /// ascending.
  double weight(std::span<const ColumnId> selected) const;
  /// The same for the installed units and one candidate at a time, for all candidates.
  std::vector<double> weights_with_one() const;

  bool omits_best() const { return omits_best_; }
  float target() const { return target_; }
  /// Entries of the dense matrix.
  std::size_t cells() const { return padded_ * candidates_.size(); }
  std::size_t padded_labels() const { return padded_; }
  /// Fills the matrix that `signals` and `installed_signals` return.
  void fill();
  const float* signals(std::uint32_t candidate) const { return matrix_.data() + candidate * padded_; }
  const float* installed_signals(std::size_t unit) const {
    return signals(static_cast<std::uint32_t>(candidates_.size() + unit));
  }

 private:
  const Instance& instance_;
  const LabelWeights& weights_;
  Selection candidates_;
  std::vector<LabelId> rows_;
  double settled_ = 0;
  bool omits_best_ = false;
  float target_ = 1;
  std::size_t padded_ = 0;
  std::vector<float> matrix_;
};

}  // namespace shelfbeam::detail
