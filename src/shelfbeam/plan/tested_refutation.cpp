#include "shelfbeam/plan/tested_refutation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/plan/validation_estimates.hpp"
#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

namespace {

// Totals of clipped entries alone are 1 up to rounding.
constexpr double below_one = 1 - 1e-9;
constexpr double share_of_rare = 0.1;
// A leaf that its weights do not refute has these many more chances, with this share of the level.
constexpr std::size_t max_others = 4;
constexpr double share_of_others = 0.2;
constexpr std::uint32_t batches_at_once = 16;
// Splitting so many open leaves takes longer than testing them again, with one of these multiples of the
// batches.
constexpr std::size_t many_leaves = 32;
constexpr double multiples[] = {1.0, 1.4, 2.0, 2.8, 4.0};

// The estimates of one set of weights: x_j, and for each column in descending order of planned signal the sum
// from it to the last.
struct WeightedSums {
  std::vector<ValidationEstimate> column, tail;
  std::vector<double> largest;  ///< value of a batch, by column
  std::vector<std::uint32_t> order;
  double largest_sum = 0;  ///< of all columns, in a batch
};

// The number of equal batches, all others being 0, with this skewness: one to three if an error is flagged.
std::uint32_t peaks_of(const SkewedMoments& sampled) {
  const double skewness = sampled.skewness();
  const double share = (1 - skewness / std::hypot(skewness, 2.0)) / 2;
  return static_cast<std::uint32_t>(std::max(1.0, std::round(share * static_cast<double>(sampled.count()))));
}

class Test {
 public:
  Test(const Refutation& refutation, const SignalTable& planned)
      : tree_(refutation), columns_(planned.columns()), requirement_(refutation.labels.size()) {
    for (std::size_t k = 0; k < requirement_.size(); ++k)
      requirement_[k] = planned.labels[tree_.labels[k]].requirement;
    entries_.resize(tree_.labels.size() * columns_);
    for (const Refutation::Weights& weights : tree_.weights) {
      std::vector<double> value(columns_, 0.0);
      for (std::size_t k = 0; k < weights.rows.size(); ++k)
        for (const SignalEntry& entry : planned.row(tree_.labels[weights.rows[k]]))
          value[entry.transceiver] += weights.weight[k] * entry.signal / requirement_[weights.rows[k]];
      sums_.push_back({std::vector<ValidationEstimate>(columns_), std::vector<ValidationEstimate>(columns_),
                       std::vector<double>(columns_, 0.0),
                       ordered_by(columns_, [&](std::uint32_t j) { return -value[j]; })});
    }
  }

