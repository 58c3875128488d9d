#pragma once

#include <chrono>
#include <string_view>
#include <vector>

namespace shelfbeam {

/// A step of a search, with the value of the incumbent and its bound before and after. If several
/// searches answer a question, the units of measure of their values differ.
struct SearchStep {
  std::string_view name;  ///< of a method, static
  double seconds = 0;     ///< wall time
  double value_before = 0, value = 0;
  double bound_before = 0, bound = 0;
};

namespace detail {

/// Runs a step and adds it to the record. `value` and `bound` return the present ones; infinite: none yet.
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

}  // namespace detail

}  // namespace shelfbeam
