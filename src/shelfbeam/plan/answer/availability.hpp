#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/base/names.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/plan/answer/end_reason.hpp"

namespace shelfbeam {

/// The requirement on the states of a shop that changes.
enum class AvailabilityRule {
  labels,  ///< every label is reached in at least a share of the states
  shop,    ///< all labels are reached at once in at least a share of the states
  misses   ///< the mean number of missed labels is at most a number
};

template <>
inline constexpr auto names_of<AvailabilityRule> =
    std::to_array<Named<AvailabilityRule>>({{"labels", AvailabilityRule::labels},
                                            {"shop", AvailabilityRule::shop},
                                            {"misses", AvailabilityRule::misses}});

struct AvailabilityGoal {
  AvailabilityRule rule = AvailabilityRule::labels;
  /// labels: replaces the availabilities of the label types; shop: the share; misses: the mean number.
  std::optional<double> value = {};
};

/// A selection in some states of the shop.
struct StateOutcome {
  std::size_t units = 0;
  std::uint32_t states = 0;
  std::vector<std::uint32_t> missed;  ///< of each label: states in which it is missed
  std::uint32_t states_with_miss = 0;

  double availability(std::size_t label) const {
    return states == 0 ? 1 : 1 - static_cast<double>(missed[label]) / states;
  }
  /// The share of the states in which all labels are reached.
  double all_reached() const { return states == 0 ? 1 : 1 - static_cast<double>(states_with_miss) / states; }
  /// Missed labels per state.
  double mean_missed() const {
    double sum = 0;
    for (const std::uint32_t misses : missed) sum += misses;
    return states == 0 ? 0 : sum / states;
  }
  double worst() const {
    return missed.empty() || states == 0
               ? 1
               : 1 - static_cast<double>(*std::max_element(missed.begin(), missed.end())) / states;
  }
  /// Whether a label is reached in a smaller share of the states than required.
  bool is_below(std::size_t label, double required) const {
    constexpr double rounding = 1e-9;
    return availability(label) < required - rounding;
  }
  /// Labels that are reached in fewer states than required.
  std::size_t below(const std::vector<double>& required) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < missed.size(); ++i) count += is_below(i, required[i]) ? 1 : 0;
    return count;
  }
  /// Whether the goal holds in these states.
  bool keeps_to(const AvailabilityGoal& goal, const std::vector<double>& required) const {
    if (goal.rule == AvailabilityRule::shop) return all_reached() >= *goal.value;
    return goal.rule == AvailabilityRule::misses ? mean_missed() <= *goal.value : below(required) == 0;
  }
};

/// The part of a cause in the variance of a label's signal.
struct CauseShare {
  std::string cause;     ///< name of a Cause (scene/states/cause.hpp)
  double share = 0;      ///< of the sum over all causes
  double deviation = 0;  ///< standard deviation of the signal by this cause alone, relative to its mean
};

/// A label that is missed most often, and why.
struct LabelAtRisk {
  LabelId label;
  std::vector<CauseShare> causes;  ///< the largest first
};

/// The effect of one cause alone, in sampled states in which all else is as in the file.
struct CauseAlone {
  std::string cause;  ///< name of a Cause
  /// Labels that the units reach in the shop as the file gives it, and too rarely in these states.
  std::vector<LabelId> taken;
  std::uint32_t states = 0;
  std::size_t units = 0;             ///< found for these states; 0: not examined, or none was found
  double lower_bound = 0;            ///< of their number, proven for these states; 0: not examined
  std::vector<LabelId> unreachable;  ///< labels that all candidates together miss too often
};

/// A label that is missed in every state.
struct LostLabel {
  LabelId label;
  std::vector<std::string> causes;  ///< each of which is enough; empty: several together
};

/// A fresh state in which the answer was examined, for pictures.
struct ShownState {
  std::uint64_t number = 0;
  std::vector<LabelId> missed;  ///< ascending
};

/// One more unit for a mounted installation, the one that helps most in simulated states.
struct Addition {
  std::string id;
  Vec3 position;                ///< m
  StateOutcome without, added;  ///< in the same states, by signals
};

/// Values of the variation that the store file does not give.
struct AssumedVariation {
  std::optional<std::array<double, 2>> stocking = {};  ///< ends of the level of fixtures
  std::optional<double> open_doors = {};               ///< share of the time

  bool operator==(const AssumedVariation&) const = default;
};

/// The result for a shop that changes (docs/methods/changing_shop.md). All numbers of states refer to
/// independent draws of the store's variation, with reflectances at the low ends of their ranges.
struct Availability {
  AvailabilityGoal goal;
  std::vector<double> required;  ///< availability of each label; for AvailabilityRule::labels
  double confidence = 0.99;

  /// Found on the sampled states, by signals.
  StateOutcome nominal;           ///< the plan for the shop as the file gives it
  std::size_t nominal_bound = 0;  ///< fewest units proven for this shop, by signals; 0: none
  StateOutcome sample;  ///< the fewest units, or the smallest spend, that keep to the goal on these states
  std::vector<ColumnId> sample_selected;  ///< ascending columns; empty: none was found
  double sample_value = 0;                ///< count or new spend
  double sample_lower_bound = 0;          ///< of the value, proven for the sampled states
  /// A bound on the value of every selection that keeps to the goal in the long run, with the confidence; 0:
  /// not examined.
  double lower_bound = 0;
  std::vector<LabelId> unreachable;  ///< labels that all candidates together miss too often

  /// Plans that were named before their states were drawn; the last one is the answer. Missed: not certified
  /// to be reached.
  std::vector<StateOutcome> examined;
  /// Some states of the last one, ascending by number, among them one with the most missed labels.
  std::vector<ShownState> shown;
  bool certified = false;            ///< the last one
  std::vector<LabelId> responsible;  ///< labels that prevent it, those with most misses first
  std::vector<LabelAtRisk> at_risk;  ///< most misses first
  /// The causes, each alone, with the plan for the shop as the file gives it, or with the mounted units.
  std::vector<CauseAlone> alone;
  std::size_t missed_as_given = 0;   ///< labels that these units miss in the shop as the file gives it
  std::vector<LostLabel> lost;       ///< by the answer or, if the goal is impossible, by all candidates
  std::optional<Addition> addition;  ///< only of verify_over_states
  double seconds = 0;
  AssumedVariation assumed;
  std::vector<std::string> without;    ///< names of the causes that are left out
  std::optional<EndReason> open = {};  ///< reason for an end before all was decided

  /// No placement keeps to the goal in the sampled states.
  bool is_impossible() const { return !unreachable.empty() || std::isinf(sample_lower_bound); }
  /// The selection for the sampled states is proven to be the best for these.
  bool is_sample_minimum() const { return sample_value <= sample_lower_bound * (1 + 1e-9); }
  bool has_answer() const { return !examined.empty(); }
  const StateOutcome& answer() const { return examined.back(); }
};

}  // namespace shelfbeam
