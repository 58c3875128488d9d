#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shelfbeam/transport/reuse/reuse.hpp"
#include "shelfbeam/transport/uniform/walks.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

#include "batch_sums.hpp"

namespace shelfbeam::bench {

/// Labels that are compared: clusters of the reuse estimator, all or some of them, one after the other.
struct Selection {
  /// Clusters in random order until they have so many labels.
  Selection(const ReuseEstimator& reuse, std::size_t most_labels);

  std::vector<std::size_t> items;
  std::vector<std::uint32_t> labels;
};

/// An estimator under comparison: its batches, and what they took of the processor.
class Entrant {
 public:
  Entrant(std::string title, const World& world, const Selection& selection);
  virtual ~Entrant() = default;

  /// Does the next batch.
  void run();

  std::string title;
  BatchSums sums;
  double seconds = 0;        ///< in batches
  double known_seconds = 0;  ///< before, for direct light in closed form
  double cache_seconds = 0;  ///< before, for tables: the selected labels' share
  std::uint64_t rays = 0;    ///< in batches

 protected:
  void prepare_known_light(const PathRules& rules);
  /// Adds a batch to matrix_, which has the known light.
  virtual void sample(std::uint32_t batch) = 0;
  /// What of a batch's time goes into what the benchmark alone wants to know, in s.
  virtual double overhead() { return 0; }

  const World& world_;
  const Selection& selection_;
  std::size_t width_;
  std::vector<double> matrix_;

 private:
  std::vector<double> known_;
  std::uint32_t batches_ = 0;
};

/// The paper's estimator with connections to points chosen uniformly: UniformEstimator, except that it counts
/// the walks that give something to an entry.
class UniformEntrant : public Entrant {
 public:
  UniformEntrant(const World& world, const Selection& selection, bool samples_direct, std::uint32_t walks);

 private:
  void sample(std::uint32_t batch) override;
  double overhead() override;
  void collect(std::size_t position);
  void sample_direct_light(std::size_t position, std::uint32_t batch);

  PathRules rules_;
  std::uint64_t seed_;  ///< different ones, so that errors are independent
  std::uint32_t walks_;
  Tally tally_;
};

class ReuseEntrant : public Entrant {
 public:
  /// `whole_cache_seconds`: what `reuse` took to build, for all labels.
  ReuseEntrant(const World& world, const Selection& selection, const ReuseEstimator& reuse,
               double whole_cache_seconds);

 private:
  void sample(std::uint32_t batch) override;

  const ReuseEstimator& reuse_;
  BatchValues values_;
};

}  // namespace shelfbeam::bench
