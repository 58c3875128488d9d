#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/stats/distributions.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/reuse/reuse.hpp"
#include "shelfbeam/transport/tally/analytic_direct.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"

namespace shelfbeam::test {

/// Means and errors of entries by another estimator. Flagged entries are not compared.
struct Reference {
  std::vector<double> mean, error;  ///< m x n, row by row
  std::vector<std::uint8_t> flags;  ///< m x n, row by row; empty without flags
};

/// Counts of intervals that contain the reference.
struct CoverageCount {
  std::uint64_t pairs = 0, held = 0, beyond_3 = 0, beyond_6 = 0;
  double worst = 0;  ///< largest difference in standard errors

  void add(double z, double interval) {
    ++pairs;
    if (std::abs(z) <= interval) ++held;
    if (std::abs(z) > 3) ++beyond_3;
    if (std::abs(z) > 6) ++beyond_6;
    if (std::abs(z) > std::abs(worst)) worst = z;
  }
  CoverageCount& operator+=(const CoverageCount& other) {
    pairs += other.pairs;
    held += other.held;
    beyond_3 += other.beyond_3;
    beyond_6 += other.beyond_6;
    if (std::abs(other.worst) > std::abs(worst)) worst = other.worst;
    return *this;
  }
  double share(std::uint64_t of) const {
    return pairs > 0 ? static_cast<double>(of) / static_cast<double>(pairs) : 0;
  }
};

/// The counts of a class: of all entries, and of entries that are not flagged.
struct ClassCoverage {
  CoverageCount all, unflagged;
  double of_reference = 0;  ///< sum of the reference's shares of the squared errors

  ClassCoverage& operator+=(const ClassCoverage& other) {
    all += other.all;
    unflagged += other.unflagged;
    of_reference += other.of_reference;
    return *this;
  }
  double flagged() const { return 1 - all.share(unflagged.pairs); }
  /// If this is large, few entries decide, because all runs are compared with the same reference.
  double reference_share() const { return all.pairs > 0 ? of_reference / static_cast<double>(all.pairs) : 0; }
};

/// By number of batches of a run, then by class of entry.
using CoverageTable = std::map<std::uint32_t, std::map<std::string, ClassCoverage>>;

/// The class of an entry by the label's height, the unit's distance and the signal's share of the
/// requirement. Empty if the signal does not matter.
inline std::string class_of(const Scene& scene, std::size_t i, std::size_t j, double mean) {
  const Label& label = scene.labels[i];
  const double share = mean / scene.type_of(label).requirement();
  if (!(share > 0.02) || j >= scene.transceivers.size()) return {};
  const double away = length(scene.transceivers[j].position - label.position);
  const double height = label.position.z;
  return fmt::format("{:<13}{:<10}{}",
                     height < 0.2 ? "below 0.2 m"
                     : height < 1 ? "0.2 to 1 m"
                                  : "above 1 m",
                     away < 2   ? "< 2 m"
                     : away < 4 ? "2 to 4 m"
                                : "> 4 m",
                     share < 0.1   ? "0.02 to 0.1"
                     : share < 0.3 ? "0.1 to 0.3"
                     : share < 1   ? "0.3 to 1"
                                   : "above 1");
}

/// Successive runs of these numbers of batches of one estimator.
inline CoverageTable coverage_of(const Scene& scene, const World& world, const Estimator& estimator,
                                 const Reference& reference, const std::vector<std::uint32_t>& lengths,
                                 std::uint32_t batches) {
  const std::size_t n = world.emitters.size();
  const PathRules rules{.strategy = Strategy::nee, .samples_direct = false};
  const detail::AnalyticDirect known(world, rules, {});
  CoverageTable table;
  for (std::size_t item = 0; item < estimator.items(); ++item) {
    const Estimator::Block& block = estimator.block(item);
    const std::size_t entries = block.rows.size() * block.columns.size();
    std::vector<ItemSums> sums(lengths.size(), ItemSums(entries, false, 0));
    std::vector<std::string> classes(entries);
    for (std::size_t e = 0; e < entries; ++e) {
      const std::size_t i = block.rows[e / block.columns.size()], j = block.columns[e % block.columns.size()];
      if (reference.flags.empty() || reference.flags[i * n + j] == 0)
        classes[e] = class_of(scene, i, j, reference.mean[i * n + j]);
    }
    BatchValues values;
    for (std::uint32_t b = 0; b < batches; ++b) {
      values.clear();
      estimator.sample(item, b, nullptr, values);
      for (std::size_t k = 0; k < lengths.size(); ++k) {
        sums[k].add(values);
        if (sums[k].batches < lengths[k]) continue;
        const double interval = student_quantile(0.975, lengths[k] - 1.0);
        auto& by_class = table[lengths[k]];
        for (std::size_t e = 0; e < entries; ++e) {
          if (classes[e].empty()) continue;
          const std::size_t i = block.rows[e / block.columns.size()],
                            j = block.columns[e % block.columns.size()];
          const PowerSums found = sums[k].entry(e);
          const double mean = found.mean() + known.straight(i, j) + known.mirrored(i, j);
          // Direct light is stored in single precision.
          const double error = std::hypot(found.standard_error(), reference.error[i * n + j], 1e-6 * mean);
          const double z = (mean - reference.mean[i * n + j]) / error;
          ClassCoverage& count = by_class[classes[e]];
          count.all.add(z, interval);
          count.of_reference += std::pow(reference.error[i * n + j] / error, 2);
          if (!found.is_skewed()) count.unflagged.add(z, interval);
        }
        sums[k] = ItemSums(entries, false, 0);
      }
    }
  }
  return table;
}

}  // namespace shelfbeam::test
