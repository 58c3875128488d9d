#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/verdict.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The log of an enumeration: a proof that no selection of some number of units reaches labels of some
/// weight.
///
/// A node has chosen columns (at the root the installed units), a list of columns that may be added, and the
/// number f of units left. Label i lacks r_i; further signals that reach it add up to at least that. `steps`
/// contains the nodes in depth-first order, each as a tag with arguments. With the part o of the lack that
/// shares omit and multipliers y_i between 0 and 1, the values
///
///   v_j = sum_i w_i y_i min(1, max(0, a_ij - o r_i / f) / ((1 - o) r_i))
///
/// bound the weight of every selection below the node: that of the reached labels, sum_i w_i (1 - y_i) of the
/// others, and the f largest v_j of different mounting points. A label is left out if the f strongest signals
/// of all columns do not reach it.
struct CoverageProof {
  enum Tag : std::uint32_t {
    nothing_left,  ///< no units or no columns
    out_of_reach,  ///< labels that can be reached weigh less
    single_fails,  ///< f = 1, and no column of the list suffices
    /// Arguments: bits of o, number of y. The bound is less.
    bound_fails,
    /// Arguments: bits of o, number of y, then columns, each followed by its child, and `end`. Without them,
    /// the bound is less. A child has the columns of the list that were not chosen before it, without those
    /// in conflict with its own and those with which the bound is less.
    branch,
    end = ~std::uint32_t{0}
  };

  std::vector<LabelId> rows;  ///< labels, to which multipliers belong
  std::vector<std::vector<float>> multipliers;
  std::vector<std::uint32_t> steps;
};

/// Writes a proof. Of one that is too long, no steps are kept.
class CoverageLog {
 public:
  void add(std::uint32_t word) {
    if (!is_full(proof_.steps.size())) proof_.steps.push_back(word);
  }
  void add(CoverageProof::Tag tag, float omitted, std::uint32_t multipliers) {
    add(tag);
    add(std::bit_cast<std::uint32_t>(omitted));
    add(multipliers);
  }
  /// Returns the number of the multipliers.
  std::uint32_t add(std::span<const float> y) {
    if (!is_full(y.size() * proof_.multipliers.size())) proof_.multipliers.emplace_back(y.begin(), y.end());
    return static_cast<std::uint32_t>(proof_.multipliers.size() - 1);
  }
  CoverageProof proof(std::span<const LabelId> rows) {
    proof_.rows.assign(rows.begin(), rows.end());
    if (is_full_) proof_.steps.clear();
    return std::move(proof_);
  }

 private:
  bool is_full(std::size_t size) {
    constexpr std::size_t max_size = 10'000'000;
    is_full_ = is_full_ || size >= max_size;
    return is_full_;
  }

  CoverageProof proof_;
  bool is_full_ = false;
};

/// Verifies in double precision, from the table and the problem of `instance` alone, that no selection of at
/// most `units` units, installed ones included, reaches labels of the weight `needed` (in the unit of
/// LabelWeights). Refuted if the proof is malformed, or meets a selection that reaches the weight;
/// unconfirmed if it does not hold for another reason, such as rounding. A step of the effort is a matrix
/// entry.
ProofVerdict judge_coverage(const Instance& instance, const LabelWeights& weights, const CoverageProof& proof,
                            std::size_t units, double needed, const Effort& effort,
                            const RunControl& control);

/// The strength of this claim by the log of an enumeration; `search` if the log has no steps. Nothing if it
/// is refuted.
std::optional<BoundProof> judged(const Instance& instance, const LabelWeights& weights,
                                 const CoverageProof& proof, std::size_t units, double needed,
                                 const Effort& effort, const RunControl& control);

}  // namespace shelfbeam::detail
