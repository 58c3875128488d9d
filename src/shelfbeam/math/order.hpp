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
template <class Number = std::uint32_t, class Key>
std::vector<Number> ordered_by(std::size_t count, const Key& key) {
  std::vector<Number> order = all_numbers<Number>(count);
  std::stable_sort(order.begin(), order.end(), [&](Number a, Number b) { return key(a) < key(b); });
  return order;
}

}  // namespace shelfbeam
