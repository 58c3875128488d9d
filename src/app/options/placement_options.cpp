#include "app/options/placement_options.hpp"

#include <vector>

#include <fmt/format.h>

#include "shelfbeam/milp/solver.hpp"

#include "app/options/arguments.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

Question QuestionFlags::question() const {
  Question question;
  question.model =
      model == "cooperative" ? CommunicationModel::cooperative : CommunicationModel::non_cooperative;
  question.objective = objective == "count"    ? Objective::count
                       : objective == "links"  ? Objective::links
                       : objective == "signal" ? Objective::signal
                                               : Objective::effective_links;
  question.combination = weighted ? Combination::weighted : Combination::lexicographic;
  question.share = share;
  question.redundant = survive_failure;
  return question;
}

PlaceOptions SolverFlags::options(std::uint64_t seed) const {
  PlaceOptions options;
  options.solver = solver == "auto"     ? SolverChoice::automatic
                   : solver == "search" ? SolverChoice::search
                   : solver == "mip"    ? SolverChoice::mip
                                        : SolverChoice::greedy;
  options.backend = backend;
  options.time_limit_s = time_limit_s;
  options.seed = seed;
  return options;
}

void add_question_options(CLI::App& verb, QuestionFlags& flags) {
  verb.add_option("--model", flags.model, "cooperative: signals add up; non-cooperative: one unit must do")
      ->check(CLI::IsMember({"cooperative", "non-cooperative"}))
      ->capture_default_str();
  verb.add_option("--objective", flags.objective, "What to minimise beside the number of transceivers")
      ->check(CLI::IsMember({"count", "links", "effective-links", "signal"}))
      ->capture_default_str();
  auto* weighted =
      verb.add_flag("--weighted", flags.weighted, "Minimise the cost of units plus the objective");
  verb.add_flag("--lexicographic", flags.lexicographic,
                "Fewest transceivers first, then the objective (default)")
      ->excludes(weighted);
  verb.add_option("--share", flags.share, "Share of the requirement from which an effective link counts")
      ->check(positive_number())
      ->capture_default_str();
  verb.add_flag("--survive-failure", flags.survive_failure,
                "Every label stays reached when any one unit fails, installed ones included");
}

void add_solver_options(CLI::App& verb, SolverFlags& flags, double default_time_limit_s) {
  flags.time_limit_s = default_time_limit_s;
  std::vector<std::string> names;
  for (const milp::Backend& backend : milp::backends()) names.emplace_back(backend.name);
  verb.add_option(
          "--solver", flags.solver,
          "auto: search, and a MIP solver where that is better; search: without a MIP solver; mip: a MIP "
          "solver alone; greedy: the paper's heuristic, not exact")
      ->check(CLI::IsMember({"auto", "search", "mip", "greedy"}))
      ->capture_default_str();
  verb.add_option("--backend", flags.backend, fmt::format("MIP solver: {}", fmt::join(names, " or ")))
      ->check(CLI::IsMember(names));
  verb.add_option("--time-limit", flags.time_limit_s, "Seconds for the answer, curve included")
      ->check(positive_number())
      ->capture_default_str();
}

int exit_code(Status status) {
  switch (status) {
    case Status::optimal:
    case Status::feasible:
      return done;
    case Status::infeasible:
      return answer_is_no;
    case Status::stopped:
      return stopped_early;
  }
  return internal_error;
}

}  // namespace shelfbeam::app
