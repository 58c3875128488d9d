#include "shelfbeam/plan/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/plan/sub_scene.hpp"

namespace shelfbeam {

VerificationEffort Rounds::effort(Purpose purpose, std::uint32_t batches) const {
  const std::uint64_t stream = static_cast<std::uint64_t>(purpose) << 32 | round_;
  VerificationEffort effort{simulation_, batches};
  effort.simulation.seed = mix_key(simulation_.seed ^ 0x766572696679, stream);
  return effort;
}

void LabelRounds::verify(const std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& selected,
                         const PlacementProblem& problem, std::span<const float> planned, Rounds& rounds,
                         double level, const RunControl& control) {
  control.report("verifying", -1,
                 fmt::format("round {}, {} labels, {} batches", rounds.round(), rows.size(), batches_));
  const double begun = rounds.spent();
  const auto verdicts = shelfbeam::verify(sub_scene(scene_, rows, selected), problem, planned, level,
                                          rounds.effort(Purpose::verify, batches_), control);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    labels_[rows[k]] = verdicts[k];
    rounds.spend(verdicts[k].samples);
  }
  took_ = rounds.spent() - begun;
}

double LabelRounds::cost_to_decide() const {
  double times = 0;
  for (const LabelVerdict& label : labels_) {
    if (label.verdict != Verdict::undecided) continue;
    const double missing = std::abs(label.signal - label.requirement);
    const double width = (label.upper - label.lower) / 2;
    times =
        std::max(times, missing > 0 ? std::pow(width / missing, 2) : std::numeric_limits<double>::infinity());
  }
  return times == 0 || took_ == 0 ? 0 : times * took_;
}

std::string stop_reason(const Rounds& rounds, const LabelRounds& labels, double cost_of_next) {
  const double left = std::max(0.0, rounds.left());
  if (labels.batches() >= Rounds::max_batches) return "labels are too close to their requirements";
  if (left < cost_of_next)
    return fmt::format("the next round would have taken about {:.0f} {}, but {:.0f} {} were left",
                       cost_of_next, rounds.unit(), left, rounds.unit());
  constexpr std::uint32_t rounds_before_giving_up = 2;
  const double needed = labels.cost_to_decide();
  if (rounds.round() < rounds_before_giving_up || needed <= 4 * left) return {};
  return needed < 1e9 ? fmt::format("deciding the rest would take about {:.0f} {}", needed, rounds.unit())
                      : "labels are too close to their requirements";
}

CertifiedPlan verify_installation(const Scene& scene, const PlacementProblem& problem,
                                  const CertifyOptions& options, const RunControl& control) {
  // The signals that plan the links; sums need no plan.
  std::vector<float> planned;
  if (problem.model == CommunicationModel::non_cooperative)
    planned = simulate(scene, options.simulation, control).matrix.mean;
  CertifiedPlan plan;
  Placement& placement = plan.placement;
  placement.problem = problem;
  placement.selected.resize(scene.transceivers.size());
  std::iota(placement.selected.begin(), placement.selected.end(), 0U);
  placement.objective_value = static_cast<double>(placement.count());
  Certificate& certificate = plan.certificate.emplace();
  certificate.confidence = options.confidence;
  for (const Label& label : scene.labels)
    certificate.labels.push_back({.requirement = scene.type_of(label).requirement()});
  Rounds rounds(options.confidence, options.budget, options.simulation);
  LabelRounds verdicts(scene, certificate.labels);
  try {
    while (true) {
      std::vector<std::uint32_t> rows;
      for (std::uint32_t i = 0; i < certificate.labels.size(); ++i)
        if (certificate.labels[i].verdict == Verdict::undecided) rows.push_back(i);
      if (rows.empty()) break;
      if (rounds.round() > 0) {
        certificate.open = stop_reason(rounds, verdicts, verdicts.cost_of_next());
        if (!certificate.open.empty()) break;
        verdicts.grow();
      }
      rounds.next();
      certificate.rounds = rounds.round();
      std::vector<float> of_rows;
      if (!planned.empty())
        for (const std::uint32_t i : rows) {
          const auto row = planned.begin() + static_cast<std::ptrdiff_t>(i * placement.count());
          of_rows.insert(of_rows.end(), row, row + static_cast<std::ptrdiff_t>(placement.count()));
        }
      verdicts.verify(rows, placement.selected, problem, of_rows, rounds, rounds.level(1), control);
    }
  } catch (const Interrupted&) {
    certificate.open = "it was interrupted";
  }
  certificate.seconds = rounds.seconds();
  return plan;
}

}  // namespace shelfbeam
