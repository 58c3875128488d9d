#pragma once

#include <array>
#include <cstdint>

#include "shelfbeam/math/random.hpp"

namespace shelfbeam {

/// Uniform numbers in the order in which they are asked for; which ones follows from what they are for alone.
class RandomStream {
 public:
  RandomStream(std::uint64_t key, std::uint32_t a, std::uint32_t b, std::uint32_t c)
      : key_(key), a_(a), b_(b), c_(c) {}

  std::uint32_t bits() {
    if (used_ == words_.size()) {
      words_ = philox({counter_++, a_, b_, c_}, key_);
      used_ = 0;
    }
    return words_[used_++];
  }
  double unit() { return to_unit(bits()); }

 private:
  std::uint64_t key_;
  std::uint32_t a_, b_, c_, counter_ = 0;
  std::array<std::uint32_t, 4> words_{};
  std::size_t used_ = 4;
};

}  // namespace shelfbeam
