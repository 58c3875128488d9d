#include "shelfbeam/plan/verify_installation.hpp"

#include <numeric>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/plan/label_rounds.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

namespace shelfbeam {

namespace {

std::vector<std::uint32_t> undecided(const std::vector<LabelVerdict>& labels) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (labels[i].verdict == Verdict::undecided) rows.push_back(i);
  return rows;
}

// The signals by which links are planned; sums need no plan.
std::vector<float> planned_signals(const Scene& scene, const Question& question,
                                   const SimulationOptions& options, const RunControl& control) {
  if (question.model == CommunicationModel::cooperative) return {};
  return simulate(scene, options, control).matrix.mean;
}

}  // namespace

CertifiedPlan verify_installation(const Scene& scene, const Question& question, const CertifyOptions& options,
                                  const RunControl& control) {
  const std::vector<float> planned = planned_signals(scene, question, options.simulation, control);
  CertifiedPlan plan;
  Placement& placement = plan.placement;
  placement.question = question;
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
      const std::vector<std::uint32_t> rows = undecided(certificate.labels);
      if (rows.empty()) break;
      if (rounds.round() > 0) {
        certificate.open = why_no_more(rounds, verdicts, verdicts.cost_of_next());
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
      verdicts.verify(rows, placement.selected, question, of_rows, rounds, rounds.level(1), control);
    }
  } catch (const Interrupted&) {
    certificate.open = "it was interrupted";
  }
  certificate.seconds = rounds.seconds();
  return plan;
}

}  // namespace shelfbeam
