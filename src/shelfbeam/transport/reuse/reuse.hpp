#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/transport/reuse/residual.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"

namespace shelfbeam {

/// Path reuse over clusters of labels, with a radiance cache as control variate (docs/methods/reuse.md). An
/// item is a cluster.
class ReuseEstimator : public Estimator {
 public:
  /// Builds the cache, which takes some seconds for a large store. `world` must outlive the estimator.
  /// Throws Interrupted when cancelled.
  ReuseEstimator(const World& world, std::uint64_t seed, const ReuseEffort& effort = {},
                 const RunControl& control = {});
  /// The same with known cells and links between them.
  ReuseEstimator(const World& world, std::uint64_t seed, const ReuseEffort& effort, const SurfaceLinks& links,
                 const RunControl& control = {});
  ~ReuseEstimator() override;

  std::size_t items() const override;
  const Block& block(std::size_t item) const override;
  std::uint64_t samples_per_batch() const override;
  bool samples_direct() const override { return false; }
  std::string name() const override;
  std::size_t bytes() const override;
  std::unique_ptr<Estimator> part(std::span<const LabelId> labels, std::uint64_t seed,
                                  std::uint64_t min_samples) const override;
  /// Shares the radiance cache, which is most of the preparation.
  std::unique_ptr<Estimator> for_state(const World& changed, std::uint64_t seed) const override;
  bool sample(std::size_t item, std::uint32_t batch, const CancelToken* cancel,
              BatchValues& values) const override;

 private:
  struct Tables;
  ReuseEstimator(std::shared_ptr<const Tables> tables, std::span<const LabelId> labels, std::uint64_t seed);

  std::shared_ptr<const Tables> tables_;
  std::vector<Block> blocks_;  ///< clusters of labels
  std::vector<std::uint64_t> keys_;
};

}  // namespace shelfbeam
