#include "shelfbeam/plan/states/deciding_labels.hpp"

#include <algorithm>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam {

namespace {

// If the table of all labels is smaller, all decide: simulating some of them for all candidates and the rest
// for the selection takes as long.
constexpr std::size_t small_table = std::size_t{1} << 30;  ///< bytes

// Otherwise labels decide if the first selection leaves them less than this, in requirements, in any state.
// Other selections may serve them differently, and then they are added.
constexpr double little_reserve = 1.1;

}  // namespace

DecidingLabels::DecidingLabels(const StateSample& sample, const SignalTable& all,
                               const PlacementProblem& problem)
    : sample_(sample),
      all_(all),
      problem_(problem),
      row_of_(all.rows(), no_row),
      table_(make_scenario_table(all_, {}, sample_.count())) {}

DecidingLabels::DecidingLabels(const StateSample& sample, const SignalTable& all,
                               const PlacementProblem& problem, std::span<const ColumnId> start)
    : DecidingLabels(sample, all, problem) {
  const std::vector<LabelId> every = all_numbers<LabelId>(all.rows());
  const std::size_t entries = all.rows() * all.columns() * sample_.count();
  if (entries * 2 * sizeof(float) <= small_table) {
    add(every);
    misses_of_start_ = misses(start);
    return;
  }
  const std::vector<double> received = sample_.received(every, start, problem_);
  misses_of_start_ = misses_with(every, received, start);
  add_if([&](LabelId i) {
    const auto begin = received.begin() + static_cast<std::ptrdiff_t>(std::size_t{i} * sample_.count());
    return !is_met(*std::min_element(begin, begin + sample_.count()),
                   little_reserve * requirement_of(all_.labels[i], problem_.model));
  });
  if (labels_.empty()) add_if([](LabelId i) { return i == 0; });
}

void DecidingLabels::add(std::span<const LabelId> labels) {
  if (labels.empty()) return;
  const std::size_t first = labels_.size();
  for (const LabelId i : labels) {
    row_of_[i] = static_cast<std::uint32_t>(labels_.size());
    labels_.push_back(i);
  }
  ScenarioTable grown = make_scenario_table(all_, labels_, sample_.count(), table_);
  sample_.fill(grown, labels, first);
  table_ = std::move(grown);
}

ScenarioMisses DecidingLabels::misses_with(std::span<const LabelId> others, std::span<const double> received,
                                           std::span<const ColumnId> selected) const {
  const std::size_t states = sample_.count();
  MissCounter misses(row_of_.size(), states);
  for (std::size_t k = 0; k < others.size(); ++k) {
    const double requirement = requirement_of(all_.labels[others[k]], problem_.model);
    for (std::size_t s = 0; s < states; ++s)
      if (!is_met(received[k * states + s], requirement)) misses.add(others[k], s);
  }
  for_each_weak(table_, problem_, selected, 1,
                [&](LabelId row, std::uint32_t s, const ReceivedSignal&) { misses.add(labels_[row], s); });
  return misses.misses();
}

ScenarioMisses DecidingLabels::misses(std::span<const ColumnId> selected) const {
  const auto others = numbers_where<LabelId>(row_of_.size(), [&](LabelId i) { return !has(i); });
  return misses_with(others, sample_.received(others, selected, problem_), selected);
}

}  // namespace shelfbeam
