#include "shelfbeam/plan/difference/plan_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/difference/matches.hpp"

namespace shelfbeam {

namespace {

// In units of the tolerance, so that the texts of equal vectors are equal.
std::string rounded(const Vec3& vector) {
  const auto steps = [](double value) { return std::llround(value / position_tolerance); };
  return fmt::format("{} {} {}", steps(vector.x), steps(vector.y), steps(vector.z));
}

bool is_near(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= position_tolerance;
}

std::vector<Identity> unit_identities(const ComparedPlan& plan) {
  std::vector<Identity> identities;
  for (const std::uint32_t column : plan.plan.placement.selected) {
    const TransceiverColumn& unit = plan.transceivers[column];
    identities.push_back(
        {unit.id, fmt::format("{} {} {}", rounded(unit.position), rounded(unit.axis), unit.type)});
  }
  return identities;
}

std::vector<Identity> label_identities(const ComparedPlan& plan) {
  std::vector<Identity> identities;
  identities.reserve(plan.labels.size());
  for (const LabelRow& label : plan.labels)
    identities.push_back({label.id, rounded(label.position) + " " + rounded(label.normal)});
  return identities;
}

std::vector<ComparedUnit> compared_units(const ComparedPlan& before, const ComparedPlan& after) {
  std::vector<ComparedUnit> units;
  for (const auto& [i, j] : matches(unit_identities(before), unit_identities(after), SameBy::value)) {
    ComparedUnit unit;
    if (i) unit.before = before.plan.placement.selected[*i];
    if (j) unit.after = after.plan.placement.selected[*j];
    if (!i || !j) {
      unit.change = i ? UnitChange::removed : UnitChange::added;
    } else {
      const TransceiverColumn &old = before.transceivers[*unit.before],
                              &now = after.transceivers[*unit.after];
      if (!is_near(old.position, now.position) || !is_near(old.axis, now.axis) || old.type != now.type)
        unit.change = UnitChange::changed;
    }
    units.push_back(unit);
  }
  return units;
}

// The required availability of every label; empty where labels have none.
std::span<const double> required_of(const CertifiedPlan& plan) {
  if (!plan.availability || !plan.availability->has_answer()) return {};
  if (plan.availability->goal.rule != AvailabilityRule::labels) return {};
  return plan.availability->required;
}

LabelState state_of(const ComparedPlan& compared, LabelId row) {
  constexpr double rounding = 1e-9;
  const CertifiedPlan& plan = compared.plan;
  LabelState state{row, compared.signals[row], compared.labels[row].requirement};
  state.reached = plan.placement.count() > 0 && is_met(state.signal, state.requirement);
  if (plan.availability && plan.availability->has_answer())
    state.availability = plan.availability->answer().availability(row);
  if (const auto required = required_of(plan); !required.empty())
    state.reached = *state.availability >= required[row] - rounding;
  if (plan.certificate && plan.placement.count() > 0 && is_decided(plan.certificate->labels[row].verdict))
    state.reached = plan.certificate->labels[row].verdict == Verdict::reached;
  return state;
}

std::vector<ComparedLabel> compared_labels(const ComparedPlan& before, const ComparedPlan& after) {
  std::vector<ComparedLabel> labels;
  for (const auto& [i, j] : matches(label_identities(before), label_identities(after), SameBy::id)) {
    ComparedLabel label;
    if (i) label.before = state_of(before, *i);
    if (j) label.after = state_of(after, *j);
    labels.push_back(label);
  }
  return labels;
}

std::size_t count_reached(const std::vector<ComparedLabel>& labels,
                          std::optional<LabelState> ComparedLabel::* of_plan) {
  return static_cast<std::size_t>(std::count_if(labels.begin(), labels.end(), [&](const auto& label) {
    return label.*of_plan && (label.*of_plan)->reached;
  }));
}

void add_certificate(PlanFigures& figures, const CertifiedPlan& plan) {
  if (const auto& availability = plan.availability) {
    figures.confidence = availability->confidence;
    if (availability->has_answer())
      figures.certificate = availability->certified ? CertificateState::certified : CertificateState::open;
    return;
  }
  if (!plan.has_verdicts()) return;
  const Certificate& certificate = *plan.certificate;
  figures.confidence = certificate.confidence;
  figures.certified = certificate.count(Verdict::reached);
  figures.certificate = certificate.count(Verdict::missed) > 0 ? CertificateState::missed
                        : certificate.all_reached()            ? CertificateState::certified
                                                               : CertificateState::open;
}

PlanFigures figures_of(const ComparedPlan& compared) {
  const auto& [labels, transceivers, signals, plan, store, names] = compared;
  const Placement& placement = plan.placement;
  PlanFigures figures;
  figures.has_selection = placement.has_selection();
  figures.units = placement.count();
  for (const std::uint32_t column : placement.selected)
    figures.installed += transceivers[column].installed ? 1 : 0;
  figures.labels = labels.size();
  figures.price = placement.price;
  figures.bounds = value_bounds(plan);
  add_certificate(figures, plan);
  if (const auto& availability = plan.availability) {
    figures.bounds.simulated = availability->sample_lower_bound;
    figures.bounds.certified = availability->lower_bound;
    if (availability->has_answer()) figures.worst_availability = availability->answer().worst();
  }
  if (figures.units == 0) return figures;
  const auto ratio = [&, &rows = labels, &received = signals](LabelId row) {
    return rows[row].requirement > 0 ? received[row] / rows[row].requirement
                                     : std::numeric_limits<double>::infinity();
  };
  figures.weakest = all_numbers<LabelId>(labels.size());
  const std::size_t listed = std::min(max_weakest, labels.size());
  std::partial_sort(figures.weakest.begin(), figures.weakest.begin() + static_cast<std::ptrdiff_t>(listed),
                    figures.weakest.end(),
                    [&](auto a, auto b) { return std::pair(ratio(a), a) < std::pair(ratio(b), b); });
  figures.weakest.resize(listed);
  return figures;
}

std::vector<QuestionKey> changed_question(const CertifiedPlan& before, const CertifiedPlan& after) {
  std::vector<QuestionKey> keys;
  const auto compare = [&](QuestionKey key, const auto& value_of) {
    if (value_of(before) != value_of(after)) keys.push_back(key);
  };
  const auto setting = [&](QuestionKey key, auto PlacementProblem::* member) {
    compare(key, [member](const CertifiedPlan& plan) { return plan.placement.problem.*member; });
  };
  setting(QuestionKey::model, &PlacementProblem::model);
  setting(QuestionKey::survives_failure, &PlacementProblem::redundant);
  setting(QuestionKey::objective, &PlacementProblem::objective);
  setting(QuestionKey::combination, &PlacementProblem::combination);
  setting(QuestionKey::share, &PlacementProblem::share);
  compare(QuestionKey::min_spacing, [](const auto& plan) { return plan.placement.min_spacing; });
  compare(QuestionKey::forbidden_pairs, [](const auto& plan) { return plan.placement.forbidden_pairs; });
  compare(QuestionKey::partial, [](const auto& plan) {
    const auto& partial = plan.placement.partial;
    return partial ? std::optional(std::pair(partial->goal, partial->value)) : std::nullopt;
  });
  const auto confidence = [](const CertifiedPlan& plan) -> std::optional<double> {
    if (plan.availability) return plan.availability->confidence;
    return plan.certificate ? std::optional(plan.certificate->confidence) : std::nullopt;
  };
  if (confidence(before) && confidence(after)) compare(QuestionKey::confidence, confidence);
  compare(QuestionKey::availability_rule, [](const CertifiedPlan& plan) {
    return plan.availability ? std::optional(plan.availability->goal.rule) : std::nullopt;
  });
  compare(QuestionKey::availability_goal, [](const CertifiedPlan& plan) {
    return plan.availability ? plan.availability->goal.value : std::nullopt;
  });
  return keys;
}

}  // namespace

LabelChange ComparedLabel::change() const {
  if (!before || !after) return before ? LabelChange::removed : LabelChange::added;
  if (before->reached == after->reached)
    return after->reached ? LabelChange::stays_reached : LabelChange::stays_missed;
  return after->reached ? LabelChange::gained : LabelChange::lost;
}

std::size_t PlanDifference::count(UnitChange change) const {
  return static_cast<std::size_t>(
      std::count_if(units.begin(), units.end(), [&](const auto& unit) { return unit.change == change; }));
}

std::size_t PlanDifference::count(LabelChange change) const {
  return static_cast<std::size_t>(std::count_if(labels.begin(), labels.end(),
                                                [&](const auto& label) { return label.change() == change; }));
}

bool PlanDifference::is_empty() const {
  const auto& [before, after] = figures;
  return store.empty() && question.empty() && count(UnitChange::kept) == units.size() &&
         count(LabelChange::stays_reached) + count(LabelChange::stays_missed) == labels.size() &&
         before.certificate == after.certificate && before.certified == after.certified &&
         before.confidence == after.confidence && before.bounds.simulated == after.bounds.simulated &&
         before.bounds.certified == after.bounds.certified;
}

PlanDifference difference_of(const ComparedPlan& before, const ComparedPlan& after) {
  PlanDifference difference{{figures_of(before), figures_of(after)},
                            compared_units(before, after),
                            compared_labels(before, after),
                            changed_question(before.plan, after.plan),
                            store_changes(before.store, after.store)};
  difference.figures.before.reached = count_reached(difference.labels, &ComparedLabel::before);
  difference.figures.after.reached = count_reached(difference.labels, &ComparedLabel::after);
  return difference;
}

}  // namespace shelfbeam
