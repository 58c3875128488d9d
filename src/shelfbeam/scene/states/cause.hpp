#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The causes of a shop's changes.
enum class Cause {
  stock,
  people,
  objects,
  doors,
  mounting,  ///< position, tilt and power of units
  labels     ///< their sensitivity
};

template <>
inline constexpr auto names_of<Cause> = std::to_array<Named<Cause>>({{"stock", Cause::stock},
                                                                     {"people", Cause::people},
                                                                     {"objects", Cause::objects},
                                                                     {"doors", Cause::doors},
                                                                     {"mounting", Cause::mounting},
                                                                     {"labels", Cause::labels}});

/// The number of the state from which each cause takes its draws. Without a number it is as in the file.
class StateNumbers {
 public:
  /// State k.
  explicit StateNumbers(std::uint64_t k) { numbers_.fill(k); }

  /// One cause is as in state k, all others as in the file. Without a cause, nothing changes.
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
