#include "shelfbeam/signal/parts/state_summary.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam::detail {

namespace {

std::vector<LabelId> hardest_labels(const SignalMatrix& matrix, std::span<const float> first,
                                    std::size_t max_count) {
  std::vector<double> degree(matrix.rows());
  for (std::size_t e = 0; e < first.size(); ++e) {
    const std::size_t i = e / matrix.columns();
    degree[i] += std::min(1.0, static_cast<double>(first[e]) / matrix.labels[i].requirement);
  }
  std::vector<LabelId> order = ordered_by<LabelId>(degree.size(), [&](LabelId i) { return degree[i]; });
  order.resize(std::min(order.size(), std::max<std::size_t>(1, max_count)));
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace

void StateSummary::add(std::span<const float> signals, std::span<const float> errors) {
  StateTensor& states = *signals_.states;
  for (std::size_t e = 0; e < moments_.size(); ++e) moments_[e].add(static_cast<double>(signals[e]));
  if (states.states == 0) states.hard = hardest_labels(signals_, signals, max_hard_);
  ++states.states;
  const std::size_t n = signals_.columns();
  for (const LabelId i : states.hard) {
    const auto append = [&](std::vector<float>& all, std::span<const float> row) {
      all.insert(all.end(), row.begin(), row.end());
    };
    append(states.signal, signals.subspan(i * n, n));
    if (!errors.empty()) append(states.error, errors.subspan(i * n, n));
  }
}

StoredSignals StateSummary::result() && {
  for (auto* values : {&signals_.mean, &signals_.standard_error, &signals_.states->deviation})
    values->resize(moments_.size());
  for (std::size_t e = 0; e < moments_.size(); ++e) {
    const Moments& moments = moments_[e];
    const bool has_spread = moments.count() > 1;
    signals_.mean[e] = static_cast<float>(moments.mean());
    signals_.standard_error[e] = static_cast<float>(has_spread ? moments.standard_error() : 0);
    signals_.states->deviation[e] = static_cast<float>(has_spread ? std::sqrt(moments.variance()) : 0);
  }
  return std::move(signals_);
}

}  // namespace shelfbeam::detail
