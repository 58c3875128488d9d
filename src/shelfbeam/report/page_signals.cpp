#include "shelfbeam/report/page_signals.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "shelfbeam/report/page_data.hpp"

namespace shelfbeam {

namespace {

constexpr double most_code = 65535;

// What of a label's needs an entry is; labels that need nothing keep all of theirs.
float weight(float mean, double requirement) {
  if (requirement <= 0) return std::numeric_limits<float>::infinity();
  return static_cast<float>(std::abs(static_cast<double>(mean)) / requirement);
}

// A weight from which on there are `most` entries at most; 0 where all may stay. Positive floats are ordered
// as their bits are, so their upper bits are the bins of a histogram.
float least_weight(const SignalMatrix& matrix, std::size_t most) {
  constexpr unsigned dropped = 13;
  std::vector<std::size_t> bins((std::size_t{1} << (31U - dropped)) + 1, 0);
  std::size_t entries = 0;
  for (std::size_t i = 0; i < matrix.rows(); ++i)
    for (const float mean : matrix.mean_row(i)) {
      if (mean == 0) continue;
      ++entries;
      ++bins[std::bit_cast<std::uint32_t>(weight(mean, matrix.labels[i].requirement)) >> dropped];
    }
  if (entries <= most) return 0;
  std::size_t kept = 0, bin = bins.size();
  while (bin > 0 && kept + bins[bin - 1] <= most) kept += bins[--bin];
  // What needs nothing stays whatever there is room for.
  const std::uint32_t infinite =
      std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()) >> dropped;
  return std::bit_cast<float>(std::min(static_cast<std::uint32_t>(bin), infinite) << dropped);
}

// The columns of the two largest entries of the chosen units.
std::array<std::uint32_t, 2> two_largest(std::span<const float> row,
                                         const std::vector<std::uint32_t>& selected) {
  std::array<std::uint32_t, 2> largest{~0U, ~0U};
  const auto more = [&](std::uint32_t a, std::uint32_t b) { return b == ~0U || row[a] > row[b]; };
  for (const std::uint32_t j : selected) {
    if (more(j, largest[0]))
      largest = {j, largest[0]};
    else if (more(j, largest[1]))
      largest[1] = j;
  }
  return largest;
}

// A logarithmic scale from the least to the largest standard error above 0.
void set_error_scale(PageSignals& signals, const SignalMatrix& matrix) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const float error : matrix.standard_error)
    if (error > 0) {
      low = std::min(low, static_cast<double>(error));
      high = std::max(high, static_cast<double>(error));
    }
  if (high <= 0) return;
  signals.least_error = low;
  signals.error_step = std::log(high / low) / (most_code - 1);
}

std::uint16_t error_code(const PageSignals& signals, double error) {
  if (error <= 0) return 0;
  if (signals.error_step <= 0) return 1;
  return static_cast<std::uint16_t>(1 +
                                    std::lround(std::log(error / signals.least_error) / signals.error_step));
}

std::uint16_t share_code(double direct, double mean) {
  return mean > 0 ? static_cast<std::uint16_t>(std::lround(most_code * std::clamp(direct / mean, 0.0, 1.0)))
                  : 0;
}

struct Sums {
  double kept = 0, all = 0;
};

// Sums of the chosen units' entries as the question counts them.
Sums sums_of(const SignalMatrix& matrix, const Placement& placement, const std::vector<bool>& chosen,
             std::size_t label, const std::vector<bool>& is_kept) {
  const auto row = matrix.mean_row(label);
  std::vector<SignalEntry> all, kept;
  for (std::uint32_t j = 0; j < row.size(); ++j) {
    if (!chosen[j]) continue;
    all.push_back({j, static_cast<double>(row[j])});
    if (is_kept[j]) kept.push_back(all.back());
  }
  return {received_signal(kept, chosen, placement.question),
          received_signal(all, chosen, placement.question)};
}

}  // namespace

double PageSignals::error_of(std::uint16_t code) const {
  return code == 0 ? 0 : least_error * std::exp((code - 1) * error_step);
}

PageSignals page_signals(const SignalMatrix& matrix, const Placement& placement, std::size_t most) {
  PageSignals signals;
  const bool has_error = matrix.standard_error.size() == matrix.mean.size();
  const bool has_direct = matrix.direct.size() == matrix.mean.size();
  if (has_error) set_error_scale(signals, matrix);
  const float least = least_weight(matrix, most);
  std::vector<bool> chosen(matrix.columns(), false), is_kept(matrix.columns());
  for (const std::uint32_t j : placement.selected) chosen[j] = true;

  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const auto row = matrix.mean_row(i);
    const double requirement = matrix.labels[i].requirement;
    const auto largest = two_largest(row, placement.selected);
    std::uint32_t size = 0, next = 0;
    double effect = 0;
    for (std::uint32_t j = 0; j < row.size(); ++j) {
      is_kept[j] =
          row[j] != 0 && (weight(row[j], requirement) >= least || j == largest[0] || j == largest[1]);
      if (!is_kept[j]) {
        if (row[j] == 0) continue;
        const double share = std::abs(static_cast<double>(row[j])) / requirement;
        ++signals.left_out;
        effect += share;
        signals.largest_left_out = std::max(signals.largest_left_out, share);
        continue;
      }
      ++size;
      signals.gap.push_back(j - next);
      next = j + 1;
      signals.mean.push_back(row[j]);
      const std::size_t at = matrix.at(i, j);
      if (has_error)
        signals.error.push_back(error_code(signals, static_cast<double>(matrix.standard_error[at])));
      if (has_direct)
        signals.direct.push_back(
            share_code(static_cast<double>(matrix.direct[at]), static_cast<double>(row[j])));
    }
    signals.row_size.push_back(size);
    if (least > 0) {
      const Sums sums = sums_of(matrix, placement, chosen, i, is_kept);
      signals.rest.push_back(sums.all - sums.kept);
    }
    if (effect > signals.largest_effect) {
      signals.largest_effect = effect;
      signals.most_affected = static_cast<std::uint32_t>(i);
    }
  }
  if (signals.left_out == 0) signals.rest.clear();
  return signals;
}

PackedSignals pack_signals(const SignalMatrix& matrix, const Placement& placement, std::size_t most_bytes) {
  // More than ever fit at first, then by what came out. What is always kept may make a few rounds of it.
  std::size_t most = most_bytes / 4;
  PackedSignals packed;
  while (true) {
    packed.signals = page_signals(matrix, placement, most);
    const PageSignals& s = packed.signals;
    PageData data;
    data.add("row_size", std::span(s.row_size));
    data.add("gap", std::span(s.gap));
    data.add("mean", std::span(s.mean));
    data.add("error", std::span(s.error));
    data.add("direct", std::span(s.direct));
    data.add("rest", std::span(s.rest));
    packed.base64 = data.base64(fmt::format(
        R"({{"leastError":{},"errorStep":{},"leftOut":{},"largestLeftOut":{},"largestEffect":{},"mostAffected":{}}})",
        s.least_error, s.error_step, s.left_out, s.largest_left_out, s.largest_effect, s.most_affected));
    const double filled = static_cast<double>(packed.base64.size()) / static_cast<double>(most_bytes);
    if (filled <= 1 || most == 0) break;
    most = static_cast<std::size_t>(0.98 * static_cast<double>(std::min(most, s.mean.size())) / filled);
  }
  return packed;
}

}  // namespace shelfbeam
