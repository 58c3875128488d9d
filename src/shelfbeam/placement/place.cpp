#include <chrono>
#include <limits>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/checker.hpp"
#include "shelfbeam/placement/greedy.hpp"
#include "shelfbeam/placement/mip.hpp"
#include "shelfbeam/placement/placement.hpp"

namespace shelfbeam {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

std::vector<milp::Backend> wanted_backends(const std::string& name) {
  const auto all = milp::backends();
  if (name.empty()) return {all.begin(), all.end()};
  std::vector<std::string_view> known;
  for (const milp::Backend& backend : all) {
    if (backend.name == name) return {backend};
    known.push_back(backend.name);
  }
  throw InputError("MIP back end", fmt::format("'{}' is not built in", name), suggest(name, known));
}

Placement infeasible(const SignalTable& table, const Question& question, const Check& with_everything) {
  Placement placement;
  placement.question = question;
  placement.status = Status::infeasible;
  placement.objective_value = placement.lower_bound = placement.count_lower_bound = infinite;
  placement.unit_costs = label_costs(table, question.objective).unit;
  for (const std::uint32_t i : with_everything.unmet)
    placement.unreachable.push_back(
        {i, requirement_of(table.labels[i], question.model), with_everything.signal[i]});
  return placement;
}

/// A selection with the bounds that need no search.
Placement greedy_placement(const SignalTable& table, const Question& question,
                           std::vector<std::uint32_t> selected) {
  Placement placement = place_by_mip(table, question, std::move(selected), {}, 0, {}).placement;
  placement.status = Status::feasible;
  placement.solver = "greedy";
  return placement;
}

}  // namespace

double Placement::gap() const {
  if (status == Status::optimal) return 0;
  if (status == Status::infeasible || !(objective_value < infinite)) return infinite;
  return objective_value > lower_bound ? (objective_value - lower_bound) / objective_value : 0;
}

Placement place(const SignalTable& table, const Question& question, const PlaceOptions& options,
                const RunControl& control) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  check_question(table, question);
  const auto backends = wanted_backends(options.backend);

  std::vector<std::uint32_t> everything(table.columns());
  for (std::uint32_t j = 0; j < everything.size(); ++j) everything[j] = j;
  Placement placement;
  if (const Check check = check_selection(table, question, everything); !check.met()) {
    placement = infeasible(table, question, check);
  } else {
    const std::vector<std::uint32_t> greedy = greedy_selection(table, question);
    if (options.solver == SolverChoice::greedy) {
      placement = greedy_placement(table, question, greedy);
    } else {
      for (const milp::Backend& backend : backends) {
        MipAnswer answer =
            place_by_mip(table, question, greedy, backend.solve, options.time_limit_s - elapsed(), control);
        placement = std::move(answer.placement);
        placement.solver = fmt::format("{} {}", backend.name, backend.version);
        if (!answer.solver_failed) break;
      }
    }
  }
  placement.seconds = elapsed();
  return placement;
}

}  // namespace shelfbeam
