#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam::detail {

/// A placement problem, made once: the table, the rules, and all that the methods derive from them. The
/// methods ask its structure, not the name of the question.
struct Instance {
  /// The table must outlive the object.
  Instance(const SignalTable& table, const PlacementProblem& problem);
  Instance(const Instance&) = delete;

  const SignalTable& table;
  PlacementProblem problem;
  Mounts mounts;
  Selection installed;
  std::vector<bool> available;  ///< per column: neither installed nor in conflict with an installed unit
  std::vector<std::vector<ColumnId>> excludes;  ///< per column: the columns in conflict with it
  /// Per column: objective_coefficients, the second objective if lexicographic.
  std::vector<double> second_cost;
  std::vector<double> first_cost;    ///< per column: 1 if lexicographic, otherwise first_objective
  CostBounds bounds, second_bounds;  ///< of first_cost and of second_cost
  /// Per column: `second_cost` if lexicographic, `first_cost` if weighted, as a multiple of `cost_unit`, a
  /// power of two for which all columns together cost at most 2^60. Sums of integers do not depend on their
  /// order; they are exact unless costs differ by some fifteen digits. The rounding error is at most half of
  /// `cost_unit`.
  std::vector<std::int64_t> cost;
  double cost_unit = 1;
  bool has_costs = false;  ///< some cost is not zero

  std::size_t rows() const { return table.rows(); }
  std::size_t columns() const { return table.columns(); }
  std::span<const SignalEntry> row(std::size_t label) const { return table.row(label); }
  bool is_installed(ColumnId column) const { return table.transceivers[column].installed; }
  /// gamma_i tau_i.
  double requirement(std::size_t label) const { return requirement_of(table.labels[label], problem.model); }
  /// S_i.
  double received(std::size_t label, const std::vector<bool>& chosen) const {
    return received_signal(row(label), chosen, problem);
  }
  bool is_reached(std::size_t label, const std::vector<bool>& chosen) const {
    return is_met(received(label, chosen), requirement(label));
  }
  Check check(std::span<const ColumnId> selected) const { return check_selection(table, problem, selected); }

  /// The first objective, the count (lexicographic) or the whole sum (weighted); infinite if the selection is
  /// not feasible.
  double value_of(std::span<const ColumnId> selected) const;
  /// The second objective (lexicographic), or the whole sum (weighted).
  double second_value_of(std::span<const ColumnId> selected) const;
  /// Lower bound on the count without a search: the installed units, one more if they miss a label, and at
  /// least two if a unit may fail.
  std::size_t trivial_count_bound() const;

  // Structure, recognised when the instance is made.

  /// Signals add up, but each that is not zero reaches its label alone, as in 0/1 matrices
  /// (is_cover_of_sums).
  bool has_covers_of_sums = false;
  /// At least 90 % of the candidates have one price, so that few units and a low spend go together.
  bool has_one_price = false;
  bool is_cooperative() const { return problem.model == CommunicationModel::cooperative; }
  /// Every label requires one unit that reaches it alone, so that `reduce_cover` applies.
  bool is_cover() const { return !is_cooperative() && !problem.redundant; }
  /// The sum of prices and objective is minimised.
  bool is_weighted() const { return problem.combination == Combination::weighted; }
  /// Some unit may be exchanged for another candidate.
  bool can_exchange(std::span<const ColumnId> selected) const;

  std::int64_t cost_of(std::span<const ColumnId> selected) const {
    std::int64_t sum = 0;
    for (const ColumnId j : selected) sum += cost[j];
    return sum;
  }
  /// Whether the ids of the first of two selections of equal size come first in order.
  bool is_first_by_id(std::span<const ColumnId> a, std::span<const ColumnId> b) const;
};

}  // namespace shelfbeam::detail
