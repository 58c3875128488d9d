#include "shelfbeam/plan/label_rounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/plan/verification.hpp"

namespace shelfbeam {

void LabelRounds::verify(const std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& selected,
                         const Question& question, std::span<const float> planned, Rounds& rounds,
                         double level, const RunControl& control) {
  control.report("verifying", -1,
                 fmt::format("round {}, {} labels, {} batches", rounds.round(), rows.size(), batches_));
  const double begun = rounds.spent();
  const auto verdicts = shelfbeam::verify(sub_scene(scene_, rows, selected), question, planned, level,
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

std::string why_no_more(const Rounds& rounds, const LabelRounds& labels, double cost_of_next) {
  const double left = std::max(0.0, rounds.left());
  if (labels.batches() >= Rounds::most_batches) return "labels are too near their requirements";
  if (left < cost_of_next)
    return fmt::format("the next round would have taken about {:.0f} {}, and {:.0f} {} were left",
                       cost_of_next, rounds.unit(), left, rounds.unit());
  constexpr std::uint32_t rounds_before_giving_up = 2;
  const double needed = labels.cost_to_decide();
  if (rounds.round() < rounds_before_giving_up || needed <= 4 * left) return {};
  return needed < 1e9 ? fmt::format("to decide the rest would take about {:.0f} {}", needed, rounds.unit())
                      : "labels are too near their requirements";
}

}  // namespace shelfbeam
