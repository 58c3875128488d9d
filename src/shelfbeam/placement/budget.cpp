#include "shelfbeam/placement/budget.hpp"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/checker.hpp"
#include "shelfbeam/placement/detail/reach_model.hpp"
#include "shelfbeam/placement/detail/reach_search.hpp"
#include "shelfbeam/placement/reach_bound.hpp"

namespace shelfbeam {

namespace {

// Entries looked at, so that answers do not depend on the machine: about ten seconds each.
constexpr std::size_t search_work = 2'000'000'000;
constexpr std::size_t bound_work = 4'000'000'000;

std::vector<milp::Backend> wanted_backends(const PlaceOptions& options) {
  if (options.solver == SolverChoice::greedy) return {};
  const auto all = milp::backends();
  if (options.backend.empty()) return {all.begin(), all.end()};
  std::vector<std::string_view> known;
  for (const milp::Backend& backend : all) {
    if (backend.name == options.backend) return {backend};
    known.push_back(backend.name);
  }
  throw InputError("MIP back end", fmt::format("'{}' is not built in", options.backend),
                   suggest(options.backend, known));
}

/// Takes a selection that is better than the one so far.
bool offer(Reach& reach, const SignalTable& table, const std::vector<std::uint32_t>& selected) {
  Check check = check_selection(table, reach.question, selected);
  const std::size_t reached = table.rows() - check.unmet.size();
  const bool better =
      reached > reach.reached || (reached == reach.reached && selected.size() < reach.selected.size());
  if (!check.allowed() || selected.size() > reach.at_most || !better) return false;
  reach.selected = selected;
  reach.reached = reached;
  reach.missed = std::move(check.unmet);
  return true;
}

}  // namespace

Reach reach_most(const SignalTable& table, const Question& question, std::size_t units,
                 const PlaceOptions& options, const RunControl& control) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  check_question(table, question);
  const auto backends = wanted_backends(options);

  Reach reach;
  reach.question = question;
  reach.at_most = units;
  reach.solver = "greedy";
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed) reach.selected.push_back(j);
  if (reach.selected.size() > units)
    throw InputError("--at-most",
                     fmt::format("is {}, and {} units are installed already", units, reach.selected.size()),
                     "allow at least these");
  reach.missed = check_selection(table, question, reach.selected).unmet;
  reach.reached = table.rows() - reach.missed.size();

  detail::ReachSearch search(table, question);
  search.improve(units, search_work, control);
  offer(reach, table, search.selected());

  ReachBound bound(table, question, units);
  bound.improve(units, reach.reached, std::min<std::size_t>(1000, 1 + bound_work / (2 * bound.entries() + 1)),
                control);
  reach.upper_bound = bound.labels(units);

  if (detail::ReachModel::fits(table, question))
    for (const milp::Backend& backend : backends) {
      detail::ReachModel model(table, question, units);
      const auto outcome = model.solve(backend.solve, options.time_limit_s - elapsed(), control);
      reach.solver = fmt::format("{} {}", backend.name, backend.version);
      reach.upper_bound = std::min(reach.upper_bound, outcome.most_reached);
      if (outcome.selected) offer(reach, table, *outcome.selected);
      if (!outcome.failed) break;
    }
  reach.status = reach.upper_bound <= reach.reached       ? Status::optimal
                 : options.solver == SolverChoice::greedy ? Status::feasible
                                                          : Status::stopped;
  reach.seconds = elapsed();
  return reach;
}

}  // namespace shelfbeam
