#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam {

/// Sums of prices of a selection.
struct Price {
  std::string currency;  ///< empty: not given
  double total = 0;      ///< all units, installed ones included
  double to_spend = 0;   ///< units that are not installed yet
};
Price price_of(const SignalTable& table, std::span<const ColumnId> selected);

/// price_to_spend of every unit.
std::vector<double> prices_to_spend(const SignalTable& table);

/// The table names a currency, or some cost is not 1, so that sums of costs mean something to a user.
bool has_prices(const SignalTable& table);

/// The problem with the combination that `Combination::automatic` stands for: `spend` if the objective is the
/// count and the costs of the candidates (installed units apart) differ, otherwise `lexicographic`.
PlacementProblem resolved(const PlacementProblem& problem, const SignalTable& table);

/// The largest step of which every price is a multiple, for prices in hundredths; 0 if there is none.
double price_step(std::span<const double> prices);

/// Sums of prices that put the new spend first and the number of units second: unit j costs
///
///   w_j = K p_j + 1,   p_j = price / step,
///
/// or K p_j if it is installed, where p_j = 0 unless it is pinned, with K above the number of new units in
/// any selection that costs no more than a known one, so that the order of sums is the order of (spend,
/// units). Prices without a common step are compared to within a millionth of the known spend.
class SpendOrder {
 public:
  /// `known`: the new spend of a selection that reaches all labels; infinite if none is known.
  SpendOrder(const SignalTable& table, double known);

  /// The table with w_j as costs, for problems with Combination::weighted and Objective::count.
  SignalTable priced(SignalTable table) const;
  /// A lower bound on the new spend from a lower bound on the sum of w_j.
  double spend_bound(double bound) const;

 private:
  std::vector<double> price_;
  double step_ = 1;
  bool is_whole_ = true;  ///< prices have a common step
  double max_units_ = 0;  ///< K - 1
};

}  // namespace shelfbeam
