#include "app/options/placement_options.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/names.hpp"

#include "app/options/arguments.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

std::string objective_help() {
  std::string help = "What to minimise beside the number of transceivers.";
  for (const ObjectiveWords& words : objective_words)
    help += fmt::format(" {}: {}{}", words.name, words.help, &words == &objective_words.back() ? "" : ";");
  return help;
}

}  // namespace

void add_question_options(CLI::App& verb, Question& question) {
  add_choice(verb, "--model", question.model,
             "cooperative: signals add up; non-cooperative: one unit must do");
  add_choice(verb, "--objective", question.objective, objective_help());
  auto* weighted = verb.add_flag_callback(
      "--weighted", [&question] { question.combination = Combination::weighted; },
      "Minimise the cost of units plus the objective");
  verb.add_flag("--lexicographic")
      ->description("Fewest transceivers first, then the objective (default)")
      ->excludes(weighted);
  verb.add_option("--share", question.share, "Share of the requirement from which an effective link counts")
      ->check(positive_number())
      ->capture_default_str();
  verb.add_flag("--survive-failure", question.redundant,
                "Every label stays reached when any one unit fails, installed ones included");
}

void add_solver_options(CLI::App& verb, PlaceOptions& options) {
  std::vector<std::string> names;
  for (const milp::Backend& backend : milp::backends()) names.emplace_back(backend.name);
  add_choice(verb, "--solver", options.solver,
             "auto: search, and a MIP solver where that is better; search: without a MIP solver; mip: a MIP "
             "solver alone; greedy: the paper's heuristic, not exact");
  verb.add_option("--backend", options.backend, fmt::format("MIP solver: {}", fmt::join(names, " or ")))
      ->check(CLI::IsMember(names));
  verb.add_option("--time-limit", options.time_limit_s, "Seconds for the answer, curve included")
      ->check(positive_number())
      ->capture_default_str();
}

void add_certificate_options(CLI::App& verb, CertificateFlags& flags) {
  verb.add_option("--confidence", flags.confidence, "Joint confidence of all that is certified")
      ->check(CLI::Range(0.5, 0.999999))
      ->capture_default_str();
  verb.add_option("--budget", flags.budget_s, "Seconds for verification and refinement")
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
