#include "system/claims/claims.hpp"

namespace shelfbeam::test {

namespace {

constexpr double rounding = 1e-9;

// The signal of a label from some units, after the worst failure if one may fail.
double received(const SignalTable& table, std::size_t label, const Selection& units,
                const PlacementProblem& problem) {
  std::vector<double> signals;
  for (const SignalEntry& entry : table.row(label))
    if (std::find(units.begin(), units.end(), entry.transceiver) != units.end())
      signals.push_back(entry.signal);
  std::sort(signals.rbegin(), signals.rend());
  if (problem.redundant && !signals.empty()) signals.erase(signals.begin());
  if (problem.model == CommunicationModel::non_cooperative)
    signals.resize(std::min<std::size_t>(1, signals.size()));
  double sum = 0;
  for (const double signal : signals) sum += signal;
  return sum;
}

double count_of(const Certificate& certificate, Verdict verdict) {
  double count = 0;
  for (const LabelVerdict& label : certificate.labels) count += label.verdict == verdict ? 1 : 0;
  return count;
}

}  // namespace

Truth::Truth(const PlannedStore& store) {
  add_counts(store);
  add_labels(store);
  add_bounds(store.plan);
  add_certificate(store.plan);
  add_alternatives(store.plan.alternatives);
  if (store.plan.sensitivity) add_sensitivity(*store.plan.sensitivity);
  if (store.plan.availability) add_availability(store);
  add_values(store.plan);
  values_["certified yes"] = values_[store.plan.availability ? "certified states" : "all reached"];
}

void Truth::add_values(const CertifiedPlan& plan) {
  values_["any assumed"] = values_["any given"] = values_["threshold assumed"] = 0;
  for (const DecisiveValue& value : plan.values) {
    if (value.state == ValueState::assumed) values_["any assumed"] = 1;
    if (value.state == ValueState::given) values_["any given"] = 1;
    if (value.state == ValueState::assumed && value.kind == ValueKind::threshold)
      values_["threshold assumed"] = 1;
  }
  if (plan.values.empty()) values_["any given"] = 1;
  values_["example"] = plan.is_example;
}

double Truth::operator()(const std::string& name, Subject subject) const {
  const auto found = of_subject_.find({subject, name});
  return found != of_subject_.end() ? found->second : values_.at(name);
}

void Truth::add_counts(const PlannedStore& store) {
  const Placement& placement = store.plan.placement;
  double installed = 0, total = 0, spend = 0;
  for (const std::uint32_t j : placement.selected) {
    const SignalTable::Transceiver& unit = store.table.transceivers[j];
    installed += unit.installed ? 1 : 0;
    total += unit.cost;
    spend += unit.installed ? 0 : unit.cost;
  }
  const auto count = static_cast<double>(placement.selected.size());
  values_["units"] = count;
  values_["units less one"] = count - 1;
  values_["installed"] = installed;
  values_["new units"] = count - installed;
  values_["labels"] = static_cast<double>(store.table.rows());
  values_["candidates"] = static_cast<double>(store.table.columns());
  values_["total price"] = total;
  values_["new spend"] = spend;
  values_["by spend"] = placement.problem.combination == Combination::spend;
  values_["by sum"] = placement.problem.combination == Combination::weighted;
  values_["redundant"] = placement.problem.redundant;
  values_["greedy"] = placement.status == Status::feasible;
  values_["optimal"] = placement.status == Status::optimal;
  values_["stopped"] = placement.status == Status::stopped;
  values_["infeasible"] = placement.status == Status::infeasible;
  values_["out of reach"] = static_cast<double>(placement.unreachable.size());
  values_["dark"] = 0;
  for (const Unreachable& label : placement.unreachable) values_["dark"] += label.max_signal <= 0 ? 1 : 0;
  values_["pairs"] = static_cast<double>(placement.forbidden_pairs);
  values_["points"] = static_cast<double>(store.table.mounting_points());
  values_["warnings"] = static_cast<double>(store.plan.warnings.size());
}

void Truth::add_labels(const PlannedStore& store) {
  const Placement& placement = store.plan.placement;
  const PlacementProblem& problem = placement.problem;
  PlacementProblem with_failure = problem;
  with_failure.redundant = true;
  double met = 0, secure = 0, close = 0, weakest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < store.table.rows(); ++i) {
    const SignalTable::Label& label = store.table.labels[i];
    const double need = label.requirement * (1 - rounding);
    const double signal = received(store.table, i, placement.selected, problem);
    weakest = std::min(weakest, signal / label.requirement);
    met += signal >= need ? 1 : 0;
    secure += received(store.table, i, placement.selected, with_failure) >= need ? 1 : 0;
    close += signal >= need && 0.75 * signal < label.requirement ? 1 : 0;
  }
  PlacementProblem plain = problem;
  plain.redundant = false;
  const auto most_lost = [&](const PlacementProblem& rule) {
    double most = 0;
    for (const std::uint32_t failed : placement.selected) {
      Selection others = placement.selected;
      std::erase(others, failed);
      double lost = 0;
      for (std::size_t i = 0; i < store.table.rows(); ++i) {
        const double need = store.table.labels[i].requirement * (1 - rounding);
        lost += received(store.table, i, placement.selected, rule) >= need &&
                        received(store.table, i, others, rule) < need
                    ? 1
                    : 0;
      }
      most = std::max(most, lost);
    }
    return most;
  };
  values_["reached"] = met;
  values_["secure"] = secure;
  values_["single"] = met - secure;
  values_["close"] = close;
  values_["most lost"] = most_lost(problem);
  values_["most dependent"] = most_lost(plain);
  values_["weakest"] = weakest;
  values_["weakest percent"] = 100 * weakest;
}