  // Adds batches: values by label, batch and column.
  void add(std::span<const double> values, std::uint32_t batches) {
    parallel_for_ranges(sums_.size(), [&](std::size_t first, std::size_t last) {
      std::vector<double> x(columns_);
      for (std::size_t w = first; w < last; ++w)
        for (std::uint32_t b = 0; b < batches; ++b) {
          weigh(
              tree_.weights[w],
              [&](std::size_t row) {
                return values.subspan((row * batches_at_once + b) * columns_, columns_);
              },
              0, x);
          for (std::size_t j = 0; j < columns_; ++j) {
            take(sums_[w].column[j], x[j]);
            sums_[w].largest[j] = std::max(sums_[w].largest[j], x[j]);
          }
          add_tails(sums_[w], x, [](ValidationEstimate& tail, double sum) { take(tail, sum); });
          sums_[w].largest_sum = std::max(sums_[w].largest_sum, std::accumulate(x.begin(), x.end(), 0.0));
        }
    });
    parallel_for_ranges(tree_.labels.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row)
        for (std::uint32_t b = 0; b < batches; ++b)
          for (std::size_t j = 0; j < columns_; ++j)
            take(entries_[row * columns_ + j], values[(row * batches_at_once + b) * columns_ + j]);
    });
  }

  // Adds the exact parts: analytic direct light by label and column, and clipped entries.
  void add_known(std::span<const float> known) {
    std::vector<double> values(known.begin(), known.end()), x(columns_);
    for (std::size_t k = 0; k < entries_.size(); ++k) entries_[k].known = values[k];
    for (std::size_t w = 0; w < sums_.size(); ++w) {
      weigh(
          tree_.weights[w],
          [&](std::size_t row) { return std::span<const double>(values).subspan(row * columns_, columns_); },
          1, x);
      for (std::size_t j = 0; j < columns_; ++j) sums_[w].column[j].known = x[j];
      add_tails(sums_[w], x, [](ValidationEstimate& tail, double sum) { tail.known = sum; });
    }
  }

  std::vector<Refutation::Leaf> open_leaves(double level) const {
    const auto limits = limits_of_all((1 - share_of_others) * level);
    const auto limits_of_others = limits_of_all(share_of_others / max_others * level);
    std::vector<char> is_open(tree_.leaves.size(), 0);
    parallel_for_ranges(tree_.leaves.size(), [&](std::size_t first, std::size_t last) {
      LeafTotal total(tree_.limit, tree_.mounts);
      for (std::size_t k = first; k < last; ++k) {
        const Refutation::Leaf& leaf = tree_.leaves[k];
        const auto is_refuted = [&](std::uint32_t w, const std::vector<std::vector<double>>& limit) {
          return total(leaf.chosen, leaf.free, limit[w]) < below_one;
        };
        if (is_refuted(leaf.weights, limits)) continue;
        const std::vector<std::uint32_t> others = other_weights(leaf, total);
        is_open[k] = std::none_of(others.begin(), others.end(),
                                  [&](std::uint32_t w) { return is_refuted(w, limits_of_others); });
      }
    });
    std::vector<Refutation::Leaf> open;
    for (std::size_t k = 0; k < is_open.size(); ++k)
      if (is_open[k] != 0) open.push_back(tree_.leaves[k]);
    return open;
  }

  // The factor by which the number of batches must grow before the next test is likely to refute the leaves
  // with their own weights; infinity above the largest multiple.
  double needed_multiple(const std::vector<Refutation::Leaf>& leaves, double level) const {
    const double next_level = (1 - share_of_others) * level / 2;
    std::vector<char> is_used(sums_.size(), 0);
    for (const Refutation::Leaf& leaf : leaves) is_used[leaf.weights] = 1;
    std::vector<std::vector<double>> present(sums_.size()), student(sums_.size()), limits(sums_.size());
    parallel_for_ranges(sums_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t w = first; w < last; ++w) {
        if (is_used[w] == 0) continue;
        present[w] = limits_of(sums_[w], next_level);
        for (const ValidationEstimate& own : sums_[w].column)
          student[w].push_back(own.upper((1 - share_of_rare) * next_level));
      }
    });
    LeafTotal total(tree_.limit, tree_.mounts);
    const auto refutes = [&](double multiple) {
      for (std::size_t w = 0; w < sums_.size(); ++w)
        if (is_used[w] != 0) limits[w] = expected_limits(sums_[w], present[w], student[w], multiple);
      return std::all_of(leaves.begin(), leaves.end(), [&](const Refutation::Leaf& leaf) {
        return total(leaf.chosen, leaf.free, limits[leaf.weights]) < below_one;
      });
    };
    if (!refutes(*std::rbegin(multiples))) return std::numeric_limits<double>::infinity();
    return *std::find_if(std::begin(multiples), std::prev(std::end(multiples)), refutes);
  }

  std::vector<ValidationRow> rows(std::uint32_t batches, std::uint64_t samples_per_batch) const {
    std::vector<ValidationRow> rows;
    for (std::size_t k = 0; k < tree_.labels.size(); ++k) {
      ValidationRow row{tree_.labels[k], {}, {}, {}, batches, batches * samples_per_batch};
      for (std::size_t j = 0; j < columns_; ++j) {
        const ValidationEstimate& entry = entries_[k * columns_ + j];
        row.mean.push_back(entry.mean());
        row.standard_error.push_back(entry.sampled.standard_error());
        row.flags.push_back(entry.sampled.is_skewed() ? 1 : 0);
      }
      rows.push_back(std::move(row));
    }
    return rows;
  }

 private:
  std::vector<std::vector<double>> limits_of_all(double level) const {
    std::vector<std::vector<double>> limits(sums_.size());
    parallel_for_ranges(sums_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t w = first; w < last; ++w) limits[w] = limits_of(sums_[w], level);
    });
    return limits;
  }

  // The other weights with the smallest planned totals for the leaf. They do not depend on the batches.
  std::vector<std::uint32_t> other_weights(const Refutation::Leaf& leaf, LeafTotal& total) const {
    std::vector<std::pair<double, std::uint32_t>> others;
    for (std::uint32_t w = 0; w < tree_.planned.size(); ++w) {
      if (w == leaf.weights) continue;
      const double planned = total(leaf.chosen, leaf.free, tree_.planned[w]);
      if (planned < below_one) others.emplace_back(planned, w);
    }
    std::sort(others.begin(), others.end());
    std::vector<std::uint32_t> best;
    for (std::size_t k = 0; k < std::min(max_others, others.size()); ++k) best.push_back(others[k].second);
    return best;
  }

  static void take(ValidationEstimate& estimate, double value) {
    estimate.sampled.add(value);
    if (value != 0) ++estimate.hits;
  }

  // x_j of some values by row; clipped entries count `clipped`.
  template <class Row>
  void weigh(const Refutation::Weights& weights, const Row& row_of, double clipped,
             std::vector<double>& x) const {
    std::fill(x.begin(), x.end(), 0.0);
    for (std::size_t k = 0; k < weights.rows.size(); ++k) {
      const std::size_t row = weights.rows[k];
      const std::vector<bool>& is_clipped = tree_.is_clipped[row];
      const std::span<const double> values = row_of(row);
      const double weight = weights.weight[k], share = weight / requirement_[row];
      for (std::size_t j = 0; j < columns_; ++j) x[j] += is_clipped[j] ? weight * clipped : share * values[j];
    }
  }

  template <class Take>
  static void add_tails(WeightedSums& sums, const std::vector<double>& x, const Take& take_sum) {
    double sum = 0;
    for (std::size_t k = sums.order.size(); k-- > 0;) take_sum(sums.tail[k], sum += x[sums.order[k]]);
  }

  // Whether the limit of a column is that of a longer sum.
  static bool is_rarely_hit(const ValidationEstimate& own) {
    return own.hits < ValidationEstimate::min_hits && own.hits < own.sampled.count();
  }

  std::vector<double> limits_of(const WeightedSums& sums, double level) const {
    const double of_column = (1 - share_of_rare) * level,
                 of_tail = share_of_rare * level / static_cast<double>(columns_);
    std::vector<double> limit(columns_);
    double of_sum = 0;  // sampled part of the shortest tail with the column that was hit often enough
    for (std::size_t k = 0; k < columns_; ++k) {
      const ValidationEstimate& tail = sums.tail[k];
      const ValidationEstimate& own = sums.column[sums.order[k]];
      if (!tail.is_rare())
        of_sum = std::max(0.0, tail.upper(of_tail) - tail.known);
      else if (k == 0)
        of_sum = tail.rare_upper(of_tail, sums.largest_sum, 1) - tail.known;
      double& upper = limit[sums.order[k]];
      upper = own.upper(of_column);
      if (is_rarely_hit(own))
        upper = std::max(upper, own.known + of_sum);
      else if (own.sampled.is_skewed() && own.sampled.skewness() > 0)
        upper = std::max(upper, own.mean() + success_probability_upper_limit(peaks_of(own.sampled),
                                                                             own.sampled.count(), of_column) *
                                                 2 * sums.largest[sums.order[k]]);
    }
    return limit;
  }

  // Limits that a multiple of the batches is likely to give: Student's fall with the root of the number of
  // batches, those for outliers with the number. Rarely hit columns keep theirs.
  static std::vector<double> expected_limits(const WeightedSums& sums, std::vector<double> limit,
                                             const std::vector<double>& student, double multiple) {
    for (std::size_t j = 0; j < limit.size(); ++j) {
      const ValidationEstimate& own = sums.column[j];
      if (is_rarely_hit(own)) continue;
      const double mean = own.mean();
      limit[j] = mean + std::max((student[j] - mean) / std::sqrt(multiple), (limit[j] - mean) / multiple);
    }
    return limit;
  }

  const Refutation& tree_;
  std::size_t columns_;
  std::vector<double> requirement_;
  std::vector<WeightedSums> sums_;           ///< by weights
  std::vector<ValidationEstimate> entries_;  ///< by label and column
};

}  // namespace

