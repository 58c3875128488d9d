#include "shelfbeam/placement/states/state_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shelfbeam {

StateTable make_state_table(const SignalMatrix& matrix, SignalTable table) {
  StateTable states;
  states.table = std::move(table);
  states.states = matrix.by_state.size();
  const std::size_t m = matrix.rows(), n = matrix.columns();
  states.signal.resize(m * states.states * n);
  for (std::size_t s = 0; s < states.states; ++s)
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < n; ++j)
        states.signal[(i * states.states + s) * n + j] = std::max(0.0F, matrix.by_state[s].mean[i * n + j]);
  return states;
}

double received_signal(std::span<const float> row, std::span<const std::uint32_t> selected,
                       const PlacementProblem& problem) {
  double sum = 0, largest = 0, second = 0;
  for (const std::uint32_t j : selected) {
    const auto signal = static_cast<double>(row[j]);
    sum += signal;
    if (signal > largest)
      second = std::exchange(largest, signal);
    else
      second = std::max(second, signal);
  }
  if (problem.model == CommunicationModel::cooperative) return problem.redundant ? sum - largest : sum;
  return problem.redundant ? second : largest;
}

std::vector<std::uint32_t> misses_of(const StateTable& states, const PlacementProblem& problem,
                                     std::span<const std::uint32_t> selected) {
  std::vector<std::uint32_t> misses(states.table.rows(), 0);
  for (std::size_t i = 0; i < misses.size(); ++i) {
    const double requirement = requirement_of(states.table.labels[i], problem.model);
    for (std::size_t s = 0; s < states.states; ++s)
      if (!is_met(received_signal(states.row(i, s), selected, problem), requirement)) ++misses[i];
  }
  return misses;
}

std::uint32_t allowed_misses(double availability, std::size_t states) {
  constexpr double rounding = 1e-9;
  return static_cast<std::uint32_t>(std::floor((1 - availability) * static_cast<double>(states) + rounding));
}

// P(N > k) of the binomial distribution, term by term in logarithms.
std::uint32_t widened_misses(double availability, std::size_t states, double level) {
  const auto count = static_cast<double>(states);
  const double miss = 1 - availability;
  if (miss <= 0 || states == 0) return 0;
  if (availability <= 0) return static_cast<std::uint32_t>(states);
  double below = 0;  // P(N <= k)
  for (std::uint32_t k = 0; k < states; ++k) {
    below += std::exp(std::lgamma(count + 1) - std::lgamma(k + 1.0) - std::lgamma(count - k + 1) +
                      k * std::log(miss) + (count - k) * std::log(availability));
    if (1 - below <= level) return k;
  }
  return static_cast<std::uint32_t>(states);
}

}  // namespace shelfbeam
