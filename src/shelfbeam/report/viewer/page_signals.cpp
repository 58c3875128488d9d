#include "shelfbeam/report/viewer/page_signals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/report/data/distributions.hpp"
#include "shelfbeam/report/viewer/page_data.hpp"

namespace shelfbeam {

namespace {

/// The finest first. The coarser ones keep errors and direct shares of relevant entries only.
std::vector<Rounding> roundings() {
  std::vector<Rounding> result;
  for (const std::uint32_t n : {10000, 7000, 5000, 3000, 2000, 1500, 1000, 700, 500, 300, 200, 150, 100})
    result.push_back({n, 0, 1.2, 0.01});
  for (const std::uint32_t n : {70, 50, 40, 30, 20, 15, 10, 7, 5, 3, 2, 1})
    result.push_back({n, relevant_share, 1.5, 0.05});
  return result;
}

constexpr double max_code = 65535;

// The unit of measure for the entries of each label: its requirement, or the largest of all if it has none.
std::vector<double> requirements_of(const SignalMatrix& matrix) {
  double any = 0;
  for (const LabelRow& label : matrix.labels) any = std::max(any, label.requirement);
  std::vector<double> needs;
  for (const LabelRow& label : matrix.labels)
    needs.push_back(label.requirement > 0 ? label.requirement : any > 0 ? any : 1);
  return needs;
}

std::uint32_t grains_of(double mean, double need, std::uint32_t grains_per_requirement) {
  const auto grains = static_cast<std::uint32_t>(std::min(mean / need, 1e5) * grains_per_requirement);
  return is_met(mean, need) ? std::max(grains, grains_per_requirement)
                            : std::min(grains, grains_per_requirement - 1);
}

// The columns of the two largest entries of the chosen units.
std::array<std::uint32_t, 2> two_largest(std::span<const float> row, const Selection& selected) {
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

// Encodes standard errors (for rounded entries relative to the mean) on a logarithmic scale from the smallest
// to the largest value above 0.
void encode_errors(PageSignals& signals, const std::vector<float>& errors, double min_ratio) {
  std::vector<double> values;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const auto error = static_cast<double>(errors[k]);
    values.push_back(!signals.is_detailed(k) ? 0
                     : signals.grain > 0     ? error / static_cast<double>(signals.mean[k])
                                             : error);
    if (values.back() <= 0) continue;
    low = std::min(low, values.back());
    high = std::max(high, values.back());
  }
  if (high > 0) {
    signals.min_error = low;
    signals.error_step = std::max(std::log(high / low) / (max_code - 1), std::log(min_ratio));
  }
  const auto code = [&](double value) -> std::uint16_t {
    if (value <= 0) return 0;
    if (signals.error_step <= 0) return 1;
    return static_cast<std::uint16_t>(1 + std::lround(std::log(value / low) / signals.error_step));
  };
  for (const double value : values) signals.error.push_back(code(value));
}

std::uint16_t share_code(double direct, double mean, double step) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(direct / mean, 0.0, 1.0) / step));
}

// The signal from the exact entries of the chosen units minus the signal from their entries in the page.
double rest_of(const SignalMatrix& matrix, std::size_t label, std::span<const float> shown,
               const Placement& placement, const std::vector<bool>& chosen) {
  std::vector<SignalEntry> all, kept;
  for (std::uint32_t j = 0; j < shown.size(); ++j) {
    if (!chosen[j]) continue;
    all.push_back({j, matrix.signal(label, j)});
    kept.push_back({j, static_cast<double>(shown[j])});
  }
  return received_signal(all, chosen, placement.problem) - received_signal(kept, chosen, placement.problem);
}

// The number of entries that each rounding keeps, without those that are always kept.
std::vector<std::size_t> kept_entries(const SignalMatrix& matrix, const std::vector<Rounding>& roundings) {
  const std::vector<double> needs = requirements_of(matrix);
  std::vector<std::size_t> kept(roundings.size(), 0);
  for (std::size_t i = 0; i < matrix.rows(); ++i)
    for (const float mean : matrix.mean_row(i)) {
      const double share = static_cast<double>(mean) / needs[i];
      if (share * roundings.front().grains_per_requirement < 1) continue;
      std::size_t k = 0;
      while (k + 1 < kept.size() && share * roundings[k + 1].grains_per_requirement >= 1) ++k;
      ++kept[k];
    }
  for (std::size_t k = kept.size() - 1; k > 0; --k) kept[k - 1] += kept[k];
  return kept;
}

