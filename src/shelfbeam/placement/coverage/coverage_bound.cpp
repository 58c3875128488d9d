#include "shelfbeam/placement/coverage/coverage_bound.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/bound/ascent.hpp"
#include "shelfbeam/placement/bound/dual_bound.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam {

namespace {

using detail::CoverageKernels;

// Of the signals of all k units together, k d, in requirements.
constexpr std::array<double, CoverageKernels::lifted_rows> omitted{0.0, 0.3, 0.6, 0.95};
constexpr std::size_t max_parts = 16, min_entries_of_part = 20'000;

}  // namespace

CoverageBound::CoverageBound(const detail::Instance& instance, const detail::LabelWeights& weights,
                             std::size_t max_units)
    : instance_(instance), weights_(weights), chosen_(instance.columns(), 0.0F) {
  const Mounts& mounts = instance.mounts;
  for (std::uint32_t j = 0; j < instance.columns(); ++j)
    if (mounts.available(j)) chosen_[j] = 1;
  if (!instance.is_cooperative()) lifted_rows_ = 1;
  const detail::CoverRows cover(instance);
  for (std::uint32_t i = 0; i < instance.rows(); ++i) {
    if (weights[i] <= 0 || !mounts.may_meet(instance.row(i), instance.requirement(i), instance.problem))
      continue;
    cover.for_entries(i, [&](std::uint32_t j, double a) {
      if (!mounts.available(j)) return;
      column_.push_back(j);
      share_.push_back(static_cast<float>(a));
    });
    max_row_ = std::max(max_row_, column_.size() - row_begin_.back());
    row_begin_.push_back(column_.size());
    label_.push_back(i);
    weight_.push_back(weights[i]);
    reachable_ += weights[i];
  }
  best_.assign(max_units + 1, reachable_);
  min_share_sum_.resize(label_.size());
  share_.resize(share_.size() + detail::SearchMatrix::block, 0.0F);
  const std::size_t size = std::max(min_entries_of_part, column_.size() / max_parts + 1);
  for (std::size_t i = 0; i < rows(); ++i) {
    if (parts_.empty() || row_begin_[i] - row_begin_[parts_.back().first] >= size) parts_.push_back({i, i});
    parts_.back().last = i + 1;
  }
}

double CoverageBound::weight(std::size_t units) const {
  if (units < (instance_.problem.redundant ? 2U : 1U)) return 0;
  // The relative error of sums of m terms is below 1e-16 m.
  return weights_.rounded_down(best_[units]);
}

// Adds up body(row, sums of its part) and the sums by column, in the order of the parts.
template <class Body>
double CoverageBound::sum_over_parts(std::vector<double>& by_column, const Body& body) const {
  std::vector<PartSums> sums(parts_.size());
  for_each_task(parts_.size(), [&](std::size_t p) {
    const std::size_t padded = max_row_ + detail::SearchMatrix::block;
    sums[p] = {0, std::vector(instance_.columns(), 0.0), std::vector(padded, 0.0F),
               std::vector(padded, 0.0F)};
    for (std::size_t i = parts_[p].first; i < parts_[p].last; ++i) sums[p].total += body(i, sums[p]);
  });
  by_column.assign(instance_.columns(), 0.0);
  double total = 0;
  for (const PartSums& part : sums) {
    total += part.total;
    for (std::size_t j = 0; j < by_column.size(); ++j) by_column[j] += part.by_column[j];
  }
  return total;
}

// The rows of the relaxation with their multipliers give bounds for all numbers of units for which they are
// valid: all if only d = 0 is used, otherwise up to `units`.
void CoverageBound::evaluate(std::size_t units, std::span<const Multipliers> y) {
  const bool is_plain = std::all_of(y.begin(), y.end(), [](const Multipliers& of) {
    return std::all_of(of.begin() + 1, of.end(), [](float one) { return one == 0; });
  });
  const std::size_t last = is_plain ? best_.size() - 1 : units;
  const detail::CoverRows cover(instance_, last);
  std::vector<detail::BoundRow> rows;
  std::vector<double> multiplier;
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t d = 0; d < lifted_rows_; ++d) {
      const auto share = static_cast<double>(y[i][d]);
      if (!(share > 0)) continue;
      rows.push_back({.label = label_[i], .share = omitted[d] / static_cast<double>(units)});
      multiplier.push_back(weight_[i] * share / (d == 0 ? cover.bound(label_[i]) : 1));
    }
  const detail::BoundsByCount missed =
      bounds_by_count(instance_, dual_sums(instance_, rows, multiplier, last, weights_.of_labels()),
                      std::vector<double>(instance_.columns(), 0.0));
  // The allowance for rounding is nothing, if it is within the 1e-9 of the total up to which bounds hold.
  const double nothing = std::min(2 * missed.slack, 1e-9 * reachable_);
  for (std::size_t k = instance_.installed.size(); k <= last; ++k) {
    const double above = reachable_ - missed.at_most[k];
    best_[k] = std::min(best_[k], above <= nothing ? 0 : above);
  }
}

