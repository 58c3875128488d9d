#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace shelfbeam {

/// 0, 1, ..., count - 1.
template <class Number = std::uint32_t>
std::vector<Number> all_numbers(std::size_t count) {
  std::vector<Number> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// These numbers by ascending key(number), and by number where keys are equal.
template <class Key>
std::vector<std::uint32_t> ordered_by(std::size_t count, const Key& key) {
  std::vector<std::uint32_t> order = all_numbers(count);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return order;
}

}  // namespace shelfbeam
