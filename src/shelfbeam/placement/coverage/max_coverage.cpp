#include "shelfbeam/placement/coverage/max_coverage.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/coverage/coverage_bound.hpp"
#include "shelfbeam/placement/coverage/coverage_model.hpp"
#include "shelfbeam/placement/coverage/coverage_search.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

using detail::CoverageModel;
using Clock = std::chrono::steady_clock;

// Work in entries examined, so that results do not depend on the machine: about ten seconds each.
constexpr std::size_t search_work = 2'000'000'000;
constexpr std::size_t bound_work = 4'000'000'000;

// A step looks at all entries once.
std::size_t work_of(const PlaceOptions& options, const SignalTable& table) {
  const std::size_t most = std::numeric_limits<std::size_t>::max() / (table.entries.size() + 1);
  return options.step_limit ? std::min<std::size_t>(*options.step_limit, most) * (table.entries.size() + 1)
                            : std::numeric_limits<std::size_t>::max();
}

/// Accepts a selection that is better than the incumbent.
void offer(MaxCoverage& reach, const SignalTable& table, const std::vector<std::uint32_t>& selected) {
  Check check = check_selection(table, reach.problem, selected);
  const std::size_t reached = table.rows() - check.unmet.size();
  const bool better =
      reached > reach.reached || (reached == reach.reached && selected.size() < reach.selected.size());
  if (!check.allowed() || selected.size() > reach.at_most || !better) return;
  reach.selected = selected;
  reach.reached = reached;
  reach.missed = std::move(check.unmet);
}

}  // namespace

MaxCoverage maximise_coverage(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
                              const PlaceOptions& options, const RunControl& control) {
  const auto start = Clock::now();
  constexpr double endless_s = 1e8;
  const double limit_s = options.step_limit ? endless_s : options.time_limit_s;
  check_problem(table, problem);
  const auto backends = milp::backends_of(options.backend);

  MaxCoverage reach;
  reach.problem = problem;
  reach.problem.combination = Combination::lexicographic;
  reach.at_most = units;
  reach.solver = "greedy";
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed) reach.selected.push_back(j);
  if (reach.selected.size() > units)
    throw InputError("number of units",
                     fmt::format("is {}, but {} units are already installed", units, reach.selected.size()),
                     "use at least the number of installed units", Setting::units);
  units = std::min(units, table.columns());
  reach.missed = check_selection(table, problem, reach.selected).unmet;
  reach.reached = table.rows() - reach.missed.size();

  const bool may_ask = options.solver == SolverChoice::automatic || options.solver == SolverChoice::mip;
  const bool fits = CoverageModel::fits(table, problem);
  const bool uses_solver = may_ask && fits;
  reach.too_large = may_ask && !fits;
  const Deadline search_end((uses_solver ? 0.3 : 0.5) * limit_s),
      bound_end((uses_solver ? 0.5 : 1) * limit_s), end(limit_s);

  detail::CoverageSearch search(table, problem);
  search.improve_repeatedly(units, std::min(search_work, work_of(options, table)), control, search_end.end());
  offer(reach, table, search.selected());

  CoverageBound bound(table, problem, units);
  const auto lower_to = [&](std::size_t value, BoundProof proof) {
    if (value >= reach.upper_bound) return;
    reach.upper_bound = value;
    reach.bound_proof = proof;
  };
  reach.upper_bound = bound.labels(units);
  bound.improve(units, reach.reached, std::min<std::size_t>(1000, 1 + bound_work / (2 * bound.entries() + 1)),
                control, bound_end.end());
  lower_to(bound.labels(units), BoundProof::dual);

  if (uses_solver)
    for (const milp::Backend& backend : backends) {
      CoverageModel model(table, problem, units);
      const auto outcome =
          model.solve(limited(backend.solve, options.step_limit), end.seconds_left(), control);
      reach.solver = fmt::format("{} {}", backend.name, backend.version);
      lower_to(outcome.max_reached, BoundProof::solver);
      if (outcome.selected) offer(reach, table, *outcome.selected);
      if (!outcome.failed) break;
    }
  const bool was_cut_short = control.cancelled() || end.has_passed();
  reach.status = reach.upper_bound <= reach.reached ? Status::optimal
                 : uses_solver || was_cut_short     ? Status::stopped
                                                    : Status::feasible;
  reach.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return reach;
}

}  // namespace shelfbeam
