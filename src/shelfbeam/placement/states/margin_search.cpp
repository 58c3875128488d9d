#include "shelfbeam/placement/states/margin_search.hpp"

#include <algorithm>
#include <numeric>

namespace shelfbeam {

namespace {

constexpr double max_margin = 4;

}  // namespace

MarginSearch::MarginSearch(const StateTable& states, const PlacementProblem& problem,
                           const MissAllowance& allowance)
    : states_(states),
      problem_(problem),
      allowance_(allowance),
      mean_(states.table),
      margin_(states.table.rows(), 1) {
  mean_.entries.clear();
  mean_.row_begin = {0};
  for (std::size_t i = 0; i < states.table.rows(); ++i) {
    for (std::uint32_t j = 0; j < states.table.columns(); ++j) {
      const std::span<const float> signal = states.of(j, i);
      const double sum = std::accumulate(signal.begin(), signal.end(), 0.0);
      if (sum > 0) mean_.entries.push_back({j, sum / static_cast<double>(states.states)});
    }
    mean_.row_begin.push_back(mean_.entries.size());
  }
}

std::vector<std::uint32_t> MarginSearch::next(double seconds, const PlaceOptions& options,
                                              const RunControl& control) {
  SignalTable raised = mean_;
  std::vector<bool> all(raised.columns(), true);
  for (std::size_t i = 0; i < raised.rows(); ++i) {
    // A label that few units reach must not make the problem infeasible.
    const double most = received_signal(raised, i, all, problem_) / 1.01;
    for (double* requirement : {&raised.labels[i].requirement, &raised.labels[i].single_requirement})
      *requirement = std::max(*requirement, std::min(most, *requirement * margin_[i]));
  }
  PlaceOptions quick = options;
  quick.time_limit_s = seconds;
  quick.proves = false;
  quick.settles_ties = false;
  quick.start.clear();
  const Placement placement = place(raised, problem_, quick, control);
  if (!placement.has_selection()) return {};
  adapt(placement.selected);
  return placement.selected;
}

void MarginSearch::adapt(const std::vector<std::uint32_t>& selected) {
  for (std::size_t i = 0; i < margin_.size(); ++i) {
    const std::uint64_t allowed = allowance_.of_label.empty() ? 0 : allowance_.limit(i);
    if (allowed >= states_.states) continue;
    std::vector<double> received = received_signals(states_, problem_, i, selected);
    const double mean =
        std::accumulate(received.begin(), received.end(), 0.0) / static_cast<double>(received.size());
    const auto least = received.begin() + static_cast<std::ptrdiff_t>(allowed);
    std::nth_element(received.begin(), least, received.end());
    const double margin = *least > 0 ? mean / *least : max_margin;
    margin_[i] = std::clamp(margin, 1.0, max_margin);
  }
}

}  // namespace shelfbeam
