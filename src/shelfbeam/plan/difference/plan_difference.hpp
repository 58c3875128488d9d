#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "shelfbeam/base/names.hpp"
#include "shelfbeam/plan/answer/value_bounds.hpp"
#include "shelfbeam/plan/difference/compared_plan.hpp"
#include "shelfbeam/plan/difference/store_changes.hpp"

namespace shelfbeam {

/// A value in both plans.
template <class T>
struct BeforeAfter {
  T before = {}, after = {};
};

enum class UnitChange {
  kept,     ///< the same position, axis and type, perhaps another id
  changed,  ///< the same id, but another position, axis or type
  added,
  removed
};

template <>
inline constexpr auto names_of<UnitChange> =
    std::to_array<Named<UnitChange>>({{"kept", UnitChange::kept},
                                      {"changed", UnitChange::changed},
                                      {"added", UnitChange::added},
                                      {"removed", UnitChange::removed}});

/// A unit that a plan chose; columns of the plans.
struct ComparedUnit {
  UnitChange change = UnitChange::kept;
  std::optional<std::uint32_t> before, after;
};

/// A label in one plan. It is reached according to its certificate or, if that does not decide it, to its
/// signal; in a shop that changes, if its availability suffices, where labels have a required one.
struct LabelState {
  LabelId row;
  double signal = 0, requirement = 0;       ///< received_signal and gamma tau
  std::optional<double> availability = {};  ///< share of the states
  bool reached = false;
};

enum class LabelChange {
  stays_reached,
  stays_missed,
  gained,  ///< reached by the second plan alone
  lost,    ///< reached by the first plan alone
  added,   ///< only the second shop has it
  removed  ///< only the first shop has it
};

template <>
inline constexpr auto names_of<LabelChange> =
    std::to_array<Named<LabelChange>>({{"stays_reached", LabelChange::stays_reached},
                                       {"stays_missed", LabelChange::stays_missed},
                                       {"gained", LabelChange::gained},
                                       {"lost", LabelChange::lost},
                                       {"added", LabelChange::added},
                                       {"removed", LabelChange::removed}});

/// A label of either shop: the same id or, of the others, the same position and normal.
struct ComparedLabel {
  std::optional<LabelState> before, after;

  LabelChange change() const;
};

enum class CertificateState {
  none,
  certified,  ///< all labels are reached, or a shop that changes keeps to its goal
  open,       ///< some labels are undecided, or the goal is not certified
  missed      ///< some labels are missed
};

template <>
inline constexpr auto names_of<CertificateState> =
    std::to_array<Named<CertificateState>>({{"none", CertificateState::none},
                                            {"certified", CertificateState::certified},
                                            {"open", CertificateState::open},
                                            {"missed", CertificateState::missed}});

/// The number of weakest labels of a plan that are listed.
inline constexpr std::size_t max_weakest = 5;

struct PlanFigures {
  bool has_selection = false;
  std::size_t units = 0, installed = 0;  ///< chosen units, and those of them that are installed already
  std::size_t labels = 0, reached = 0;
  std::optional<Price> price = {};
  ValueBounds bounds = {};  ///< of the count or the minimised cost; in a shop that changes, over its states
  CertificateState certificate = CertificateState::none;
  double confidence = 0;      ///< of the certificate
  std::size_t certified = 0;  ///< labels that it proves to be reached; 0 in a shop that changes
  std::optional<double> worst_availability = {};  ///< in a shop that changes
  std::vector<LabelId> weakest;  ///< rows of at most max_weakest labels, smallest margin first
};

/// A setting of the question that both plans answer. Prices, requirements and pins belong to the store.
enum class QuestionKey {
  model,
  survives_failure,
  objective,
  combination,
  share,
  min_spacing,
  forbidden_pairs,
  partial,  ///< the part of the labels that is asked for (Placement::partial)
  confidence,
  availability_rule,
  availability_goal
};

template <>
inline constexpr auto names_of<QuestionKey> =
    std::to_array<Named<QuestionKey>>({{"model", QuestionKey::model},
                                       {"survives_failure", QuestionKey::survives_failure},
                                       {"objective", QuestionKey::objective},
                                       {"combination", QuestionKey::combination},
                                       {"share", QuestionKey::share},
                                       {"min_spacing", QuestionKey::min_spacing},
                                       {"forbidden_pairs", QuestionKey::forbidden_pairs},
                                       {"partial", QuestionKey::partial},
                                       {"confidence", QuestionKey::confidence},
                                       {"availability_rule", QuestionKey::availability_rule},
                                       {"availability_goal", QuestionKey::availability_goal}});

/// The differences between two plans.
struct PlanDifference {
  BeforeAfter<PlanFigures> figures;
  std::vector<ComparedUnit> units;    ///< in the order of the second plan, then of the first
  std::vector<ComparedLabel> labels;  ///< likewise
  std::vector<QuestionKey> question;  ///< settings that differ
  std::vector<StoreChange> store;

  std::size_t count(UnitChange change) const;
  std::size_t count(LabelChange change) const;
  /// Nothing differs but the seeds and the signals' sampling errors.
  bool is_empty() const;
};

PlanDifference difference_of(const ComparedPlan& before, const ComparedPlan& after);

}  // namespace shelfbeam
