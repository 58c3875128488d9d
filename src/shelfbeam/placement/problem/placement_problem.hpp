#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// Columns of a table, ascending unless stated otherwise.
using Selection = std::vector<ColumnId>;

/// How the signals of several transceivers act on one label (3.2).
enum class CommunicationModel {
  cooperative,     ///< signals add up (3.5), (3.6)
  non_cooperative  ///< one transceiver alone must reach the label (3.1), (3.2)
};

/// The quantity that is minimised besides the count (or cost) of transceivers.
enum class Objective {
  count,  ///< none
  links,  ///< non-cooperative: sum c_i^E l_ij T_j (3.3); cooperative: sum c_i^E t_ij, t_ij = T_j (3.13)
  effective_links,  ///< sum c_i^E [M_ij >= s gamma_i tau_i] T_j
  signal            ///< sum delta_i M_ij T_j (3.10, 3.14)
};

/// Names of an objective on the command line and in files.
struct ObjectiveWords {
  Objective value;
  std::string_view name;
  std::string_view help;   ///< the summed quantity
  bool has_share = false;  ///< PlacementProblem::share applies
};
inline constexpr std::array objective_words = {
    ObjectiveWords{Objective::count, "count", "none (default)"},
    ObjectiveWords{Objective::links, "links", "cost of all links"},
    ObjectiveWords{Objective::effective_links, "effective-links",
                   "cost of the links with at least a given share of the requirement", true},
    ObjectiveWords{Objective::signal, "signal", "cost of all signals"}};

/// Precondition: `objective_words` contains the objective.
constexpr const ObjectiveWords& words_of(Objective objective) {
  std::size_t k = 0;
  while (objective_words[k].value != objective) ++k;
  return objective_words[k];
}

enum class Combination {
  automatic,      ///< spend or lexicographic, which `resolved` decides from the costs (spend.hpp)
  lexicographic,  ///< minimum count first, then the objective among selections of that count (3.4)
  weighted,       ///< sum c_j^T T_j + objective, one sum (3.3), (3.10), (3.14)
  spend           ///< minimum sum of c_j^T over the units not yet installed, then minimum count
};

/// A label is reached if S >= gamma tau (1 - met_tolerance). Solvers, checker, report and l_ij apply this
/// rule.
inline constexpr double met_tolerance = 1e-9;

inline bool is_met(double signal, double requirement) {
  return signal >= requirement * (1 - met_tolerance);
}

/// A placement problem: the rules and objective for a signal table.
struct PlacementProblem {
  CommunicationModel model = CommunicationModel::cooperative;
  Objective objective = Objective::count;
  Combination combination = Combination::lexicographic;
  double share = 1;        ///< s of effective-links
  bool redundant = false;  ///< labels stay reached if any one chosen or installed unit fails
};

/// The second objective depends on signals, not only on the selection.
constexpr bool depends_on_signals(const PlacementProblem& problem) {
  return problem.objective != Objective::count &&
         !(problem.objective == Objective::links && problem.model == CommunicationModel::cooperative);
}

/// A sum of costs comes first, not the count.
constexpr bool minimises_cost(const PlacementProblem& problem) {
  return problem.combination == Combination::weighted || problem.combination == Combination::spend;
}

/// The minimised cost of a selection is a sum of prices of its units that do not depend on signals.
constexpr bool has_known_prices(const PlacementProblem& problem) {
  return minimises_cost(problem) && !depends_on_signals(problem);
}

/// The part of a unit in the new spend: units that are mounted already are free.
inline double price_to_spend(const SignalTable::Transceiver& unit) {
  return unit.installed && !unit.pinned ? 0 : unit.cost;
}

/// gamma tau: for the sum of signals (cooperative) or for one unit alone (non-cooperative).
inline double requirement_of(const SignalTable::Label& label, CommunicationModel model) {
  return model == CommunicationModel::cooperative ? label.requirement : label.single_requirement;
}

/// S_i, the signal of a label from the chosen columns: sum_j M_ij T_j (3.5) or the largest M_ij with T_j = 1.
/// With unit failure the strongest unit, the worst single failure, is omitted:
///
///   sum_j M_ij T_j - max_j M_ij T_j      or      the second largest M_ij with T_j = 1.
///
/// Only this class implements the rule. Terms are summed in the order of the row, so results are
/// bit-identical everywhere, and a larger selection never has a smaller S_i, rounding included.
class ReceivedSignal {
 public:
  explicit ReceivedSignal(const PlacementProblem& problem)
      : cooperative_(problem.model == CommunicationModel::cooperative), redundant_(problem.redundant) {}

  void add(double signal) {
    // Adding the smaller of the two omits the largest signal without a subtraction that could cancel.
    const double part = redundant_ ? std::min(largest_, signal) : signal;
    largest_ = std::max(largest_, signal);
    value_ = cooperative_ ? value_ + part : std::max(value_, part);
  }
  double value() const { return value_; }

 private:
  bool cooperative_, redundant_;
  double value_ = 0, largest_ = 0;
};

double received_signal(std::span<const SignalEntry> row, const std::vector<bool>& chosen,
                       const PlacementProblem& problem);

/// Throws InputError for a requirement or a share that is not positive and finite.
void check_problem(const SignalTable& table, const PlacementProblem& problem);

/// c^E (links) or delta (signal) of every label. If no label has a positive cost, every link or signal costs
/// 1, so that the objective is never empty.
struct LabelCosts {
  std::vector<double> cost;  ///< per label; zeros for Objective::count
  bool unit = false;         ///< no costs were given, so every cost is 1
};
LabelCosts label_costs(const SignalTable& table, Objective objective);

/// Whether signals add up, but each of them that is not zero reaches its label alone, so that both models
/// have the same feasible selections and costs; for example, if signals are 0 or 1.
bool is_cover_of_sums(const SignalTable& table, const PlacementProblem& problem);

/// The coefficient of every T_j in the second objective, from the unclipped matrix; zeros for count. The
/// variables t_ij = T_j of (3.11) are eliminated, so a cooperative link objective costs sum_i c_i^E per
/// transceiver.
std::vector<double> objective_coefficients(const SignalTable& table, const PlacementProblem& problem);

/// The costs of the first objective: 1 (lexicographic), or the price plus the coefficient in the second
/// objective, `second`.
std::vector<double> first_objective(const SignalTable& table, const PlacementProblem& problem,
                                    std::vector<double> second);

}  // namespace shelfbeam
