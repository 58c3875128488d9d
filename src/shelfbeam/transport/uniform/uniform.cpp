#include "shelfbeam/transport/uniform/uniform.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/uniform/walks.hpp"
#include "shelfbeam/transport/world/direct.hpp"

namespace shelfbeam {

UniformEstimator::UniformEstimator(const World& world, const PathRules& rules, std::uint64_t seed,
                                   std::uint64_t samples_per_batch, bool by_bounce,
                                   const LengthSteps& by_length)
    : world_(world),
      rules_(rules),
      seed_(seed),
      per_batch_(static_cast<std::uint32_t>(samples_per_batch)),
      by_bounce_(by_bounce),
      by_source_(rules.strategy == Strategy::particle),
      width_(by_source_ ? world.receivers.size() : world.emitters.size()),
      levels_(by_bounce ? std::size_t{rules.max_bounces} + 1 : 2),
      by_length_(by_length) {
  for (const Label& label : world.scene.labels) label_keys_.push_back(hash64(label.id));
  for (const Transceiver& unit : world.scene.transceivers) source_keys_.push_back(hash64(unit.id));
  for (const EmittingSurface& surface : world.scene.emitting_surfaces)
    source_keys_.push_back(hash64(surface.id));

  const std::size_t count = by_source_ ? world.emitters.size() : world.receivers.size();
  blocks_.reserve(count);
  for (std::uint32_t item = 0; item < count; ++item)
    blocks_.push_back(by_source_ ? Block{all_numbers<LabelId>(width_), {item}}
                                 : Block{{item}, all_numbers(width_)});
}

std::string UniformEstimator::name() const {
  std::string name = fmt::format("{}{}", by_source_ ? "" : "uniform ", to_text(rules_.strategy));
  if (rules_.strategy == Strategy::mis) name += fmt::format(" ({})", to_text(rules_.heuristic));
  name += fmt::format(", direct {}", rules_.samples_direct ? "sampled" : "exact");
  if (rules_.max_bounces != PathRules::no_limit)
    name += fmt::format(", at most {} bounces", rules_.max_bounces);
  return name;
}

std::unique_ptr<Estimator> UniformEstimator::for_state(const World& changed, std::uint64_t seed) const {
  return std::make_unique<UniformEstimator>(changed, rules_, seed, per_batch_);
}

std::unique_ptr<Estimator> UniformEstimator::part(std::span<const LabelId> labels, std::uint64_t seed,
                                                  std::uint64_t min_samples) const {
  if (by_source_)
    throw InputError("strategy particle", "does not sample whole rows", "use another strategy",
                     Setting::strategy);
  auto part = std::make_unique<UniformEstimator>(world_, rules_, seed,
                                                 std::max<std::uint64_t>(per_batch_, min_samples));
  std::vector<Block> blocks;
  for (const LabelId i : labels) blocks.push_back(std::move(part->blocks_[i]));
  part->blocks_ = std::move(blocks);
  return part;
}

std::size_t UniformEstimator::bytes() const {
  return blocks_.size() * (sizeof(Block) + (width_ + 1) * sizeof(std::uint32_t));
}

bool UniformEstimator::sample(std::size_t item, std::uint32_t batch, const CancelToken* cancel,
                              BatchValues& values) const {
  Tally tally(width_, levels_, by_length_);
  const Block& block = blocks_[item];
  const std::uint64_t stream =
      mix_key(seed_, by_source_ ? source_keys_[item] : label_keys_[block.rows.front()]);
  bool cancelled = false;
  for (std::uint32_t s = 0; s < per_batch_ && !cancelled; ++s) {
    const PathKey key{stream, batch, s};
    if (by_source_)
      follow_particle(world_, item, key, rules_, tally);
    else
      walk_from_label(world_, block.rows.front(), key, rules_, tally);
    cancelled = s % 1024 == 0 && cancel != nullptr && cancel->requested();
  }
  if (!cancelled && !rules_.samples_direct) sample_direct_light(item, batch, tally);
  values.rays += tally.rays;
  values.shadow_rays += tally.shadow_rays;
  if (cancelled) return false;

  const double samples = per_batch_;
  for (std::uint32_t k = 0; k < width_; ++k) {
    double total = 0;
    for (std::uint32_t level = 0; level < levels_; ++level) {
      const double sum = tally.sum(level, k);
      if (sum == 0) continue;
      total += sum / samples;
      if (by_bounce_) values.layers.push_back({level, k, sum / samples});
    }
    const auto first = static_cast<std::uint32_t>(by_bounce_ ? levels_ : 0);
    for (std::uint32_t step = 0; step < by_length_.count; ++step)
      if (const double sum = tally.sum_of_length(step, k); sum != 0)
        values.layers.push_back({first + step, k, sum / samples});
    if (total != 0) values.values.push_back({k, total, tally.sum(0, k) / samples});
  }
  return true;
}

std::uint32_t direct_strata(std::uint32_t samples, std::size_t width) {
  const double each = static_cast<double>(samples) / static_cast<double>(width);
  return static_cast<std::uint32_t>(std::clamp(std::ceil(std::sqrt(each)), 2.0, 64.0));
}

void UniformEstimator::sample_direct_light(std::size_t item, std::uint32_t batch, Tally& tally) const {
  const std::uint32_t side = direct_strata(per_batch_, width_);
  for (std::size_t k = 0; k < width_; ++k) {
    const std::size_t i = by_source_ ? k : std::size_t{blocks_[item].rows.front()}, j = by_source_ ? item : k;
    if (is_point_to_point(world_, i, j)) continue;
    const PathKey key{mix_key(mix_key(seed_, label_keys_[i]), source_keys_[j]), batch, 0};
    const DirectSignal signal = sample_direct(world_, i, j, key, side, rules_);
    tally.rays += signal.rays;
    tally.add(0, k, signal.straight * per_batch_);
    tally.add(1, k, signal.mirrored * per_batch_);
  }
}

}  // namespace shelfbeam
