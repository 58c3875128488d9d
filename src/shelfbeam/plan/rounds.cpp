#include "shelfbeam/plan/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

BatchRequest Rounds::request(Purpose purpose, std::span<const LabelId> labels, std::uint32_t batches,
                             std::uint32_t part) const {
  const std::uint64_t stream = static_cast<std::uint64_t>(purpose) << 32 | round_;
  BatchRequest request{labels, mix_key(mix_key(seed_ ^ 0x766572696679, stream), part), batches};
  request.min_samples = min_samples;
  return request;
}

// Costs are predicted from earlier rounds, and other work than sampling follows.
constexpr double share_to_spend = 0.9;
// The first batches of labels whose planned margin is wide. Few are enough for lower limits of light, whose
// values are skewed towards larger ones.
constexpr double wide_margin = 1.5;
constexpr std::uint32_t batches_of_wide = 16;

void Rounds::report(Task task, std::string_view detail) const {
  control_.report(task, -1, fmt::format("round {}, {}", round_, detail));
}

void Rounds::measure(TracedUnits units, double begun, std::uint64_t samples, double batches) {
  samples_ += samples;
  double& cost = units == TracedUnits::all ? cost_of_all_ : cost_of_chosen_;
  if (batches > 0) cost = std::max(1e-12, (spent() - begun) / batches);
}

void Rounds::measure(double begun, std::span<const ValidationRow> fresh) {
  std::uint64_t samples = 0;
  double batches = 0;
  for (const ValidationRow& row : fresh) {
    samples += row.samples;
    batches += row.batches;
  }
  measure(TracedUnits::all, begun, samples, batches);
}

std::uint32_t Rounds::affordable(double wanted, double needed, double cost) const {
  const double fitting = cost > 0 ? share_to_spend * left() / cost : wanted;
  const double batches = std::min({std::ceil(wanted), fitting, static_cast<double>(max_batches)});
  const bool is_useful = batches >= min_batches && batches >= std::min(wanted, needed / 2);
  return is_useful ? static_cast<std::uint32_t>(batches) : 0;
}

double Rounds::samples_per_batch(const PreparedScene& prepared) {
  if (prepared.world().receivers.size() == 0) return 1;
  constexpr LabelId any_label[] = {0};
  return static_cast<double>(prepared.estimator().part(any_label, 0, min_samples)->samples_per_batch());
}

void LabelRounds::select(const PlacementProblem& problem, Selection selected, std::vector<float> planned,
                         bool is_final) {
  for (LabelVerdict& label : labels_) label = {.requirement = label.requirement};
  problem_ = problem;
  selected_ = std::move(selected);
  planned_ = std::move(planned);
  margins_ = planned_margins();
  is_final_ = is_final;
  prepared_.reset();
  part_.reset();
  passes_.assign(labels_.size(), false);
  batches_.assign(labels_.size(), 0);
  aims_at_all_ = true;
}

bool LabelRounds::holds_jointly() const {
  return std::all_of(passes_.begin(), passes_.end(), [](bool passes) { return passes; });
}

// The batches that open labels are expected to need, with a reserve because estimates err; in classes, so
// that labels are sampled together.
std::vector<LabelRounds::Need> LabelRounds::needs(double level) const {
  constexpr double reserve = 1.5;
  std::vector<Need> needs;
  for (std::uint32_t i = 0; i < labels_.size(); ++i) {
    const LabelVerdict& label = labels_[i];
    if (aims_at_all_ ? passes_[i] : label.verdict != Verdict::undecided) continue;
    double batches = 0, of_class = Rounds::min_batches;
    if (batches_[i] > 0) {
      const double margin = std::abs(label.signal - label.requirement);
      const double quantile = -student_quantile(level, batches_[i] - 1);
      batches = reserve * batches_[i] * std::pow(quantile * label.standard_error / margin, 2);
      // A flagged estimate has no reliable error.
      batches = std::max(batches, 2.0 * batches_[i]);
    } else if (margins_[i] >= wide_margin) {
      of_class = batches_of_wide;
    }
    while (of_class < batches && of_class <= Rounds::max_batches) of_class *= 2;
    needs.push_back({of_class, i});
  }
  std::stable_sort(needs.begin(), needs.end(),
                   [](const Need& a, const Need& b) { return a.batches < b.batches; });
  return needs;
}

// The labels, the first in order, that fit into the budget with at least half of their batches. Reduces the
// batches if these labels do not fit with all of them.
std::size_t LabelRounds::shrink_to_budget(const Rounds& rounds, std::vector<Need>& needs) {
  constexpr double min_share = 0.5;
  const double cost = rounds.cost(TracedUnits::chosen);
  const double fitting =
      cost > 0 ? share_to_spend * rounds.left() / cost : std::numeric_limits<double>::infinity();
  double batches = 0;
  std::size_t count = 0;
  for (; count < needs.size() && needs[count].batches <= Rounds::max_batches; ++count) {
    if (min_share * (batches + needs[count].batches) > fitting) break;
    batches += needs[count].batches;
  }
  if (batches > fitting)
    for (std::size_t k = 0; k < count; ++k)
      needs[k].batches = std::max(std::min<double>(Rounds::min_batches, needs[k].batches),
                                  std::floor(needs[k].batches * fitting / batches));
  return count;
}

