#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "shelfbeam/transport/tally/estimator.hpp"

namespace shelfbeam::detail {

/// Every `count`-th item of an estimator, beginning with item `first`: neighbouring items take similar times.
class EstimatorShare : public Estimator {
 public:
  EstimatorShare(std::unique_ptr<Estimator> whole, std::size_t first, std::size_t count)
      : whole_(std::move(whole)), first_(first), count_(count) {}

  std::size_t items() const override { return (whole_->items() + count_ - 1 - first_) / count_; }
  const Block& block(std::size_t item) const override { return whole_->block(in_whole(item)); }
  std::uint64_t samples_per_batch() const override { return whole_->samples_per_batch(); }
  bool samples_direct() const override { return whole_->samples_direct(); }
  std::string name() const override { return whole_->name(); }
  std::unique_ptr<Estimator> part(std::span<const LabelId> labels, std::uint64_t seed,
                                  std::uint64_t min_samples) const override {
    return whole_->part(labels, seed, min_samples);
  }
  std::unique_ptr<Estimator> for_state(const World& changed, std::uint64_t seed) const override {
    return whole_->for_state(changed, seed);
  }
  std::size_t bytes() const override { return whole_->bytes(); }
  bool sample(std::size_t item, std::uint32_t batch, const CancelToken* cancel,
              BatchValues& values) const override {
    return whole_->sample(in_whole(item), batch, cancel, values);
  }

 private:
  std::size_t in_whole(std::size_t item) const { return first_ + item * count_; }

  std::unique_ptr<Estimator> whole_;
  std::size_t first_, count_;
};

}  // namespace shelfbeam::detail