std::vector<std::uint16_t> details(const PageSignals& signals, const std::vector<std::uint16_t>& codes) {
  std::vector<std::uint16_t> kept;
  for (std::size_t k = 0; k < codes.size(); ++k)
    if (signals.is_detailed(k)) kept.push_back(codes[k]);
  return kept;
}

PackedSignals packed(PageSignals signals) {
  const auto error = details(signals, signals.error), direct = details(signals, signals.direct);
  PageData data;
  data.add("row_size", signals.row_size);
  data.add("gap", signals.gap);
  if (signals.grain > 0)
    data.add("grains", signals.grains);
  else
    data.add("mean", signals.mean);
  data.add("error", error);
  data.add("direct", direct);
  data.add("rest", signals.rest);
  std::string base64 = data.base64(fmt::format(
      R"({{"grain":{},"detailsFrom":{},"leastError":{},"errorStep":{},"directStep":{}}})", signals.grain,
      signals.details_from, signals.min_error, signals.error_step, signals.direct_step));
  return {std::move(signals), std::move(base64)};
}

}  // namespace

PageSignals page_signals(const SignalMatrix& matrix, const Placement& placement, const Rounding& rounding) {
  const std::uint32_t grains_per_requirement = rounding.grains_per_requirement;
  PageSignals signals;
  const bool is_rounded = grains_per_requirement > 0;
  signals.grain = is_rounded ? 1.0 / grains_per_requirement : 0;
  signals.details_from =
      static_cast<std::uint32_t>(std::lround(rounding.details_from * grains_per_requirement));
  signals.direct_step = rounding.direct_step;
  const bool has_error = matrix.standard_error.size() == matrix.mean.size();
  const bool has_direct = matrix.direct.size() == matrix.mean.size();
  const bool adds_up = placement.problem.model == CommunicationModel::cooperative;
  const std::vector<double> needs = requirements_of(matrix);
  std::vector<float> errors, shown(matrix.columns());
  const std::vector<bool> chosen = marked(matrix.columns(), placement.selected);

  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const auto row = matrix.mean_row(i);
    const auto largest = two_largest(row, placement.selected);
    std::uint32_t size = 0, next = 0;
    double effect = 0;
    for (std::uint32_t j = 0; j < row.size(); ++j) {
      shown[j] = 0;
      if (row[j] <= 0) continue;
      const auto mean = static_cast<double>(row[j]);
      const bool always = j == largest[0] || j == largest[1];
      const std::uint32_t grains = is_rounded ? grains_of(mean, needs[i], grains_per_requirement) : 1;
      if (grains == 0 && !always) {
        ++signals.omitted;
      } else {
        shown[j] = is_rounded ? static_cast<float>((grains + 0.5) * signals.grain * needs[i]) : row[j];
        ++size;
        signals.gap.push_back(j - next);
        next = j + 1;
        signals.mean.push_back(shown[j]);
        if (is_rounded) signals.grains.push_back(grains);
        const std::size_t at = matrix.at(i, j);
        if (has_error) errors.push_back(matrix.standard_error[at]);
        if (has_direct)
          signals.direct.push_back(
              share_code(static_cast<double>(matrix.direct[at]), mean, signals.direct_step));
      }
      const double off = std::abs(mean - static_cast<double>(shown[j])) / needs[i];
      signals.largest_error = std::max(signals.largest_error, off);
      effect = adds_up ? effect + off : std::max(effect, off);
    }
    signals.row_size.push_back(size);
    if (is_rounded) signals.rest.push_back(rest_of(matrix, i, shown, placement, chosen));
    if (effect > signals.largest_effect) {
      signals.largest_effect = effect;
      signals.max_affected = static_cast<std::uint32_t>(i);
    }
  }
  if (has_error) encode_errors(signals, errors, rounding.error_ratio);
  return signals;
}

PackedSignals pack_signals(const SignalMatrix& matrix, const Placement& placement, std::size_t max_bytes) {
  // A packed entry takes at least one byte, without rounding at least four.
  const auto entries = std::ranges::count_if(matrix.mean, [](float mean) { return mean > 0; });
  if (static_cast<std::size_t>(entries) <= max_bytes / 4) {
    PackedSignals exact = packed(page_signals(matrix, placement));
    if (exact.base64.size() <= max_bytes) return exact;
  }
  const std::vector<Rounding> all = roundings();
  const std::vector<std::size_t> kept = kept_entries(matrix, all);
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    if (kept[k] > max_bytes) continue;
    PackedSignals rounded = packed(page_signals(matrix, placement, all[k]));
    if (rounded.base64.size() <= max_bytes) return rounded;
  }
  return packed(page_signals(matrix, placement, all.back()));
}

}  // namespace shelfbeam
