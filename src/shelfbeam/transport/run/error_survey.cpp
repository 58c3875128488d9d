#include "shelfbeam/transport/run/error_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <tbb/enumerable_thread_specific.h>

#include "shelfbeam/base/parallel.hpp"

namespace shelfbeam {

// Calls use(row, means, standard errors, flags) for the rows of an item.
template <class Use>
void ErrorSurvey::each_row(std::size_t item, Use use) const {
  const auto& [rows, columns] = estimator_.block(item);
  std::vector<double> means(columns.size()), errors(columns.size());
  std::vector<std::uint8_t> flags(columns.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::size_t entry = r * columns.size() + c;
      const PowerSums sums = sums_[item].entry(entry);
      means[c] = sums.mean() + analytic_direct_.straight(rows[r], columns[c]) +
                 analytic_direct_.mirrored(rows[r], columns[c]);
      errors[c] = sums.standard_error();
      flags[c] = sums.is_skewed() ? 1 : 0;
    }
    use(rows[r], means, errors, flags);
  }
}

Precision ErrorSurvey::precision(std::size_t item, const RelativeError& wanted) const {
  const Reachable reachable = this->reachable(item, wanted);
  Precision found;
  each_row(item, [&](std::size_t i, const auto& means, const auto& errors, const auto& flags) {
    found += count_precise(means, errors, flags, requirement(i), wanted, reachable);
  });
  return found;
}

Reachable ErrorSurvey::reachable(std::size_t item, const RelativeError& wanted) const {
  const std::uint32_t batches = sums_[item].batches;
  const double samples = static_cast<double>(estimator_.samples_per_batch()) * batches;
  return {reachable_error(batches, static_cast<double>(wanted.max_samples) / samples),
          batches >= last_flagged_batches};
}

double ErrorSurvey::requirement(std::size_t i) const {
  return world_.scene.requirement_of(world_.scene.labels[i]);
}

ErrorSurvey::Shortfall ErrorSurvey::shortfall(const RelativeError& wanted, std::size_t named) const {
  Shortfall found;
  // Only the few listed entries get their ids.
  struct Rank {
    bool is_out_of_reach;
    double error;
  };
  const auto comes_first = [](const Rank& a, const UnmetEntry& b) {
    return a.is_out_of_reach != b.is_out_of_reach ? a.is_out_of_reach : a.error > b.relative_error;
  };
  for (std::size_t item = 0; item < sums_.size(); ++item) {
    const auto& columns = estimator_.block(item).columns;
    const Reachable reachable = this->reachable(item, wanted);
    found.precision += precision(item, wanted);
    each_row(item, [&](std::size_t i, const auto& means, const auto& errors, const auto& flags) {
      const double limit = relevance_limit(means, requirement(i), wanted.above);
      for (std::size_t c = 0; c < means.size(); ++c) {
        if (!(means[c] > limit)) continue;
        const EntryStatus stands = entry_status(means[c], errors[c], flags[c] != 0, wanted, reachable);
        if (stands == EntryStatus::precise) continue;
        const Rank rank{stands == EntryStatus::unreachable, errors[c] / means[c]};
        const auto at = std::upper_bound(found.worst.begin(), found.worst.end(), rank, comes_first);
        if (found.worst.size() == named && at == found.worst.end()) continue;
        found.worst.insert(at, {world_.scene.labels[i].id, world_.emitters.id(columns[c]), rank.error,
                                flags[c] != 0, rank.is_out_of_reach});
        if (found.worst.size() > named) found.worst.pop_back();
      }
    });
  }
  return found;
}

ErrorSurvey::Errors ErrorSurvey::errors(double above) const {
  tbb::enumerable_thread_specific<Errors> parts;
  parallel_for_ranges(sums_.size(), [&](std::size_t first, std::size_t last) {
    Errors& part = parts.local();
    for (std::size_t item = first; item < last; ++item) {
      if (sums_[item].batches < 2) continue;
      each_row(item, [&](std::size_t i, const auto& means, const auto& errors, const auto& flags) {
        const double limit = relevance_limit(means, requirement(i), above);
        for (std::size_t c = 0; c < means.size(); ++c) {
          if (!(means[c] > limit)) continue;
          part.relative.add(errors[c] / means[c]);
          part.flagged += flags[c];
        }
      });
    }
  });
  Errors all;
  for (const Errors& part : parts) {
    all.relative.merge(part.relative);
    all.flagged += part.flagged;
  }
  return all;
}

bool is_stopping_point(std::uint32_t batches) {
  std::uint64_t point = min_batches;
  while (point < batches) point += point / 16;
  return point == batches;
}

double relevance_limit(std::span<const double> means, double requirement, double share) {
  if (requirement > 0) return share * requirement;
  return means.empty() ? 0 : share * *std::max_element(means.begin(), means.end());
}

EntryStatus entry_status(double mean, double standard_error, bool is_flagged, const RelativeError& wanted,
                         const Reachable& reachable) {
  const double most = wanted.error * mean;
  if (!is_flagged && standard_error <= most) return EntryStatus::precise;
  const bool is_hopeless =
      (is_flagged && reachable.flags_are_final) || standard_error > most * reachable.error;
  return is_hopeless ? EntryStatus::unreachable : EntryStatus::open;
}

Precision count_precise(std::span<const double> means, std::span<const double> standard_errors,
                        std::span<const std::uint8_t> flags, double requirement, const RelativeError& wanted,
                        const Reachable& reachable) {
  const double limit = relevance_limit(means, requirement, wanted.above);
  Precision result;
  for (std::size_t k = 0; k < means.size(); ++k) {
    if (!(means[k] > limit)) continue;
    ++result.relevant;
    const EntryStatus found = entry_status(means[k], standard_errors[k], flags[k] != 0, wanted, reachable);
    result.precise += found == EntryStatus::precise ? 1 : 0;
    result.unreachable += found == EntryStatus::unreachable ? 1 : 0;
  }
  return result;
}

double reachable_error(std::uint32_t batches, double growth) {
  constexpr double deviations = 3;
  return std::sqrt(growth) * (1 + deviations / std::sqrt(2.0 * (batches - 1)));
}

}  // namespace shelfbeam