void Truth::add_bounds(const CertifiedPlan& plan) {
  const Placement& placement = plan.placement;
  const bool by_cost = placement.problem.combination != Combination::lexicographic;
  const double count = values_["units"], installed = values_["installed"];
  const double value = by_cost ? placement.objective_value : count;
  const double of_count =
      std::isfinite(placement.count_lower_bound) ? std::ceil(placement.count_lower_bound - 1e-6) : 0;
  const bool is_optimal = placement.status == Status::optimal;
  const double simulated = !by_cost ? of_count : is_optimal ? value : placement.lower_bound;
  values_["value"] = value;
  values_["simulated"] = simulated;
  values_["simulated new"] = simulated - installed;
  values_["simulated units"] = of_count;
  values_["simulated units hold"] = count > 0 && of_count >= count;
  values_["simulated holds"] = simulated >= value * (1 - rounding);
  values_["gap of units"] = count > 0 ? (count - std::min(count, of_count)) / count : 0;
  values_["objective"] = placement.objective_value;
  values_["bound of objective"] = placement.lower_bound;
  values_["gap"] = is_optimal || placement.objective_value <= placement.lower_bound
                       ? 0
                       : (placement.objective_value - placement.lower_bound) / placement.objective_value;
}

void Truth::add_certificate(const CertifiedPlan& plan) {
  const double value = values_["value"];
  values_["certificate"] = plan.certificate.has_value();
  values_["over states"] = plan.availability.has_value();
  double certified = 0, verified = 0;
  for (const char* name :
       {"undecided", "unverified", "missed", "bound labels", "all reached", "settled", "depends on signals"})
    values_[name] = 0;
  of_subject_[{Subject::nothing, "reached"}] = values_["labels"];
  values_["confirmed"] = values_["reached"];
  if (plan.certificate) {
    const Certificate& certificate = *plan.certificate;
    const double reached = count_of(certificate, Verdict::reached),
                 unverified = count_of(certificate, Verdict::unverified);
    verified = unverified < values_["labels"];
    const PlacementProblem& problem = plan.placement.problem;
    const bool by_cost = problem.combination != Combination::lexicographic;
    const bool has_signals =
        problem.objective == Objective::signal || problem.objective == Objective::effective_links ||
        (problem.objective == Objective::links && problem.model == CommunicationModel::non_cooperative);
    if (by_cost) certified = has_signals ? 0 : certificate.cost_lower_bound;
    if (!by_cost) certified = static_cast<double>(certificate.count_lower_bound);
    if (verified == 0) certified = 0;
    values_["depends on signals"] = has_signals;
    values_["confidence"] = 100 * certificate.confidence;
    values_["missed"] = count_of(certificate, Verdict::missed);
    values_["undecided"] = count_of(certificate, Verdict::undecided);
    values_["unverified"] = unverified;
    values_["count bound"] = static_cast<double>(certificate.count_lower_bound);
    values_["cost bound"] = certificate.cost_lower_bound;
    values_["bound labels"] = static_cast<double>(certificate.bound_labels);
    values_["all reached"] = reached == values_["labels"];
    values_["settled"] = !certificate.open;
    values_["confirmed"] = verified > 0 ? reached : values_["reached"];
  }
  of_subject_[{Subject::certificate, "reached"}] = values_["confirmed"];
  values_["verified"] = verified;
  values_["certified"] = certified;
  values_["certified new"] = certified - values_["installed"];
  // Nothing is certified about a sum that depends on signals.
  const bool counts_signals = verified == 0 || (values_["by sum"] > 0 && values_["depends on signals"] > 0);
  values_["open bound"] = counts_signals ? values_["simulated"] : certified;
  values_["open bound new"] = std::max(0.0, values_["open bound"] - values_["installed"]);
  values_["open"] = values_["open bound"] < value * (1 - rounding);
  values_["certified holds"] = certified > 0 && certified >= value * (1 - rounding);
}

