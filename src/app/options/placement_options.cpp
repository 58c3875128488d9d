#include "app/options/placement_options.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/signal/constraints/apart.hpp"
#include "shelfbeam/signal/constraints/stack_tables.hpp"
#include "shelfbeam/signal/tables/formats.hpp"

#include "app/options/arguments.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

using Path = std::filesystem::path;

/// The last `parts` of a path, or all of it.
std::string tail(const Path& path, std::ptrdiff_t parts) {
  const std::ptrdiff_t all = std::distance(path.begin(), path.end());
  Path result;
  for (auto part = std::next(path.begin(), all - std::min(all, parts)); part != path.end(); ++part)
    result /= *part;
  return result.string();
}

/// The shortest tail of paths[k] that no other path has; empty where there is none.
std::string distinct_tail(const std::vector<Path>& paths, std::size_t k) {
  std::ptrdiff_t most = 0;
  for (const Path& path : paths) most = std::max(most, std::distance(path.begin(), path.end()));
  for (std::ptrdiff_t parts = 1; parts <= most; ++parts) {
    std::string name = tail(paths[k], parts);
    const auto has_it = [&](const Path& other) { return tail(other, parts) == name; };
    if (std::count_if(paths.begin(), paths.end(), has_it) == 1) return name;
  }
  return {};
}

std::string names_of(const std::vector<std::filesystem::path>& files) {
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "" : ", ") + file.string();
  return names;
}

std::string objective_help() {
  std::string help = "What to minimise beside the number of transceivers.";
  for (const ObjectiveWords& words : objective_words)
    help += fmt::format(" {}: {}{}", words.name, words.help, &words == &objective_words.back() ? "" : ";");
  return help;
}

}  // namespace

void Requirements::keep(const std::filesystem::path& output) const {
  for (const auto& file : costs) keep_input(output, file);
  for (const auto& file : forbidden) keep_input(output, file);
}

void Requirements::apply(SignalTable& table, const std::string& name) const {
  for (const auto& file : costs) apply_costs(table, file);
  for (const auto& file : forbidden) forbid_pairs(table, file);
  if (min_spacing > 0) keep_apart(table, min_spacing, name);
}

void add_requirement_options(CLI::App& verb, Requirements& requirements) {
  verb.add_option("--costs", requirements.costs,
                  "CSV 'id,cost' of transceivers or 'id,link_cost,signal_cost' of labels; may be repeated")
      ->allow_extra_args(false)
      ->check(a_path());
  verb.add_option("--min-spacing", requirements.min_spacing,
                  "Choose no two transceivers closer than this, m (installed ones stay where they are)")
      ->check(positive_number());
  verb.add_option("--forbid", requirements.forbidden,
                  "CSV 'a,b' of transceivers that must not be chosen together; may be repeated")
      ->allow_extra_args(false)
      ->check(a_path());
}

std::vector<std::string> scenario_names(const std::vector<Path>& files) {
  std::vector<Path> whole, bare;
  for (const Path& file : files) {
    whole.push_back(file.lexically_normal());
    bare.push_back(whole.back().parent_path() / whole.back().stem());
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < files.size(); ++k) {
    std::string name = distinct_tail(bare, k);
    if (name.empty()) name = distinct_tail(whole, k);
    names.push_back(name.empty() ? whole[k].stem().string() : name);
  }
  return names;
}

void PlacementInput::keep(const std::filesystem::path& output) const {
  for (const auto& file : signals) keep_input(output, file);
  requirements.keep(output);
}

SignalTable PlacementInput::table(const Question& question) const {
  const std::vector<std::string> scenario = scenario_names(signals);
  std::vector<NamedTable> scenarios;
  for (std::size_t k = 0; k < signals.size(); ++k)
    scenarios.push_back({scenario[k], signals[k].string(), read_signal_table(signals[k])});
  SignalTable table = stack_tables(std::move(scenarios));
  const std::string name = names_of(signals);
  if (threshold > 0) set_requirement(table, threshold);
  requirements.apply(table, name);
  try {
    check_question(table, question);
  } catch (const InputError& error) {
    throw InputError(name, error.what(), {}, error.setting());
  }
  return table;
}

void add_placement_input(CLI::App& verb, PlacementInput& input) {
  verb.add_option("SIGNAL", input.signals,
                  fmt::format("Signal file (HDF5; not safe to open if a stranger made it), {}; several are "
                              "scenarios for one placement",
                              detail::matrix_formats))
      ->required()
      ->check(a_path());
  verb.add_option("--threshold", input.threshold,
                  "Requirement of every label: for matrices without one, or instead of the file's")
      ->check(positive_number());
  add_requirement_options(verb, input.requirements);
}

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
  if (status == Status::infeasible) return answer_is_no;
  return status == Status::stopped ? stopped_early : done;
}

}  // namespace shelfbeam::app
