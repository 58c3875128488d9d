#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shelfbeam/scene/variation.hpp"

namespace shelfbeam {

/// The number of the state from which each cause takes its draws. Without a number it is as in the file.
class StateNumbers {
 public:
  /// State k.
  explicit StateNumbers(std::uint64_t k) { numbers_.fill(k); }

  /// One cause is as in state k, all others as in the file. Without a cause, nothing changes. Reflectances
  /// are those of the store in every state.
  static StateNumbers only(std::optional<Cause> cause, std::uint64_t k) {
    StateNumbers numbers(k);
    numbers.numbers_.fill({});
    if (cause) numbers.set(*cause, k);
    return numbers;
  }

  std::optional<std::uint64_t> of(Cause cause) const { return numbers_[static_cast<std::size_t>(cause)]; }
  void set(Cause cause, std::optional<std::uint64_t> k) { numbers_[static_cast<std::size_t>(cause)] = k; }

 private:
  std::array<std::optional<std::uint64_t>, names_of<Cause>.size()> numbers_;
};

}  // namespace shelfbeam