void Truth::add_alternatives(const Alternatives& alternatives) {
  const auto add = [&](const std::string& name, const std::optional<Alternative>& one) {
    if (!one) return;
    values_[name + " units"] = static_cast<double>(one->selected.size());
    values_[name + " spend"] = one->price ? one->price->to_spend : 0;
    values_[name + " reached"] = static_cast<double>(one->reached);
    values_[name + " at most"] = static_cast<double>(one->max_reached);
    values_[name + " lost"] = values_["labels"] - static_cast<double>(one->reached);
    values_[name + " least lost"] = values_["labels"] - static_cast<double>(one->max_reached);
    values_[name + " secure"] = static_cast<double>(one->secure);
    values_[name + " weakest"] = one->smallest_margin;
    values_[name + " proven"] = one->is_proven;
  };
  for (const char* fewer : {"One unit fewer", "Fewer units"}) add(fewer, alternatives.one_fewer);
  add("One unit more", alternatives.one_more);
  add("Survives any one failure", alternatives.survives_failure);
  for (const auto& [name, same] : {std::pair("units", "units"),
                                   {"spend", "new spend"},
                                   {"reached", "reached"},
                                   {"weakest", "weakest"},
                                   {"secure", "secure"}})
    values_[fmt::format("This plan {}", name)] = values_[same];
  values_["no survivor"] = alternatives.cannot_survive;
}

void Truth::add_sensitivity(const Sensitivity& sensitivity) {
  const auto missed = static_cast<double>(sensitivity.low.missed.size());
  const auto undecided = static_cast<double>(sensitivity.low.undecided.size());
  of_subject_[{Subject::reflectances, "confidence"}] = 100 * sensitivity.confidence;
  values_["reached dark"] = values_["labels"] - missed - undecided;
  values_["missed dark"] = missed;
  values_["undecided dark"] = undecided;
  values_["lost dark"] = missed + undecided;
  values_["weakest dark"] = sensitivity.low.min_margin.ratio;
  values_["weakest light"] = sensitivity.high.min_margin.ratio;
}

void Truth::add_availability(const PlannedStore& store) {
  const Availability& found = *store.plan.availability;
  add_outcome("nominal", found, found.nominal);
  add_outcome("sample", found, found.sample);
  if (!found.examined.empty()) add_outcome("answer", found, found.examined.back());
  if (found.addition) {
    add_outcome("nominal", found, found.addition->without, Subject::without_addition);
    add_outcome("nominal", found, found.addition->added, Subject::with_addition);
  }
  values_["goal"] = found.goal.value.value_or(0) * (found.goal.rule == AvailabilityRule::misses ? 1 : 100);
  values_["sample bound"] = found.sample_lower_bound;
  values_["sample holds"] = found.sample_value <= found.sample_lower_bound * (1 + rounding);
  values_["state bound"] = found.lower_bound;
  values_["state bound holds"] = found.certified && found.lower_bound >= values_["value"] * (1 - rounding);
  values_["certified states"] = found.certified;
  values_["impossible"] = !found.unreachable.empty() || std::isinf(found.sample_lower_bound);
  values_["more to certify"] = found.examined.empty() ? 0
                                                      : static_cast<double>(found.examined.back().units) -
                                                            static_cast<double>(found.sample.units);
  values_["confidence"] = 100 * found.confidence;
  if (found.required.empty()) return;
  values_["required"] = 100 * *std::min_element(found.required.begin(), found.required.end());
  values_["required most"] = 100 * *std::max_element(found.required.begin(), found.required.end());
}

void Truth::add_outcome(const std::string& name, const Availability& found, const StateOutcome& outcome,
                        std::optional<Subject> subject) {
  const auto set = [&](const char* value, double number) {
    (subject ? of_subject_[{*subject, name + value}] : values_[name + value]) = number;
  };
  const double states = std::max(1U, outcome.states);
  double below = 0, most = 0, missed = 0;
  for (std::size_t i = 0; i < outcome.missed.size(); ++i) {
    const double share = outcome.missed[i] / states;
    below += 1 - share < found.required[i] - rounding ? 1 : 0;
    most = std::max(most, share);
    missed += share;
  }
  const double all = 1 - outcome.states_with_miss / states;
  const bool by_shop = found.goal.rule == AvailabilityRule::shop,
             by_misses = found.goal.rule == AvailabilityRule::misses;
  set(" units", static_cast<double>(outcome.units));
  set(" states", outcome.states);
  set(" below", below);
  set(" worst", 100 * (1 - most));
  set(" all", 100 * all);
  set(" missed", missed);
  set(" enough", by_shop ? all >= *found.goal.value : by_misses ? missed <= *found.goal.value : below == 0);
}

}  // namespace shelfbeam::test
