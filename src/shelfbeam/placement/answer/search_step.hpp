#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/answer/method.hpp"
#include "shelfbeam/placement/problem/effort.hpp"

namespace shelfbeam::detail {

inline constexpr double no_limit_s = 1e8;

/// Runs a step and adds it to the record. `value` and `bound` return the present ones.
template <class Value, class Bound, class Run>
void record_step(std::vector<SearchStep>& steps, std::string_view name, const Value& value,
                 const Bound& bound, const Run& run) {
  const Stopwatch watch;
  SearchStep step{.name = name, .value_before = value(), .bound_before = bound()};
  run();
  step.seconds = watch.seconds();
  step.value = value();
  step.bound = bound();
  steps.push_back(step);
}

/// A line of the schedule of a search: method, condition and limits. Search has
///
///   whole()              its effort
///   ends()               that is over, or nothing is left to do
///   value(), bound()     for the record
///   step, steps          the name of the present step, and the record
///   after(effort)        called after a step
template <class Search>
struct Step {
  std::string_view name;
  bool (*applies)(const Search&);
  double share;  ///< of the time left when it begins
  void (*run)(Search&, const Effort&);
  std::uint64_t steps = any_steps;  ///< at most this many moves of local search or tree nodes
  double max_s = no_limit_s;        ///< at most this many seconds

  /// With a step limit, the share of the time does not apply.
  Effort effort(const Search& search) const {
    const Effort whole = search.whole();
    if (whole.steps < any_steps) return {std::min(steps, whole.steps), whole.until};
    return {steps, Deadline(std::min(share * whole.seconds_left(), max_s)).end()};
  }
};

/// Runs the steps that apply in order, until the search ends.
template <class Search>
void run_steps(std::span<const Step<std::type_identity_t<Search>>> steps, Search& search) {
  for (const Step<Search>& step : steps) {
    if (search.ends()) return;
    if (!step.applies(search)) continue;
    const Effort effort = step.effort(search);
    search.step = step.name;
    record_step(
        search.steps, step.name, [&] { return search.value(); }, [&] { return search.bound(); },
        [&] { step.run(search, effort); });
    search.after(effort);
  }
}

}  // namespace shelfbeam::detail
