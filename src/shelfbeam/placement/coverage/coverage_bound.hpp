#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/kernels/coverage_kernels.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

enum class CoverageAim {
  lowest,  ///< every decrease of the bound helps
  reached  ///< only a bound at or below a given weight does
};

/// Proven upper bounds on the weight of the labels that at most k units, installed units included, can reach.
/// Every reached label satisfies sum_j b_ijd T_j >= 1 for several lifted rows d (docs/methods/placement.md,
/// "Max coverage"), or label i is missed at the price w_i. For any multipliers, the dual bound
/// (dual_bound.hpp) of these rows is a lower bound on the missed weight. Good multipliers come from the
/// relaxation
///
///   max_T sum_i w_i min(1, min_d sum_j b_ijd T_j),   0 <= T_j <= 1,   sum_j T_j <= k:
///
/// mirror ascent with entropy (Beck and Teboulle, Oper. Res. Lett. 31, 2003) takes steps in T, and y is the
/// weighted mean of the rows that are the minima on the way. Results do not depend on the number of threads.
class CoverageBound {
 public:
  /// For selections of at most `max_units` units, at least the number installed.
  CoverageBound(const detail::Instance& instance, const detail::LabelWeights& weights, std::size_t max_units);

  /// Upper bound on the weight that `units` <= max_units can reach; does not decrease with `units`.
  double weight(std::size_t units) const;

  /// Takes steps for `units`, starting from the T of the last ones. Ends when the effort is over, early if
  /// the bound falls to `reached` or the relaxation has no bound that serves the aim better. Returns the
  /// number of steps.
  std::size_t improve(std::size_t units, double reached, CoverageAim aim, const detail::Effort& effort,
                      const RunControl& control);

  /// Matrix entries that one step examines.
  std::size_t entries() const { return column_.size(); }

 private:
  struct Steps;
  /// Of the lifted rows of a label.
  using Multipliers = std::array<float, detail::CoverageKernels::lifted_rows>;

  /// The rows that one task sums.
  struct Part {
    std::size_t first = 0, last = 0;
  };
  /// Its sums, and buffers for the entries of a row, padded.
  struct PartSums {
    double total = 0;
    std::vector<double> by_column;
    std::vector<float> chosen, lifted;
  };

  std::size_t rows() const { return label_.size(); }
  template <class Body>
  double sum_over_parts(std::vector<double>& by_column, const Body& body) const;
  void evaluate(std::size_t units, std::span<const Multipliers> y);
  double relax(std::size_t units, float share_of_step, std::vector<Multipliers>& y,
               std::vector<double>& slope) const;
  void keep_to(std::size_t units);

  const detail::Instance& instance_;
  const detail::LabelWeights& weights_;
  double reachable_ = 0;        ///< weight of the labels that some selection reaches
  std::vector<LabelId> label_;  ///< of a row
  std::size_t lifted_rows_ = detail::CoverageKernels::lifted_rows;  ///< only the first without sums
  std::vector<std::size_t> row_begin_ = {0};  ///< of the labels that can be reached and weigh anything
  std::size_t max_row_ = 0;
  std::vector<std::uint32_t> column_;  ///< of an entry
  std::vector<float> share_;           ///< a_ij; padded
  std::vector<double> weight_;         ///< w_i
  std::vector<double> min_share_sum_;  ///< b_i of CoverRows for the present number of units
  std::vector<Part> parts_;
  std::vector<float> chosen_;      ///< T_j
  std::vector<double> best_;       ///< per number of units
  bool has_plain_bounds_ = false;  ///< with all multipliers 1
};

}  // namespace shelfbeam
