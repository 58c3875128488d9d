#include "shelfbeam/plan/optimism.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shelfbeam/plan/decisive_rows.hpp"
#include "shelfbeam/plan/fresh_sums.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

namespace {

// Every entry has a limit of its own, one of a sum, and one of a rare sum.
constexpr double limits_an_entry = 3;

// The columns of a row, the strongest first.
std::vector<std::uint32_t> by_strength(const SignalTable& planned, std::uint32_t row) {
  std::vector<double> signal(planned.columns(), 0.0);
  for (const SignalEntry& entry : planned.row(row)) signal[entry.transceiver] = entry.signal;
  std::vector<std::uint32_t> order(planned.columns());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return signal[a] > signal[b]; });
  return order;
}

// `sums` has the columns of a row in order, then for each the sum from there on.
void add_limits(SignalTable& table, std::span<const FreshSum> sums, const std::vector<std::uint32_t>& order,
                double level, double largest, double requirement) {
  const std::size_t n = order.size();
  std::vector<double> limit(n);
  double of_sum = 0;  // of what is sampled of the shortest sum that was hit often enough and has entry k
  for (std::size_t k = 0; k < n; ++k) {
    const FreshSum& own = sums[k];
    const FreshSum& sum = sums[n + k];
    if (!sum.is_rare())
      of_sum = std::max(0.0, sum.upper(level) - sum.known);
    else if (k == 0)
      of_sum = sum.rare_upper(level, largest, requirement) - sum.known;
    limit[order[k]] = own.is_rare() ? own.known + of_sum : own.upper(level);
  }
  for (std::uint32_t j = 0; j < n; ++j)
    if (limit[j] > 0) table.entries.push_back({j, limit[j]});
  table.row_begin.push_back(table.entries.size());
}

}  // namespace

OptimisticRows optimistic_rows(const Scene& scene, const SignalTable& planned,
                               const std::vector<std::uint32_t>& rows, double level,
                               const VerificationEffort& effort, const RunControl& control) {
  const std::size_t n = planned.columns();
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0U);
  std::vector<std::vector<std::uint32_t>> orders;
  orders.reserve(rows.size());
  for (const std::uint32_t i : rows) orders.push_back(by_strength(planned, i));
  const SumRule rule = [&](std::size_t label, std::span<const double> signals, std::span<double> sums) {
    double sum = 0;
    for (std::size_t k = n; k-- > 0;) {
      sums[k] = signals[orders[label][k]];
      sums[n + k] = sum += sums[k];
    }
  };
  SimulationOptions options = effort.simulation;
  options.seed = effort.seed;
  const FreshSums fresh = fresh_sums(sub_scene(scene, rows, all), options,
                                     std::max(effort.batches, least_verifying_batches), 2 * n, rule, control);
  OptimisticRows result{table_of_rows(planned, rows), {}};
  result.table.entries.clear();
  result.table.row_begin = {0};
  // P(any limit is too low) <= 3 r n (level / (3 r n)), for r rows and n columns (Bonferroni).
  const double of_one = level / (limits_an_entry * static_cast<double>(n) *
                                 static_cast<double>(std::max<std::size_t>(1, rows.size())));
  for (std::size_t k = 0; k < rows.size(); ++k)
    add_limits(result.table, fresh.of(k), orders[k], of_one, fresh.largest,
               result.table.labels[k].requirement);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    FreshRow row{rows[k],
                 std::vector<double>(n),
                 std::vector<double>(n),
                 std::vector<std::uint8_t>(n),
                 fresh.batches,
                 fresh.batches * fresh.samples_per_batch};
    for (std::size_t c = 0; c < n; ++c) {
      const FreshSum& sum = fresh.of(k)[c];
      row.mean[orders[k][c]] = sum.mean();
      row.standard_error[orders[k][c]] = sum.sampled.standard_error();
      row.flags[orders[k][c]] = sum.is_skewed() ? 1 : 0;
    }
    result.fresh.push_back(std::move(row));
  }
  return result;
}

SignalTable expected_optimism(const SignalTable& planned, const SignalMatrix& matrix, std::size_t rows,
                              double level, std::uint32_t batches) {
  const double statements = limits_an_entry * static_cast<double>(planned.columns()) *
                            static_cast<double>(std::max<std::size_t>(1, rows));
  const double quantile = student_quantile(1 - level / statements, batches - 1);
  constexpr double reserve = 1.1;  // the fresh errors may come out larger
  SignalTable table = planned;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double fewer = std::sqrt(static_cast<double>(matrix.labels[i].batches) / batches);
    for (std::size_t e = table.row_begin[i]; e < table.row_begin[i + 1]; ++e) {
      SignalEntry& entry = table.entries[e];
      const auto error = static_cast<double>(matrix.standard_error[matrix.at(i, entry.transceiver)]);
      entry.signal += reserve * quantile * error * fewer;
    }
  }
  return table;
}

}  // namespace shelfbeam
