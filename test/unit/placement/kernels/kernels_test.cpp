// The vectorised kernels agree with plain loops in double precision, for every rule and number of rows.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/kernels/coverage_kernels.hpp"
#include "shelfbeam/placement/kernels/search_kernels.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"

namespace shelfbeam::detail {
namespace {

using Floats = std::vector<float>;

// Multiples of 1/64 below 2: their sums and products by small numbers are exact, so that no kernel_rounding
// decides a comparison.
class KernelRows {
 public:
  explicit KernelRows(unsigned seed) : random_(seed) {
    count = SearchMatrix::block * std::uniform_int_distribution<std::size_t>(1, 20)(random_);
  }
  Floats next() {
    Floats values(count);
    for (float& value : values)
      value =
          chance(0.3) ? 0.0F : static_cast<float>(std::uniform_int_distribution<int>(0, 127)(random_)) / 64;
    return values;
  }
  bool chance(double p) { return std::bernoulli_distribution(p)(random_); }

  std::size_t count = 0;

 private:
  std::mt19937 random_;
};

constexpr int kernel_cases = 200;
constexpr double kernel_rounding = 1e-5;  // of a sum of up to 320 numbers below 4

void expect_kernel_sum(double sum, float found) {
  EXPECT_NEAR(found, sum, kernel_rounding * std::max(1.0, std::abs(sum)));
}

// Three chosen columns, the first of which is exchanged for another.
struct KernelExchange {
  explicit KernelExchange(KernelRows& rows, bool redundant)
      : columns{rows.next(), rows.next(), rows.next()},
        in(rows.next()),
        sum(rows.count),
        best(rows.count),
        second(rows.count) {
    for (const Floats& column : columns) {
      for (std::size_t i = 0; i < rows.count; ++i) sum[i] += column[i];
      SearchKernels::receive(Receiving::second_best, column.data(), rows.count, second.data(), best.data());
    }
    if (redundant)
      held = {sum.data(), best.data(), second.data()};
    else
      held = {sum.data(), nullptr, nullptr};
  }
  // The signal of a row afterwards, from the columns themselves.
  double after(std::size_t i) const {
    const double a = in[i], b = columns[1][i], c = columns[2][i];
    return a + b + c - (held.best != nullptr ? std::max({a, b, c}) : 0.0);
  }

  std::vector<Floats> columns;
  Floats in, sum, best, second;
  SearchKernels::Held held{};
};

TEST(SearchKernels, SecondBestKeepsTheTwoLargestSignals) {
  for (unsigned seed = 0; seed < kernel_cases; ++seed) {
    KernelRows rows(seed);
    const KernelExchange exchange(rows, true);
    for (std::size_t i = 0; i < rows.count; ++i) {
      std::vector<float> sorted;
      for (const Floats& column : exchange.columns) sorted.push_back(column[i]);
      std::sort(sorted.rbegin(), sorted.rend());
      ASSERT_EQ(exchange.best[i], sorted[0]);
      ASSERT_EQ(exchange.second[i], sorted[1]);
    }
  }
}

TEST(SearchKernels, LackAndMissedWeightAfterAnExchange) {
  for (unsigned seed = 0; seed < kernel_cases; ++seed) {
    KernelRows rows(1000 + seed);
    const KernelExchange exchange(rows, rows.chance(0.5));
    const Floats weight = rows.next();
    const float demand = rows.chance(0.5) ? 1.0F : 2.5F;
    double lack = 0, missed = 0;
    for (std::size_t i = 0; i < rows.count; ++i) {
      lack += std::max(0.0, demand - exchange.after(i));
      missed += exchange.after(i) < demand ? weight[i] : 0.0F;
    }
    const float* const out = exchange.columns[0].data();
    const float* const in = exchange.in.data();
    expect_kernel_sum(lack, SearchKernels::lack_after(exchange.held, out, in, demand, rows.count));
    expect_kernel_sum(missed,
                      SearchKernels::missed_after(exchange.held, out, in, demand, weight.data(), rows.count));
  }
}

TEST(SearchKernels, WorthAndLossAreTheChangesOfTheClippedSum) {
  for (unsigned seed = 0; seed < kernel_cases; ++seed) {
    KernelRows rows(2000 + seed);
    const Floats column = rows.next(), weight = rows.next(), rest = rows.next();
    Floats with_column = rest;
    SearchKernels::exchange(Floats(rows.count).data(), column.data(), rows.count, with_column.data());
    const float demand = 1.25F;
    double gain = 0;
    for (std::size_t i = 0; i < rows.count; ++i)
      gain += static_cast<double>(weight[i]) * (std::min(demand, with_column[i]) - std::min(demand, rest[i]));
    expect_kernel_sum(gain,
                      SearchKernels::worth(column.data(), weight.data(), rest.data(), demand, rows.count));
    expect_kernel_sum(
        gain, SearchKernels::loss(column.data(), weight.data(), with_column.data(), demand, rows.count));
  }
}

TEST(CoverageKernels, SharesAndReachedWeight) {
  for (unsigned seed = 0; seed < kernel_cases; ++seed) {
    KernelRows rows(3000 + seed);
    const Floats column = rows.next(), shift = rows.next(), scale = rows.next(), weight = rows.next();
    const auto share = [&](std::size_t i) {
      return std::min(1.0, std::max(0.0, static_cast<double>(column[i]) - shift[i]) * scale[i]);
    };
    const CoverageKernels::Shares shares{shift.data(), scale.data(), rows.count};
    Floats sum(rows.count, 1.0F);
    CoverageKernels::add(column.data(), shares, sum.data());
    double value = 0, reached = 0;
    for (std::size_t i = 0; i < rows.count; ++i) {
      ASSERT_NEAR(sum[i], 1 + share(i), kernel_rounding);
      value += weight[i] * share(i);
      reached += column[i] >= shift[i] ? weight[i] : 0.0F;
    }
    expect_kernel_sum(value, CoverageKernels::value(column.data(), shares, weight.data()));
    expect_kernel_sum(reached,
                      CoverageKernels::reached(column.data(), shift.data(), weight.data(), rows.count));
  }
}

TEST(CoverageKernels, LiftedRowsOfALabel) {
  for (unsigned seed = 0; seed < kernel_cases; ++seed) {
    KernelRows rows(4000 + seed);
    const std::size_t entries = rows.count - seed % SearchMatrix::block;
    const Floats signal = rows.next();
    Floats chosen = rows.next();
    std::fill(chosen.begin() + static_cast<std::ptrdiff_t>(entries), chosen.end(), 0.0F);
    const CoverageKernels::Lifted lifted{{0, 0.25F, 0.5F, 1}, {1, 1.5F, 2, 4}};
    float sum[CoverageKernels::lifted_rows];
    CoverageKernels::sums(signal.data(), chosen.data(), entries, lifted, sum);
    for (std::size_t d = 0; d < CoverageKernels::lifted_rows; ++d) {
      Floats value(rows.count);
      CoverageKernels::lift(signal.data(), entries, lifted, d, value.data());
      double expected = 0;
      for (std::size_t j = 0; j < entries; ++j) {
        const double share =
            std::min(1.0, std::max(0.0, static_cast<double>(signal[j]) - lifted.shift[d]) * lifted.scale[d]);
        ASSERT_NEAR(value[j], share, kernel_rounding);
        expected += share * chosen[j];
      }
      expect_kernel_sum(expected, sum[d]);
    }
  }
}

}  // namespace
}  // namespace shelfbeam::detail
