#include "placement_steps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/coverage/fewest_units.hpp"
#include "shelfbeam/placement/coverage/max_coverage.hpp"

namespace shelfbeam::bench {

namespace {

/// "27 -> 26", or the number alone if it has not changed.
std::string change(double before, double after) {
  return before == after ? fmt::format("{:g}", after) : fmt::format("{:g} -> {:g}", before, after);
}

void print(const std::string& instance, const std::string& question, const std::vector<SearchStep>& steps) {
  for (const SearchStep& step : steps)
    fmt::print("| {} | {} | {} | {:.2f} | {} | {} |\n", instance, question, step.name, step.seconds,
               change(step.value_before, step.value), change(step.bound_before, step.bound));
  std::fflush(stdout);
}

}  // namespace

void print_steps(const InstanceChoice& choice, double limit) {
  fmt::print("| instance | question | step | s | value | bound |\n| --- | --- | --- | --- | --- | --- |\n");
  const PlaceOptions options{.time_limit_s = limit};
  for_instances(choice, [&](const std::string& name, const SignalTable& table) {
    for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative}) {
      const PlacementProblem problem{.model = model};
      const Placement placement = place(table, problem, options);
      print(name, fmt::format("count, {}", to_text(model)), placement.steps);
      const std::size_t half = std::max<std::size_t>(1, placement.count() / 2);
      print(name, fmt::format("at most {}, {}", half, to_text(model)),
            maximise_coverage(table, problem, half, options).steps);
      print(name, fmt::format("reach 95 %, {}", to_text(model)),
            fewest_units(table, problem, 0.95, options).steps);
      print(name, fmt::format("unit failure, {}", to_text(model)),
            place(table, {.model = model, .redundant = true}, options).steps);
    }
  });
}

}  // namespace shelfbeam::bench
