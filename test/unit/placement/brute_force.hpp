#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::test {

/// A rule that the enumeration omits, to check that a comparison with it can fail.
enum class Omission {
  nothing,
  last_label,
  installed,
  second_objective,
  tolerance,
  mounts,
  conflicts,
  failure,
  weights
};

/// Solves the paper's models by enumeration, written from the formulas of chapter 3 with dense matrices M, l
/// and t, and without code of the library.
struct BruteForce {
  using Columns = Selection;

  bool feasible = false;
  std::size_t fewest = 0;     ///< minimum count
  double best_at_fewest = 0;  ///< minimum second objective among the selections of that count
  double best_sum = 0;        ///< minimum sum of transceiver costs and second objective
  Columns at_fewest, of_best_sum;

  BruteForce(const SignalTable& table, const PlacementProblem& problem, Omission omission = Omission::nothing)
      : fewest(table.columns() + 1), best_at_fewest(infinite), best_sum(infinite) {
    for_each_answer(table, problem, omission, [&](const Answer& answer) {
      feasible = true;
      const double second = omission == Omission::second_objective ? 0 : answer.second_objective;
      const std::size_t count = answer.columns.size();
      if (answer.price + second < best_sum) {
        best_sum = answer.price + second;
        of_best_sum = answer.columns;
      }
      if (count < fewest || (count == fewest && second < best_at_fewest)) {
        fewest = count;
        best_at_fewest = second;
        at_fewest = answer.columns;
      }
    });
  }

  /// The value that the placement problem minimises.
  double best(const PlacementProblem& problem) const {
    if (problem.combination == Combination::weighted) return best_sum;
    return problem.objective == Objective::count ? static_cast<double>(fewest) : best_at_fewest;
  }

  /// The signal at each label from the selection that gives it most, regardless of other labels. As
  /// documented, conflicts count only if one of the pair is installed.
  static std::vector<double> most(const SignalTable& table, const PlacementProblem& problem) {
    const std::vector<std::vector<double>> signal = dense(table);
    const std::uint32_t installed = installed_in(table);
    Columns columns;
    std::vector<double> result(table.labels.size(), 0.0);
    for (std::uint32_t set = 0; set < (std::uint32_t{1} << table.transceivers.size()); ++set) {
      if ((set & installed) != installed || !one_at_a_point(table, set)) continue;
      bool excluded = false;
      for (const auto& [a, b] : table.conflicts)
        excluded =
            excluded || ((set >> a & set >> b & 1U) != 0 && ((installed >> a | installed >> b) & 1U) != 0);
      if (excluded) continue;
      list(set, columns);
      for (std::size_t i = 0; i < signal.size(); ++i)
        result[i] = std::max(result[i], got(problem, signal[i], columns));
    }
    return result;
  }

  /// The maximum number of labels that selections of at most this many units reach, and the minimum count
  /// that reaches it.
  struct Budget {
    std::size_t reached = 0, units = 0;
  };
  /// For every number of units up to all; nullopt if more are installed.
  static std::vector<std::optional<Budget>> budgets(const SignalTable& table,
                                                    const PlacementProblem& problem) {
    const std::vector<std::vector<double>> signal = dense(table);
    std::vector<std::optional<Budget>> best(table.columns() + 1);
    for_each_allowed(table, Omission::nothing, [&](const Columns& columns) {
      const std::size_t count = columns.size();
      std::size_t reached = 0;
      for (std::size_t i = 0; i < table.rows(); ++i)
        if (got(problem, signal[i], columns) >= requirement(table.labels[i], problem) * (1 - 1e-9)) ++reached;
      for (std::size_t k = count; k < best.size(); ++k)
        if (!best[k] || reached > best[k]->reached || (reached == best[k]->reached && count < best[k]->units))
          best[k] = Budget{reached, count};
    });
    return best;
  }

