#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/mip/mip.hpp"
#include "shelfbeam/placement/placement_search.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The labels that no selection meets, whatever becomes of the others.
std::vector<Unreachable> unreachable_labels(const SignalTable& table, const Question& question) {
  // Sums of another order round differently where points have options or a unit may fail. Who is
  // this near to the rule's edge is left to the search.
  const double rounding = table.mounts.empty() && !question.redundant ? 1 : 1 + 1e-12;
  const Mounts mounts(table);
  std::vector<Unreachable> result;
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    const double requirement = requirement_of(table.labels[i], question.model);
    const double most = mounts.most_signal(table.row(i), question);
    if (!is_met(most * rounding, requirement)) result.push_back({i, requirement, most});
  }
  return result;
}

Placement infeasible(const SignalTable& table, const Question& question,
                     std::vector<Unreachable> unreachable) {
  Placement placement;
  placement.question = question;
  placement.status = Status::infeasible;
  placement.objective_value = placement.lower_bound = placement.count_lower_bound = infinite;
  placement.unit_costs = label_costs(table, question.objective).unit;
  placement.unreachable = std::move(unreachable);
  return placement;
}

using Selection = std::optional<std::vector<std::uint32_t>>;

/// A selection with the bounds that need no search.
Placement greedy_placement(const SignalTable& table, const Question& question, const Selection& selected) {
  Placement placement = place_by_mip(table, question, selected, {}, 0, {}).placement;
  placement.status = selected ? Status::feasible : Status::stopped;
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
  const ThreadsAllowed allowed(control.threads);
  const auto backends = milp::wanted_backends(options.backend);

  Placement placement;
  if (auto unreachable = unreachable_labels(table, question); !unreachable.empty()) {
    placement = infeasible(table, question, std::move(unreachable));
  } else {
    const bool without_mip = options.solver == SolverChoice::search;
    const bool searches = without_mip || options.solver == SolverChoice::automatic;
    const auto left = [&] { return options.step_limit ? infinite : options.time_limit_s - elapsed(); };
    const std::vector<std::uint32_t> greedy = greedy_selection(table, question);
    Selection known;
    if (check_selection(table, question, greedy).met())
      known = greedy;
    else if (searches)
      known = detail::first_selection(table, question, greedy, 0.2 * left(), options.seed, control);
    if (options.solver == SolverChoice::greedy) {
      placement = greedy_placement(table, question, known);
    } else if (known && searches) {
      placement = detail::search_placement(
          table, question, *known, {backends, without_mip}, left(), options.seed, control,
          {.settles_ties = options.settles_ties, .step_limit = options.step_limit});
    } else if (without_mip ||
               (searches && table.entries.size() > detail::SearchLimits{}.most_model_entries)) {
      placement = greedy_placement(table, question, known);
      placement.solver = "search";
    } else {
      for (const milp::Backend& backend : backends) {
        MipAnswer answer =
            place_by_mip(table, question, known, limited(backend.solve, options.step_limit), left(), control);
        placement = std::move(answer.placement);
        placement.solver = fmt::format("{} {}", backend.name, backend.version);
        if (!answer.solver_failed) break;
      }
      // What the solver adds to the bounds that need none rests on its word.
      const Placement plain = greedy_placement(table, question, known);
      if (placement.count_lower_bound > plain.count_lower_bound || placement.lower_bound > plain.lower_bound)
        placement.bound_proof = BoundProof::solver;
    }
  }
  placement.min_spacing = table.min_spacing;
  placement.forbidden_pairs = table.apart.size();
  placement.seconds = elapsed();
  return placement;
}

}  // namespace shelfbeam
