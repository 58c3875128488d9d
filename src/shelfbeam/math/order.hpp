#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
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

/// The numbers k < count with is_in(k), ascending.
template <class Number = std::uint32_t, class Predicate>
std::vector<Number> numbers_where(std::size_t count, const Predicate& is_in) {
  std::vector<Number> numbers;
  for (std::uint32_t k = 0; k < count; ++k)
    if (is_in(Number(k))) numbers.push_back(k);
  return numbers;
}

template <class Number = std::uint32_t>
std::vector<Number> numbers_where(const std::vector<bool>& is_in) {
  return numbers_where<Number>(is_in.size(), [&](std::uint32_t k) { return is_in[k]; });
}

/// For each number below `count`, whether the list contains it.
template <class List>
std::vector<bool> marked(std::size_t count, const List& numbers) {
  std::vector<bool> is_in(count, false);
  for (const auto k : numbers) is_in[k] = true;
  return is_in;
}

/// A list in ascending order.
template <class List>
std::vector<typename List::value_type> sorted(const List& list) {
  std::vector<typename List::value_type> ascending(list.begin(), list.end());
  std::sort(ascending.begin(), ascending.end());
  return ascending;
}

/// The union of two ascending lists without repetitions.
template <class A, class B>
std::vector<typename A::value_type> united(const A& a, const B& b) {
  std::vector<typename A::value_type> all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

}  // namespace shelfbeam