  /// The maximum weight of the labels that selections of at most this many units reach, and the minimum count
  /// that reaches it.
  struct Weight {
    double reached = 0;
    std::size_t units = 0;
  };
  /// For every number of units up to all; nullopt without a selection.
  static std::vector<std::optional<Weight>> weights(const SignalTable& table, const PlacementProblem& problem,
                                                    Omission omission = Omission::nothing) {
    const std::vector<std::vector<double>> signal = dense(table);
    PlacementProblem rule = problem;
    rule.redundant = problem.redundant && omission != Omission::failure;
    const double tolerance = omission == Omission::tolerance ? 0 : 1e-9;
    std::vector<std::optional<Weight>> best(table.columns() + 1);
    for_each_allowed(table, omission, [&](const Columns& columns) {
      double reached = 0;
      for (std::size_t i = 0; i < table.rows(); ++i)
        if (got(rule, signal[i], columns) >= requirement(table.labels[i], rule) * (1 - tolerance))
          reached += omission == Omission::weights ? 1 : table.labels[i].weight;
      for (std::size_t k = columns.size(); k < best.size(); ++k) {
        const double rounding = best[k] ? 1e-12 * best[k]->reached : 0;
        if (!best[k] || reached > best[k]->reached + rounding ||
            (reached >= best[k]->reached - rounding && columns.size() < best[k]->units))
          best[k] = Weight{reached, columns.size()};
      }
    });
    return best;
  }

  /// A selection that reaches every label.
  struct Answer {
    Columns columns;
    double second_objective = 0, price = 0;
    double margin = 0;  ///< minimum margin over the labels; infinite without labels
  };
  static std::vector<Answer> answers(const SignalTable& table, const PlacementProblem& problem,
                                     Omission omission = Omission::nothing) {
    std::vector<Answer> result;
    for_each_answer(table, problem, omission, [&](const Answer& answer) { result.push_back(answer); });
    return result;
  }

