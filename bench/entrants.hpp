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

/// The labels that are compared: all or some clusters of the reuse estimator, one after the other.
struct Selection {
  /// Takes clusters in random order until they contain `max_labels` labels.
  Selection(const ReuseEstimator& reuse, std::size_t max_labels);

  std::vector<std::size_t> items;
  std::vector<LabelId> labels;
};

/// An estimator under comparison: its batches, and their CPU time.
class Entrant {
 public:
  Entrant(std::string title, const World& world, const Selection& selection);
  virtual ~Entrant() = default;

  /// Runs the next batch.
  void run();

  std::string title;
  BatchSums sums;
  double seconds = 0;        ///< CPU time of the batches
  double known_seconds = 0;  ///< CPU time before the batches, for analytic direct light
  double cache_seconds = 0;  ///< CPU time before the batches, for the cache: the selected labels' share
  std::uint64_t rays = 0;    ///< of the batches

 protected:
  void prepare_known_light(const PathRules& rules);
  /// Adds a batch to matrix_, which already contains the analytic direct light.
  virtual void sample(std::uint32_t batch) = 0;
  /// The time of a batch that only the benchmark needs, in s.
  virtual double overhead() { return 0; }

  const World& world_;
  const Selection& selection_;
  std::size_t width_;
  std::vector<double> matrix_;

 private:
  std::vector<double> known_;
  std::uint32_t batches_ = 0;
};

/// The paper's estimator with connections to uniformly chosen points: UniformEstimator, except that it counts
/// the walks that contribute to an entry.
class UniformEntrant : public Entrant {
 public:
  UniformEntrant(const World& world, const Selection& selection, bool samples_direct, std::uint32_t walks);

 private:
  void sample(std::uint32_t batch) override;
  double overhead() override;
  void collect(std::size_t position);
  void sample_direct_light(std::size_t position, std::uint32_t batch);

  PathRules rules_;
  std::uint64_t seed_;  ///< different for every entrant, so that errors are independent
  std::uint32_t walks_;
  Tally tally_;
};

class ReuseEntrant : public Entrant {
 public:
  /// `whole_cache_seconds`: the time to build `reuse` for all labels.
  ReuseEntrant(const World& world, const Selection& selection, const ReuseEstimator& reuse,
               double whole_cache_seconds);

 private:
  void sample(std::uint32_t batch) override;

  const ReuseEstimator& reuse_;
  BatchValues values_;
};

}  // namespace shelfbeam::bench