// The value of the relaxation at T and its slope. The minimal row of each label enters the mean y with
// `share_of_step`.
double CoverageBound::relax(std::size_t units, float share_of_step, std::vector<Multipliers>& y,
                            std::vector<double>& slope) const {
  return sum_over_parts(slope, [&](std::size_t i, PartSums& part) {
    CoverageKernels::Lifted rows{};
    for (std::size_t d = 0; d < y[i].size(); ++d) {
      rows.shift[d] = static_cast<float>(omitted[d] / static_cast<double>(units));
      rows.scale[d] = static_cast<float>(1 / (min_share_sum_[i] - omitted[d]));
    }
    const std::size_t begin = row_begin_[i], entries = row_begin_[i + 1] - begin;
    const float* const share = share_.data() + begin;
    for (std::size_t e = 0; e < entries; ++e) part.chosen[e] = chosen_[column_[begin + e]];
    std::fill_n(part.chosen.begin() + static_cast<std::ptrdiff_t>(entries), detail::SearchMatrix::block,
                0.0F);
    Multipliers sum{};
    CoverageKernels::sums(share, part.chosen.data(), entries, rows, sum.data());
    const auto least = static_cast<std::size_t>(
        std::min_element(sum.begin(), sum.begin() + static_cast<std::ptrdiff_t>(lifted_rows_)) - sum.begin());
    for (float& one : y[i]) one *= 1 - share_of_step;
    if (sum[least] >= 1) return weight_[i];
    y[i][least] += share_of_step;
    CoverageKernels::lift(share, entries, rows, least, part.lifted.data());
    for (std::size_t e = 0; e < entries; ++e)
      part.by_column[column_[begin + e]] += weight_[i] * static_cast<double>(part.lifted[e]);
    return weight_[i] * static_cast<double>(sum[least]);
  });
}

// Scales T so that it adds up to `units`, apart from mounting points at which it would exceed 1.
void CoverageBound::keep_to(std::size_t units) {
  std::vector<double> at_point(chosen_.size(), 0.0);
  for (std::uint32_t j = 0; j < chosen_.size(); ++j)
    if (!instance_.is_installed(j))
      at_point[instance_.mounts.first_option(j)] += static_cast<double>(chosen_[j]);
  double factor = 0;
  for (bool grows = true; grows;) {
    double full = 0, rest = 0;
    for (const double sum : at_point) (factor * sum >= 1 ? full : rest) += factor * sum >= 1 ? 1 : sum;
    const double next =
        rest > 0 ? (static_cast<double>(units - instance_.installed.size()) - full) / rest : factor;
    grows = next > factor * (1 + 1e-9);
    factor = std::max(factor, next);
  }
  for (std::uint32_t j = 0; j < chosen_.size(); ++j)
    if (const double sum = at_point[instance_.mounts.first_option(j)]; !instance_.is_installed(j) && sum > 0)
      chosen_[j] *= static_cast<float>(std::min(factor, 1 / sum));
}

// Mirror ascent, for `ascend`.
struct CoverageBound::Steps {
  CoverageBound& of;
  std::size_t units;
  double reached;
  CoverageAim aim;
  const detail::Effort& effort;
  const RunControl& control;
  std::vector<Multipliers> y;
  std::vector<double> slope = {};
  double steepest = 0, sum_of_shares = 0;
  double lowest = 0;  ///< the relaxation has no bound below this
  bool is_over = false, is_evaluated = false;
  std::size_t taken = 0;

  bool ends(std::size_t) const { return is_over; }

  bool move(double length) {
    constexpr float least = 1e-12F;
    if (!(steepest > 0)) return false;
    for (std::uint32_t j = 0; j < slope.size(); ++j)
      if (float& chosen = of.chosen_[j]; moves(j))
        chosen =
            std::max(least, chosen * static_cast<float>(std::exp(length * (slope[j] - steepest) / steepest)));
    of.keep_to(units);
    return true;
  }

  double evaluate(std::size_t) {
    constexpr std::size_t between_bounds = 25, max_steps = 2000;
    // Later steps count more.
    const auto weight = static_cast<double>(++taken);
    sum_of_shares += weight;
    const double value = of.relax(units, static_cast<float>(weight / sum_of_shares), y, slope);
    lowest = std::max(lowest, value);
    steepest = 0;
    for (std::uint32_t j = 0; j < slope.size(); ++j)
      if (moves(j)) steepest = std::max(steepest, slope[j]);
    is_over = taken + 1 >= std::min<std::uint64_t>(effort.steps, max_steps) || effort.is_over(control);
    is_evaluated = taken % between_bounds == 0;
    if (is_evaluated) raise();
    return value;
  }

  static double least_gain(double value) { return 1e-5 * value; }

  // Ends the steps if none of them can serve the aim.
  void raise() {
    constexpr double precision = 1e-6, worthwhile = 0.005;
    of.evaluate(units, y);
    const double bound = of.weight(units), floor = lowest * (1 - precision);
    const double best = of.weights_.rounded_down(floor);
    is_over = is_over || bound <= reached || bound - floor <= worthwhile * (bound - reached) ||
              best >= bound || (aim == CoverageAim::reached && best > reached);
  }

  bool moves(std::uint32_t j) const { return !of.instance_.is_installed(j) && of.chosen_[j] > 0; }
};

std::size_t CoverageBound::improve(std::size_t units, double reached, CoverageAim aim,
                                   const detail::Effort& effort, const RunControl& control) {
  if (units == 0 || effort.steps == 0 || weight(units) <= reached || control.cancelled()) return 0;
  std::vector<Multipliers> y(rows(), Multipliers{1});
  if (!std::exchange(has_plain_bounds_, true)) evaluate(units, y);
  if (units <= instance_.installed.size() || effort.steps == 1) return 1;
  keep_to(units);
  const detail::CoverRows cover(instance_, units);
  for (std::size_t i = 0; i < rows(); ++i) min_share_sum_[i] = cover.bound(label_[i]);
  Steps steps{*this, units, reached, aim, effort, control, std::move(y)};
  detail::ascend(steps, steps.evaluate(0), {.first = 0.5, .patience = 40});
  if (!steps.is_evaluated) steps.raise();
  return 1 + steps.taken;
}

}  // namespace shelfbeam
