#pragma once

#include <chrono>
#include <string_view>
#include <vector>

#include "shelfbeam/placement/answer/method.hpp"

namespace shelfbeam::detail {

/// Runs a step and adds it to the record. `value` and `bound` return the present ones.
template <class Value, class Bound, class Run>
void record_step(std::vector<SearchStep>& steps, std::string_view name, const Value& value,
                 const Bound& bound, const Run& run) {
  const auto begin = std::chrono::steady_clock::now();
  SearchStep step{.name = name, .value_before = value(), .bound_before = bound()};
  run();
  step.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  step.value = value();
  step.bound = bound();
  steps.push_back(step);
}

}  // namespace shelfbeam::detail
