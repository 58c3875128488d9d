#include "shelfbeam/report/data/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shelfbeam/report/data/scale.hpp"

namespace shelfbeam {

namespace {

void count(Bins& bins, double value) {
  const auto edge = std::upper_bound(bins.edges.begin(), bins.edges.end(), value);
  if (edge == bins.edges.begin())
    ++bins.below;
  else if (edge == bins.edges.end())
    ++bins.above;
  else
    ++bins.counts[static_cast<std::size_t>(edge - bins.edges.begin()) - 1];
}

}  // namespace

ExcessDistribution excess_distribution(const Outcome& outcome) {
  constexpr double wanted_bins = 24;
  std::vector<double> excess;
  for (const LabelOutcome& label : outcome.labels)
    if (label.requirement > 0) excess.push_back(100 * (label.signal - label.requirement) / label.requirement);
  if (excess.empty()) return {};

  ExcessDistribution result;
  result.median = quantile(excess, 0.5);
  result.mean = std::accumulate(excess.begin(), excess.end(), 0.0) / static_cast<double>(excess.size());
  const double least = *std::min_element(excess.begin(), excess.end());
  const double most = quantile(excess, 0.99);
  const double low = std::min(0.0, least), high = std::max(most, 1.0);
  const double width = round_step((high - low) / wanted_bins);
  // Whole multiples of the width, so that "requirement just met" is an edge.
  const auto first = static_cast<int>(std::floor(low / width + 1e-9));
  const auto last = std::max(first + 1, static_cast<int>(std::floor(high / width)) + 1);
  for (int k = first; k <= last; ++k) result.percent.edges.push_back(k * width);
  result.percent.counts.assign(result.percent.edges.size() - 1, 0);
  for (const double value : excess) count(result.percent, value);
  return result;
}

SignalDistribution signal_distribution(const SignalMatrix& matrix) {
  SignalDistribution result;
  result.entries = matrix.mean.size();
  double least = 0, most = 0;
  for (const float entry : matrix.mean) {
    const auto value = static_cast<double>(entry);
    if (value <= 0) {
      ++result.zeros;
      continue;
    }
    least = least == 0 ? value : std::min(least, value);
    most = std::max(most, value);
  }
  if (most == 0) return result;
  const auto last = static_cast<int>(std::floor(std::log10(most) * bins_per_decade)) + 1;
  const auto first = std::max(static_cast<int>(std::floor(std::log10(least) * bins_per_decade)),
                              last - signal_decades * bins_per_decade);
  for (int k = first; k <= last; ++k)
    result.signal.edges.push_back(std::pow(10, static_cast<double>(k) / bins_per_decade));
  result.signal.counts.assign(result.signal.edges.size() - 1, 0);
  for (const float entry : matrix.mean)
    if (entry > 0) count(result.signal, static_cast<double>(entry));
  return result;
}

}  // namespace shelfbeam