void LabelRounds::sample(std::vector<LabelId> rows, std::uint32_t batches, std::uint32_t part, Rounds& rounds,
                         const VerdictLevels& levels) {
  rounds.report(Task::verifying, fmt::format("{} labels, {} batches", rows.size(), batches));
  std::sort(rows.begin(), rows.end());
  if (!prepared_) {
    part_ = with_units(scene_, selected_);
    SimulationOptions own = simulation_;
    own.seed = mix_key(simulation_.seed ^ 0x766572696679, 0);  // the tables of the matrix chose the units
    prepared_ = prepare(*part_, own, false, rounds.control());
  }
  std::vector<float> planned;
  if (!planned_.empty())
    for (const LabelId i : rows) {
      const auto first = planned_.begin() + static_cast<std::ptrdiff_t>(i * selected_.size());
      planned.insert(planned.end(), first, first + static_cast<std::ptrdiff_t>(selected_.size()));
    }
  const double begun = rounds.spent();
  const auto verdicts = shelfbeam::verify(*prepared_, rounds.request(Purpose::verify, rows, batches, part),
                                          problem_, planned, levels, rounds.control());
  std::uint64_t samples = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    labels_[rows[k]] = verdicts[k];
    // Upper limits need more batches.
    if (batches < Rounds::min_batches && verdicts[k].verdict == Verdict::missed)
      labels_[rows[k]].verdict = Verdict::undecided;
    batches_[rows[k]] = batches;
    if (is_met(verdicts[k].joint_lower, verdicts[k].requirement)) passes_[rows[k]] = true;
    samples += verdicts[k].samples;
  }
  rounds.measure(TracedUnits::chosen, begun, samples, static_cast<double>(rows.size()) * batches);
}

// The planned signals that verdicts are about, as shares of the requirements.
std::vector<double> LabelRounds::planned_margins() const {
  std::vector<double> margins(labels_.size(), 0.0);
  if (planned_.empty()) return margins;
  const std::size_t units = selected_.size();
  const std::vector<bool> chosen(units, true);
  std::vector<SignalEntry> row(units);
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    for (std::uint32_t j = 0; j < units; ++j) row[j] = {j, static_cast<double>(planned_[i * units + j])};
    margins[i] = received_signal(row, chosen, problem_) / labels_[i].requirement;
  }
  return margins;
}

// Samples together the labels that follow each other with the same number of batches.
void LabelRounds::sample_classes(std::span<const Need> needs, std::uint32_t& part, Rounds& rounds,
                                 const VerdictLevels& levels) {
  for (std::size_t k = 0; k < needs.size();) {
    std::vector<LabelId> rows;
    const double batches = needs[k].batches;
    for (; k < needs.size() && needs[k].batches == batches; ++k) rows.push_back(needs[k].label);
    sample(std::move(rows), static_cast<std::uint32_t>(batches), part++, rounds, levels);
  }
}

std::size_t LabelRounds::verify(Rounds& rounds) {
  const VerdictLevels levels{rounds.level() / 2, labels_.size(), rounds.level() / 2};
  const double of_list = levels.list / static_cast<double>(labels_.size());
  std::vector<Need> all = needs(aims_at_all_ ? levels.joint : of_list);
  std::size_t count = shrink_to_budget(rounds, all);
  if (count < all.size() && aims_at_all_) {
    // Some labels stay undecided, so the others need verdicts of the list.
    aims_at_all_ = false;
    all = needs(of_list);
    count = shrink_to_budget(rounds, all);
  }
  // A new selection often fails at the labels that are nearest to their requirements.
  std::size_t verified = count;
  if (!is_final_ &&
      std::all_of(batches_.begin(), batches_.end(), [](auto batches) { return batches == 0; })) {
    std::stable_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const Need& a, const Need& b) { return margins_[a.label] < margins_[b.label]; });
    verified = std::min(riskiest_labels, count);
  }
  const std::span<const Need> fitting(all.data(), count);
  std::uint32_t part = 0;
  sample_classes(fitting.first(verified), part, rounds, levels);
  if (verified < count && undecided_labels().empty()) {
    sample_classes(fitting.subspan(verified), part, rounds, levels);
    verified = count;
  }
  skipped_ = {};
  for (std::size_t k = verified; k < all.size(); ++k) {
    const bool is_near = all[k].batches > Rounds::max_batches;
    if (is_near) continue;
    ++skipped_.labels;
    skipped_.cost += rounds.cost(TracedUnits::chosen) * all[k].batches;
  }
  const auto is_missed = [](const LabelVerdict& label) { return label.verdict == Verdict::missed; };
  const bool has_missed = std::any_of(labels_.begin(), labels_.end(), is_missed);
  if (has_missed) aims_at_all_ = false;
  if (holds_jointly() && !has_missed)
    for (LabelVerdict& label : labels_) {
      if (label.verdict == Verdict::reached) continue;
      label.verdict = Verdict::reached;
      label.lower = label.joint_lower;
    }
  return verified;
}

std::vector<LabelId> LabelRounds::undecided_labels() const {
  constexpr std::uint32_t many_batches = 4096;  // those of a margin of about one percent
  std::vector<LabelId> rows;
  for (std::uint32_t i = 0; i < labels_.size(); ++i) {
    const bool is_short = batches_[i] > 0 && !is_met(labels_[i].signal, labels_[i].requirement);
    const bool is_near =
        batches_[i] >= many_batches && !passes_[i] && labels_[i].verdict == Verdict::undecided;
    if (is_short || is_near) rows.push_back(i);
  }
  return rows;
}

EndReason LabelRounds::obstacle(const Rounds& rounds) const {
  if (skipped_.labels == 0) return rounds.stop_reason(EndCause::labels_near);
  return {
      .cause = EndCause::labels_cost, .labels = skipped_.labels, .seconds = rounds.in_seconds(skipped_.cost)};
}

}  // namespace shelfbeam
