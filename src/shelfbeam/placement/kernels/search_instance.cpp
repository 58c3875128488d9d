#include "shelfbeam/placement/kernels/search_instance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "shelfbeam/placement/kernels/search_kernels.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam::detail {

namespace {

// Ratios are capped here, so that sums stay finite.
constexpr float largest = 1e6F;
// The largest float below 1, for links that fail the rule by less than rounding.
constexpr float just_short = 1 - std::numeric_limits<float>::epsilon() / 2;

std::vector<std::uint32_t> all_rows(const SignalTable& table) {
  std::vector<std::uint32_t> rows(table.rows());
  std::iota(rows.begin(), rows.end(), 0U);
  return rows;
}

}  // namespace

SearchMatrix::SearchMatrix(const SignalTable& table, CommunicationModel model,
                           std::vector<std::uint32_t> rows)
    : rows_(std::move(rows)),
      padded_((rows_.size() + block - 1) / block * block),
      columns_(table.columns()),
      values_(padded_ * columns_, 0.0F) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double requirement = requirement_of(table.labels[rows_[i]], model);
    for (const SignalEntry& entry : table.row(rows_[i])) {
      float& value = values_[entry.transceiver * padded_ + i];
      value = static_cast<float>(std::min(entry.signal / requirement, static_cast<double>(largest)));
      if (model == CommunicationModel::non_cooperative && !is_met(entry.signal, requirement))
        value = std::min(value, just_short);
    }
  }
}

SearchMatrix::SearchMatrix(const SignalTable& table, CommunicationModel model)
    : SearchMatrix(table, model, all_rows(table)) {}

Receiving receiving(const PlacementProblem& problem) {
  if (problem.model == CommunicationModel::cooperative)
    return problem.redundant ? Receiving::sum_without_best : Receiving::sum;
  return problem.redundant ? Receiving::second_best : Receiving::best;
}

Margin margin_of(const SignalTable& table, const PlacementProblem& problem, const SearchMatrix& all,
                 std::span<const std::uint32_t> selected, std::vector<float>& received) {
  Margin margin{std::numeric_limits<double>::infinity(), 0, true};
  received.assign(2 * all.padded_rows(), 0.0F);
  const Receiving rule = receiving(problem);
  float* const value = received.data();
  float* const best = received.data() + all.padded_rows();
  for (const std::uint32_t j : selected)
    SearchKernels::receive(rule, all.column(j), all.padded_rows(), value, best);
  float smallest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < all.rows(); ++i) smallest = std::min(smallest, received[i]);
  std::vector<bool> chosen(table.columns(), false);
  for (const std::uint32_t j : selected) chosen[j] = true;
  double of_unmet = std::numeric_limits<double>::infinity();
  // These rows include the smallest margin in double precision, and a missed label if there is any. (Capped
  // ratios cannot be told apart.)
  const float lowest = smallest < largest / 10 ? smallest * (1 + 5 * static_cast<float>(search_tolerance))
                                               : std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < all.rows(); ++i) {
    if (received[i] > lowest) continue;
    const double requirement = requirement_of(table.labels[i], problem.model);
    const double signal = received_signal(table, i, chosen, problem);
    const double ratio = signal / requirement;
    const bool met = is_met(signal, requirement);
    // One of two labels with equal rounded ratios may be reached. The missed label is reported.
    if (margin.is_met ? !met || ratio < margin.smallest : !met && ratio < of_unmet) margin.label = i;
    if (!met) of_unmet = std::min(of_unmet, ratio);
    margin.is_met = margin.is_met && met;
    margin.smallest = std::min(margin.smallest, ratio);
  }
  return margin;
}

SearchInstance::SearchInstance(const SignalTable& t, const PlacementProblem& q)
    : table(t), problem(q), excludes(t.columns()), available(t.columns(), true) {
  const std::vector<double> coefficients =
      q.combination == Combination::weighted ? first_objective(t, q) : objective_coefficients(t, q);
  const double largest_coefficient =
      coefficients.empty() ? 0 : *std::max_element(coefficients.begin(), coefficients.end());
  constexpr double bits = 60;  // of the cost of all columns together
  if (largest_coefficient > 0)
    cost_unit = std::exp2(
        std::ceil(std::log2(largest_coefficient) + std::log2(static_cast<double>(t.columns()))) - bits);
  for (const double coefficient : coefficients) cost.push_back(std::llround(coefficient / cost_unit));
  has_costs = std::any_of(cost.begin(), cost.end(), [](std::int64_t c) { return c != 0; });
  std::vector<std::uint32_t> by_id(t.columns());
  std::iota(by_id.begin(), by_id.end(), 0U);
  std::stable_sort(by_id.begin(), by_id.end(), [&](std::uint32_t a, std::uint32_t b) {
    return t.transceivers[a].id < t.transceivers[b].id;
  });
  rank_by_id.resize(t.columns());
  for (std::uint32_t k = 0; k < by_id.size(); ++k) rank_by_id[by_id[k]] = k;
  const Mounts mounts(t);
  for (std::uint32_t j = 0; j < t.columns(); ++j) {
    mounts.for_each_conflict(j, [&](std::uint32_t other) { excludes[j].push_back(other); });
    available[j] = mounts.available(j) && !t.transceivers[j].installed;
    if (t.transceivers[j].installed) installed.push_back(j);
  }
}

bool SearchInstance::can_exchange(std::span<const std::uint32_t> selected) const {
  const auto candidates = std::count(available.begin(), available.end(), true);
  const auto chosen =
      std::count_if(selected.begin(), selected.end(), [&](std::uint32_t j) { return available[j]; });
  return 0 < chosen && chosen < candidates;
}

bool SearchInstance::is_first_by_id(std::span<const std::uint32_t> a,
                                    std::span<const std::uint32_t> b) const {
  const auto mounting_points = [&](std::span<const std::uint32_t> selected) {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t j : selected) result.push_back(rank_by_id[j]);
    std::sort(result.begin(), result.end());
    return result;
  };
  return mounting_points(a) < mounting_points(b);
}

}  // namespace shelfbeam::detail
