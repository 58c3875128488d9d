#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// How signals of several transceivers act on one label (3.2).
enum class CommunicationModel {
  cooperative,     ///< they add up (3.5), (3.6)
  non_cooperative  ///< one of them alone must reach it (3.1), (3.2)
};

/// What is minimised beside the number (or cost) of transceivers.
enum class Objective {
  count,  ///< nothing
  links,  ///< non-cooperative: sum c_i^E l_ij T_j (3.3); cooperative: sum c_i^E t_ij, t_ij = T_j (3.13)
  effective_links,  ///< sum c_i^E [M_ij >= s gamma_i tau_i] T_j
  signal            ///< sum delta_i M_ij T_j (3.10, 3.14)
};

/// How an objective is spoken of.
struct ObjectiveWords {
  Objective value;
  std::string_view name;               ///< on the command line and in files
  std::string_view help;               ///< what it adds up
  std::string_view sum;                ///< "the least sum over links"
  std::string_view fewest = "fewest";  ///< "fewest transceivers, then fewest links"
  bool has_share = false;              ///< whether Question::share plays a part
};
inline constexpr std::array objective_words = {
    ObjectiveWords{Objective::count, "count", "nothing", "transceivers"},
    ObjectiveWords{Objective::links, "links", "links at their costs", "links"},
    ObjectiveWords{Objective::effective_links, "effective-links",
                   "links that carry a share of the requirement alone", "effective links", "fewest", true},
    ObjectiveWords{Objective::signal, "signal", "signals at their costs", "signal", "least"}};

/// Precondition: the table holds it.
constexpr const ObjectiveWords& words_of(Objective objective) {
  std::size_t k = 0;
  while (objective_words[k].value != objective) ++k;
  return objective_words[k];
}

enum class Combination {
  lexicographic,  ///< fewest transceivers first, then the objective among those (3.4)
  weighted        ///< sum c_j^T T_j plus the objective, in one sum (3.3), (3.10), (3.14)
};

/// A label is met when S >= gamma tau (1 - met_tolerance): the same rule everywhere, for reach too.
inline constexpr double met_tolerance = 1e-9;

inline bool is_met(double signal, double requirement) {
  return signal >= requirement * (1 - met_tolerance);
}

/// The question that a placement answers.
struct Question {
  CommunicationModel model = CommunicationModel::cooperative;
  Objective objective = Objective::count;
  Combination combination = Combination::lexicographic;
  double share = 1;        ///< s of effective links
  bool redundant = false;  ///< every label stays met when any one chosen unit fails, installed ones included
};

/// gamma tau as the question's model tests it: for one unit alone where units do not cooperate.
inline double requirement_of(const SignalTable::Label& label, CommunicationModel model) {
  return model == CommunicationModel::cooperative ? label.requirement : label.single_requirement;
}

/// What a label receives from the chosen columns as the question counts it: S_i (3.5), or the largest single
/// signal; of a redundant question what remains when the unit with the largest signal fails, which is the
/// worst that one failure does. The only place that knows this rule. Summed in the order of the row, so that
/// everybody agrees to the last bit on what is met; more chosen columns never give less, rounding included.
double received_signal(std::span<const SignalEntry> row, const std::vector<bool>& chosen,
                       const Question& question);
double received_signal(const SignalTable& table, std::size_t label, const std::vector<bool>& chosen,
                       const Question& question);

/// Throws InputError for a label without a positive requirement and for a share that is not positive.
void check_question(const SignalTable& table, const Question& question);

/// c^E (links) or delta (signal) of every label. Where no label has a positive one, every link and signal
/// counts 1: a question about links is never empty because nobody priced them.
struct LabelCosts {
  std::vector<double> cost;  ///< per label; zeros for Objective::count
  bool unit = false;         ///< the ones were put in because no costs were given
};
LabelCosts label_costs(const SignalTable& table, Objective objective);

/// The coefficient of every T_j in the question's second objective, from the unclipped matrix; the variables
/// t_ij = T_j of (3.11) are eliminated, so a link costs its transceiver sum_i c_i^E. Zeros for count.
std::vector<double> objective_coefficients(const SignalTable& table, const Question& question);

}  // namespace shelfbeam
