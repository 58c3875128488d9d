#include "shelfbeam/transport/detail/error_survey.hpp"

#include <cstdint>

#include <tbb/enumerable_thread_specific.h>

#include "shelfbeam/base/parallel.hpp"

namespace shelfbeam::detail {

// Calls use(the label's requirement, means, standard errors) for the rows of an item.
template <class Use>
void ErrorSurvey::each_row(std::size_t item, Use use) const {
  const auto& [rows, columns] = estimator_.block(item);
  const Scene& scene = world_.scene;
  std::vector<double> means(columns.size()), errors(columns.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::size_t entry = r * columns.size() + c;
      means[c] = sums_[item].mean(entry) + known_.straight(rows[r], columns[c]) +
                 known_.mirrored(rows[r], columns[c]);
      errors[c] = sums_[item].standard_error(entry);
    }
    use(scene.type_of(scene.labels[rows[r]]).requirement(), means, errors);
  }
}

Precision ErrorSurvey::precision(std::size_t item, const RelativeError& wanted) const {
  Precision found;
  each_row(item, [&](double requirement, const auto& means, const auto& errors) {
    found += count_precise(means, errors, requirement, wanted);
  });
  return found;
}

LogHistogram ErrorSurvey::relative_errors(double above) const {
  tbb::enumerable_thread_specific<LogHistogram> parts;
  for_parts(sums_.size(), [&](std::size_t first, std::size_t last) {
    LogHistogram& histogram = parts.local();
    for (std::size_t item = first; item < last; ++item) {
      if (sums_[item].batches < 2) continue;
      each_row(item, [&](double requirement, const auto& means, const auto& errors) {
        const double limit = relevance_limit(means, requirement, above);
        for (std::size_t c = 0; c < means.size(); ++c)
          if (means[c] > limit) histogram.add(errors[c] / means[c]);
      });
    }
  });
  LogHistogram all;
  for (const LogHistogram& part : parts) all.merge(part);
  return all;
}

}  // namespace shelfbeam::detail