TestedRefutation test_refutation(const PreparedScene& prepared, const Refutation& refutation,
                                 const SignalTable& planned, BatchRequest request, double level,
                                 const Deadline& deadline, const RunControl& control) {
  const ThreadLimit allowed(control.threads);
  Test test(refutation, planned);
  request.labels = refutation.labels;
  const std::uint32_t batches = request.batches;
  const std::size_t n = planned.columns();
  std::vector<double> values(refutation.labels.size() * batches_at_once * n);
  std::vector<std::uint32_t> taken(refutation.labels.size());
  BatchRun run;
  std::uint32_t done = 0;
  while (done < batches && (done < Rounds::min_batches || !deadline.has_passed())) {
    request.first = done;
    request.batches = std::min(batches_at_once, batches - done);
    std::fill(taken.begin(), taken.end(), 0U);
    run = sample_batches(
        prepared, request,
        [&](const BatchRow& row) {
          const std::size_t at = (row.label * batches_at_once + taken[row.label]++) * n;
          std::copy(row.values.begin(), row.values.end(), values.begin() + static_cast<std::ptrdiff_t>(at));
        },
        control);
    with_threads(control.threads, [&] { test.add(values, request.batches); });
    done += request.batches;
  }
  test.add_known(run.known);
  TestedRefutation tested;
  with_threads(control.threads, [&] {
    tested.open = test.open_leaves(level);
    if (tested.open.size() >= many_leaves) tested.needed = done * test.needed_multiple(tested.open, level);
  });
  tested.fresh = test.rows(done, run.samples_per_batch);
  return tested;
}

}  // namespace shelfbeam