  /// Sorted ids, which break ties.
  static std::vector<std::string> ids(const SignalTable& table, const Columns& columns) {
    std::vector<std::string> result;
    result.reserve(columns.size());
    for (const std::uint32_t j : columns) result.push_back(table.transceivers[j].id);
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  static std::uint32_t installed_in(const SignalTable& table) {
    std::uint32_t installed = 0;
    for (std::size_t j = 0; j < table.transceivers.size(); ++j)
      if (table.transceivers[j].installed) installed |= std::uint32_t{1} << j;
    return installed;
  }

  /// Calls visit(columns) for every selection that breaks no rule, whether or not it reaches all labels.
  template <class Visit>
  static void for_each_allowed(const SignalTable& table, Omission omission, const Visit& visit) {
    const std::uint32_t installed = omission == Omission::installed ? 0 : installed_in(table);
    Columns columns;
    for (std::uint32_t set = 0; set < (std::uint32_t{1} << table.columns()); ++set) {
      if ((set & installed) != installed) continue;
      if (omission != Omission::mounts && !one_at_a_point(table, set)) continue;
      if (omission != Omission::conflicts && !is_free_of_conflicts(table, set)) continue;
      list(set, columns);
      visit(columns);
    }
  }

  static void list(std::uint32_t set, Columns& columns) {
    columns.clear();
    for (; set != 0; set &= set - 1) columns.push_back(static_cast<std::uint32_t>(std::countr_zero(set)));
  }

  template <class Visit>
  static void for_each_answer(const SignalTable& table, const PlacementProblem& problem, Omission omission,
                              const Visit& visit) {
    const std::vector<std::vector<double>> signal = dense(table);
    const double tolerance = omission == Omission::tolerance ? -2e-9 : 1e-9;
    const std::size_t tested = table.rows() - (omission == Omission::last_label && table.rows() > 0 ? 1 : 0);
    Answer answer;
    for_each_allowed(table, omission, [&](const Columns& columns) {
      answer.margin = infinite;
      for (std::size_t i = 0; i < tested; ++i) {
        const double needed = requirement(table.labels[i], problem);
        const double has = received(problem, signal[i], columns, omission);
        if (has < needed * (1 - tolerance)) return;
        answer.margin = std::min(answer.margin, has / needed);
      }
      answer.columns = columns;
      answer.price = 0;
      for (const std::uint32_t j : columns) answer.price += table.transceivers[j].cost;
      answer.second_objective = second_objective(table, problem, signal, columns);
      visit(answer);
    });
  }

  // The signal at a label from a selection, by definition; if one unit may fail, in the worst failure.
  static double got(const PlacementProblem& problem, const std::vector<double>& signal,
                    const Columns& columns) {
    const auto got_without = [&](std::size_t failed) {
      double sum = 0;
      for (const std::uint32_t j : columns)
        if (j != failed)
          sum = problem.model == CommunicationModel::cooperative ? sum + signal[j] : std::max(sum, signal[j]);
      return sum;
    };
    double least = got_without(signal.size());
    if (problem.redundant)
      for (const std::uint32_t failed : columns) least = std::min(least, got_without(failed));
    return least;
  }

  static double requirement(const SignalTable::Label& label, const PlacementProblem& problem) {
    return problem.model == CommunicationModel::cooperative ? label.requirement : label.single_requirement;
  }

  // The sum in the order of the columns, without the largest signal if one unit may fail: exact to the last
  // bit as documented, because the order of sums decides near-ties.
  static double received(const PlacementProblem& problem, const std::vector<double>& signal,
                         const Columns& columns, Omission omission) {
    const bool redundant = problem.redundant && omission != Omission::failure;
    const bool cooperative = problem.model == CommunicationModel::cooperative;
    double result = 0, largest = 0;
    for (const std::uint32_t j : columns) {
      const double counted = redundant ? std::min(largest, signal[j]) : signal[j];
      largest = std::max(largest, signal[j]);
      result = cooperative ? result + counted : std::max(result, counted);
    }
    return result;
  }

  static std::vector<std::vector<double>> dense(const SignalTable& table) {
    std::vector<std::vector<double>> signal(table.labels.size(),
                                            std::vector<double>(table.transceivers.size(), 0.0));
    for (std::size_t i = 0; i < signal.size(); ++i)
      for (std::size_t k = table.row_begin[i]; k < table.row_begin[i + 1]; ++k)
        signal[i][table.entries[k].transceiver] = table.entries[k].signal;
    return signal;
  }

  static bool one_at_a_point(const SignalTable& table, std::uint32_t set) {
    for (const auto& mount : table.mounts) {
      int units = 0;
      for (const std::uint32_t j : mount) units += (set >> j & 1U) != 0 ? 1 : 0;
      if (units > 1) return false;
    }
    return true;
  }

  static bool is_free_of_conflicts(const SignalTable& table, std::uint32_t set) {
    return std::none_of(table.conflicts.begin(), table.conflicts.end(), [&](const auto& pair) {
      return (set >> pair.first & 1U) != 0 && (set >> pair.second & 1U) != 0;
    });
  }

  static double second_objective(const SignalTable& table, const PlacementProblem& problem,
                                 const std::vector<std::vector<double>>& signal, const Columns& columns) {
    if (problem.objective == Objective::count) return 0;
    const bool cooperative = problem.model == CommunicationModel::cooperative;
    bool priced = false;
    for (const auto& label : table.labels)
      priced = priced || (problem.objective == Objective::signal ? label.signal_cost : label.link_cost) > 0;
    double value = 0;
    for (std::size_t i = 0; i < table.labels.size(); ++i) {
      const SignalTable::Label& label = table.labels[i];
      const double given = problem.objective == Objective::signal ? label.signal_cost : label.link_cost;
      const double cost = priced ? given : 1;
      const double needed = requirement(label, problem);
      for (const std::uint32_t j : columns) {
        if (problem.objective == Objective::signal) value += cost * signal[i][j];
        if (problem.objective == Objective::links && (cooperative || signal[i][j] >= needed * (1 - 1e-9)))
          value += cost;
        if (problem.objective == Objective::effective_links &&
            signal[i][j] >= problem.share * needed * (1 - 1e-9))
          value += cost;
      }
    }
    return value;
  }
};

}  // namespace shelfbeam::test
