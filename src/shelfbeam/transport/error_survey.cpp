#include "shelfbeam/transport/detail/error_survey.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include <tbb/enumerable_thread_specific.h>

#include "shelfbeam/base/parallel.hpp"

namespace shelfbeam::detail {

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
      means[c] = sums.mean() + known_.straight(rows[r], columns[c]) + known_.mirrored(rows[r], columns[c]);
      errors[c] = sums.standard_error();
      flags[c] = sums.is_skewed() ? 1 : 0;
    }
    use(rows[r], means, errors, flags);
  }
}

Precision ErrorSurvey::precision(std::size_t item, const RelativeError& wanted) const {
  const double reachable = this->reachable(item, wanted);
  Precision found;
  const bool flags_are_final = sums_[item].batches >= last_flagged_batches;
  each_row(item, [&](std::size_t i, const auto& means, auto& errors, const auto& flags) {
    for (std::size_t c = 0; flags_are_final && c < errors.size(); ++c)
      if (flags[c] != 0) errors[c] = std::numeric_limits<double>::infinity();
    found += count_precise(means, errors, flags, requirement(i), wanted, reachable);
  });
  return found;
}

double ErrorSurvey::reachable(std::size_t item, const RelativeError& wanted) const {
  const std::uint32_t batches = sums_[item].batches;
  const double samples = static_cast<double>(estimator_.samples_per_batch()) * batches;
  return reachable_error(batches, static_cast<double>(wanted.most_samples) / samples);
}

double ErrorSurvey::requirement(std::size_t i) const {
  return world_.scene.type_of(world_.scene.labels[i]).requirement();
}

ErrorSurvey::Shortfall ErrorSurvey::shortfall(const RelativeError& wanted, std::size_t named) const {
  Shortfall found;
  std::vector<UnmetEntry>& worst = found.worst;
  for (std::size_t item = 0; item < sums_.size(); ++item) {
    const auto& columns = estimator_.block(item).columns;
    const double reachable = this->reachable(item, wanted);
    const bool flags_are_final = sums_[item].batches >= last_flagged_batches;
    const auto comes_first = [](const UnmetEntry& a, const UnmetEntry& b) {
      return a.is_out_of_reach != b.is_out_of_reach ? a.is_out_of_reach : a.relative_error > b.relative_error;
    };
    each_row(item, [&](std::size_t i, const auto& means, const auto& errors, const auto& flags) {
      const double limit = relevance_limit(means, requirement(i), wanted.above);
      for (std::size_t c = 0; c < means.size(); ++c) {
        if (!(means[c] > limit)) continue;
        ++found.relevant;
        if (flags[c] == 0 && errors[c] <= wanted.error * means[c]) continue;
        ++found.entries;
        const UnmetEntry entry{
            world_.scene.labels[i].id, world_.emitters.id(columns[c]), errors[c] / means[c], flags[c] != 0,
            (flags[c] != 0 && flags_are_final) || errors[c] > wanted.error * means[c] * reachable};
        found.out_of_reach += entry.is_out_of_reach ? 1 : 0;
        const auto at = std::upper_bound(worst.begin(), worst.end(), entry, comes_first);
        if (worst.size() == named && at == worst.end()) continue;
        worst.insert(at, entry);
        if (worst.size() > named) worst.pop_back();
      }
    });
  }
  return found;
}

ErrorSurvey::Errors ErrorSurvey::errors(double above) const {
  tbb::enumerable_thread_specific<Errors> parts;
  for_parts(sums_.size(), [&](std::size_t first, std::size_t last) {
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

}  // namespace shelfbeam::detail
