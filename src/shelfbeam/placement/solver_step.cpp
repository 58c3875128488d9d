#include "shelfbeam/placement/solver_step.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace shelfbeam::detail {

template <class Ask>
auto SolverStep::ask_in_turn(std::span<const milp::Backend> backends, const Ask& ask) {
  for (std::size_t k = 0;; ++k) {
    asked_ = fmt::format("{} {}", backends[k].name, backends[k].version);
    auto answer = ask(backends[k]);
    if (!answer.failed || k + 1 == backends.size()) return answer;
  }
}

LpBound SolverStep::raise_bound(const Effort& effort) {
  struct Relaxation : LpBound {
    bool failed = false;
  };
  const bool is_large = state_.table.entries.size() > state_.limits.most_small_lp_entries;
  const auto backends = is_large ? state_.solvers.for_large_lp : state_.solvers.preferred;
  Relaxation lp = ask_in_turn(backends, [&](const milp::Backend& backend) {
    Relaxation relaxation;
    if (state_.is_weighted) {
      relaxation = {lp_bound(state_.table, state_.question, state_.first_cost, backend,
                             {.time_limit_s = effort.seconds_left()}, state_.control)};
      state_.raise(relaxation.dual.bound, BoundProof::dual);
    } else {
      CountBound count =
          count_bound(state_.table, state_.question, backend, effort.seconds_left(), state_.control);
      state_.raise(static_cast<double>(count.count), BoundProof::dual);
      relaxation = {std::move(count.relaxation)};
    }
    relaxation.failed = relaxation.rounds == 0 && !state_.out_of_time();
    return relaxation;
  });
  relaxation_ = lp.dual;
  return lp;
}

LpBound SolverStep::bound_at_count(std::span<const double> cost, const Effort& effort) const {
  const std::size_t count = state_.incumbent.selected().size();
  return lp_bound(state_.table, state_.question, cost, state_.solvers.preferred.front(),
                  {.time_limit_s = effort.seconds_left(), .answers = {count, count}}, state_.control);
}

void SolverStep::ask_mip(const Effort& effort) {
  if (!state_.may_ask_mip()) return;
  const ReducedAnswer answer = state_.is_cover() ? ask_about_the_rest(effort) : ask_about_all(effort);
  state_.raise(answer.bound, BoundProof::solver);
  if (answer.proven) state_.incumbent.close_by_solver(answer.selected);
}

// Without the units that no better selection has, as their reduced costs show: with one of them it costs more
// than `worth`, which is just below the best known.
ReducedAnswer SolverStep::ask_about_the_rest(const Effort& effort) {
  const bool is_whole = state_.bounds.rounded(0.5) > 0.5;
  const double known = state_.incumbent.value();
  const double worth = is_whole ? known - 1 : known * (1 - equal_values);
  const std::vector<std::uint32_t> useless =
      relaxation_ ? useless_columns(*relaxation_, worth) : std::vector<std::uint32_t>{};
  ReducedAnswer answer = ask_in_turn(state_.solvers.preferred, [&](const milp::Backend& backend) {
    return place_reduced(state_.table, state_.question, state_.first_cost, state_.reduction(), useless,
                         within(backend), effort.seconds_left(), state_.control);
  });
  state_.offer(answer.selected);
  // Costs that are whole numbers leave nothing between `worth` and the best known.
  const double best = state_.incumbent.value();
  if (!useless.empty()) answer.bound = std::min(answer.bound, best - worth >= 0.5 ? best : worth);
  return answer;
}

ReducedAnswer SolverStep::ask_about_all(const Effort& effort) {
  Question first = state_.question;
  if (!state_.is_weighted) first.objective = Objective::count;
  ReducedAnswer answer = ask_in_turn(state_.solvers.preferred, [&](const milp::Backend& backend) {
    const MipAnswer mip = place_by_mip(state_.table, first, state_.incumbent.selected(), within(backend),
                                       effort.seconds_left(), state_.control);
    return ReducedAnswer{mip.placement.selected, mip.placement.lower_bound,
                         mip.placement.status == Status::optimal, mip.solver_failed};
  });
  state_.offer(answer.selected);
  return answer;
}

ReducedAnswer SolverStep::ask_mip_at_count(std::span<const double> cost, const Effort& effort) {
  return ask_in_turn(state_.solvers.preferred, [&](const milp::Backend& backend) {
    return place_at_count(state_.table, state_.question, cost, state_.incumbent.selected(), within(backend),
                          effort.seconds_left(), state_.control);
  });
}

}  // namespace shelfbeam::detail
