#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace shelfbeam::detail {

/// A set of numbers below a given size, one bit each.
class BitSet {
 public:
  explicit BitSet(std::size_t size = 0, bool full = false) : words_((size + 63) / 64, 0) {
    for (std::size_t k = 0; full && k < size; ++k) insert(k);
  }
  void insert(std::size_t k) { words_[k / 64] |= std::uint64_t{1} << k % 64; }
  void erase(std::size_t k) { words_[k / 64] &= ~(std::uint64_t{1} << k % 64); }
  bool contains(std::size_t k) const { return (words_[k / 64] >> k % 64 & 1) != 0; }
  bool empty() const {
    return std::ranges::all_of(words_, [](std::uint64_t word) { return word == 0; });
  }
  /// Both sets have the same size.
  bool is_subset(const BitSet& other) const {
    for (std::size_t w = 0; w < words_.size(); ++w)
      if ((words_[w] & ~other.words_[w]) != 0) return false;
    return true;
  }
  std::span<const std::uint64_t> words() const { return words_; }
  /// The words as bytes, to compare and hash sets of the same size.
  std::string_view bytes() const {
    return {reinterpret_cast<const char*>(words_.data()), words_.size() * sizeof words_[0]};
  }
  /// Calls visit(k) for the common members, ascending, until it returns false; `visit` may erase k. Both
  /// sets have the same size.
  template <class Visit>
  void for_common(const BitSet& other, Visit visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t rest = words_[w] & other.words_[w]; rest != 0; rest &= rest - 1) {
        const auto k = static_cast<std::uint32_t>(64 * w + static_cast<std::size_t>(std::countr_zero(rest)));
        if constexpr (std::is_void_v<decltype(visit(k))>)
          visit(k);
        else if (!visit(k))
          return;
      }
  }
  /// The same for all members.
  template <class Visit>
  void for_each(Visit visit) const {
    for_common(*this, visit);
  }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace shelfbeam::detail
