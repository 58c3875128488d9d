#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/cache/lane_kernels.hpp"

namespace shelfbeam {

/// A value for every unit, of which only some groups are not zero.
class LaneRow {
 public:
  explicit LaneRow(std::size_t groups) : values_(groups * lanes), is_used_(groups) { used_.reserve(groups); }

  const std::vector<std::uint16_t>& groups() const { return used_; }
  const float* values() const { return values_.data(); }

  void clear() {
    for (const std::uint16_t g : used_) {
      is_used_[g] = 0;
      for (std::size_t k = 0; k < lanes; ++k) values_[g * lanes + k] = 0;
    }
    used_.clear();
  }

  void use(const std::uint16_t* list, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c) {
      if (is_used_[list[c]]) continue;
      is_used_[list[c]] = 1;
      used_.push_back(list[c]);
    }
  }
  void add(std::uint32_t place, double value) {
    const auto g = static_cast<std::uint16_t>(place / lanes);
    use(&g, 1);
    values_[place] += static_cast<float>(value);
  }
  void add(const LaneRow& other, double weight) {
    use(other.used_.data(), other.used_.size());
    LaneKernels::add(other.used_.data(), other.used_.size(), static_cast<float>(weight), other.values(),
                     values_.data());
  }
  float* mutable_values() { return values_.data(); }

 private:
  std::vector<float> values_;
  std::vector<std::uint8_t> is_used_;
  std::vector<std::uint16_t> used_;
};

}  // namespace shelfbeam
