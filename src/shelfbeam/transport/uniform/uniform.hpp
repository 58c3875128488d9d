#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/uniform/walks.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// The paper's estimator and the strategies that it is compared with. Every label has its own walks (for
/// `particle`, every source its own particles), and a walk's connection tries one uniformly chosen source.
class UniformEstimator : public Estimator {
 public:
  /// With `by_bounce`, batches have a layer per number of bounces, which `rules` must limit. With
  /// `by_length`, they have a layer per class of path length; this requires walks that also sample direct
  /// light.
  UniformEstimator(const World& world, const PathRules& rules, std::uint64_t seed,
                   std::uint64_t samples_per_batch, bool by_bounce = false,
                   const LengthSteps& by_length = {});

  std::size_t items() const override { return blocks_.size(); }
  const Block& block(std::size_t item) const override { return blocks_[item]; }
  std::uint64_t samples_per_batch() const override { return per_batch_; }
  bool samples_direct() const override { return rules_.samples_direct; }
  std::string name() const override;
  std::size_t bytes() const override;
  std::unique_ptr<Estimator> part(std::span<const LabelId> labels, std::uint64_t seed,
                                  std::uint64_t min_samples) const override;
  std::unique_ptr<Estimator> for_state(const World& changed, std::uint64_t seed) const override;
  bool sample(std::size_t item, std::uint32_t batch, const CancelToken* cancel,
              BatchValues& values) const override;

 private:
  void sample_direct_light(std::size_t item, std::uint32_t batch, Tally& tally) const;

  const World& world_;
  PathRules rules_;
  std::uint64_t seed_;
  std::uint32_t per_batch_;
  bool by_bounce_, by_source_;
  std::size_t width_;   ///< entries per item
  std::size_t levels_;  ///< of Tally: direct and reflected, or one per number of bounces
  LengthSteps by_length_;
  std::vector<Block> blocks_;
  std::vector<std::uint64_t> label_keys_, source_keys_;
};

/// Strata per dimension for the direct light between a label and a source in a batch (sample_direct), so that
/// the squares over all `width` entries take about as many samples as the walks' connections would.
std::uint32_t direct_strata(std::uint32_t samples, std::size_t width);

}  // namespace shelfbeam
