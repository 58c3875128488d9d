#include "app/options/placement_options.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/signal/constraints/conflicts.hpp"
#include "shelfbeam/signal/tables/formats.hpp"

#include "app/options/arguments.hpp"
#include "jobs/steps/scenarios.hpp"

namespace shelfbeam::app {

namespace {

std::string objective_help() {
  std::string help = "Objective in addition to the number of transceivers.";
  for (const ObjectiveWords& words : objective_words)
    help += fmt::format(" {}: {}{}", words.name, words.help, &words == &objective_words.back() ? "" : ";");
  return help;
}

}  // namespace

void protect_constraints(const std::filesystem::path& output, const TableConstraints& constraints) {
  for (const auto& file : constraints.costs) protect_input(output, file);
  for (const auto& file : constraints.forbidden) protect_input(output, file);
}

void add_requirement_options(CLI::App& verb, TableConstraints& constraints) {
  const OptionGroup placement(verb, group::placement);
  placement.add_files(
      "--costs", constraints.costs,
      "CSV with columns id,cost (transceivers) or id,link_cost,signal_cost (labels); repeatable");
  placement.add("--min-spacing", constraints.min_spacing, positive_number("METRES"),
                "Minimum distance in metres of each new transceiver from all others");
  placement.add_files("--forbid", constraints.forbidden,
                      "CSV with columns a,b: pairs of transceivers that must not both be chosen; repeatable");
}

void add_unit_options(CLI::App& verb, UnitChoice& units) {
  const OptionGroup placement(verb, group::placement);
  const auto add = [&](const char* flag, std::vector<std::string>& ids, const char* help) {
    placement.add(flag, ids, an_id(), help)->allow_extra_args(false);
  };
  add("--pin", units.pinned,
      "New transceiver that is part of the plan, at its price: an id, or a pattern with '*' and '?'; "
      "repeatable");
  add("--exclude", units.excluded,
      "Transceiver that is not part of the plan: an id, or a pattern with '*' and '?'; repeatable");
}

void add_partial_options(CLI::App& verb, PartialQuestion& question) {
  const OptionGroup first(verb);
  auto* at_most =
      first.add("--at-most", question.at_most, whole_number("K", 1),
                "Reach as many labels as possible with at most K transceivers, instead of all labels");
  first
      .add("--reach", question.share, a_share("SHARE", {0, 1, false, true}),
           "Reach this share of the labels, e.g. 0.95 or 95%, with as few transceivers as possible, instead "
           "of "
           "all labels")
      ->excludes(at_most);
}

void PlacementInput::keep(const std::filesystem::path& output) const {
  for (const auto& file : signals) protect_input(output, file);
  protect_constraints(output, constraints);
}

ReadTable PlacementInput::table(const PlacementProblem& problem) const {
  auto [table, warnings] = jobs::read_scenarios(signals, reading);
  const std::string name = jobs::names_of_files(signals);
  if (threshold > 0) set_requirement(table, threshold);
  units.apply(table, name);
  constraints.apply(table, name);
  try {
    check_problem(table, problem);
  } catch (const InputError& error) {
    throw InputError(name, error.what(), {}, error.setting());
  }
  return {std::move(table), std::move(warnings)};
}

void add_placement_input(CLI::App& verb, PlacementInput& input) {
  const OptionGroup first(verb);
  first.require(
      "SIGNAL", input.signals, a_path("FILE..."),
      fmt::format("Signal file (HDF5, from trusted sources only), {}; several files are scenarios of one "
                  "placement",
                  detail::matrix_formats));
  first.add("--threshold", input.threshold, positive_number("SIGNAL"),
            "Signal that every label requires, in place of the requirements in the file; required for CSV "
            "and NPY");
  OptionGroup(verb, group::placement)
      .add_choice("--read-as", input.reading,
                  "How to read a text file that fits several formats. signals: CSV without ids; header: ids "
                  "of transceivers in the first row; labels: ids of labels in the first column; ids: both; "
                  "sparse: sparse text; scp, rail: forms of OR-Library files; auto (default): reject such a "
                  "file");
  add_requirement_options(verb, input.constraints);
  add_unit_options(verb, input.units);
}

void add_problem_options(CLI::App& verb, PlacementProblem& problem) {
  const OptionGroup first(verb), placement(verb, group::placement);
  first.add_choice("--model", problem.model,
                   "cooperative (default): signals of several units add up; non-cooperative: one unit alone "
                   "must reach the label");
  first.add_flag("--survive-failure", problem.redundant,
                 "Every label must be reached even if any one unit fails, including installed units");
  placement.add_choice("--objective", problem.objective, objective_help());
  problem.combination = Combination::automatic;
  auto* weighted = placement.add_flag_call(
      "--weighted", [&problem] { problem.combination = Combination::weighted; },
      "Minimise the sum of the units' costs and the objective");
  placement
      .add_flag_call(
          "--lexicographic", [&problem] { problem.combination = Combination::lexicographic; },
          "Minimise the number of transceivers first, then the objective (default unless the "
          "candidates' costs differ: then the new spend first, then the number)")
      ->excludes(weighted);
  placement.add(
      "--share", problem.share, a_share("SHARE", any_share),
      fmt::format("Minimum share of the requirement for an effective link; default {}", problem.share));
}

void add_solver_options(CLI::App& verb, PlaceOptions& options) {
  const OptionGroup placement(verb, group::placement);
  std::vector<std::string> names;
  for (const milp::Backend& backend : milp::backends()) names.emplace_back(backend.name);
  placement.add_choice("--solver", options.solver,
                       "auto (default): search, supported by a MIP solver; search: without a MIP solver; "
                       "mip: a MIP solver alone; greedy: the paper's heuristic, not exact");
  placement.add("--backend", options.backend, one_of(names),
                "MIP solver; default: the first that is built in");
  placement.add("--time-limit", options.time_limit_s, positive_number("SECONDS"),
                fmt::format("Time limit of the placement in seconds, curve included; default {}",
                            options.time_limit_s));
}

void add_certificate_options(CLI::App& verb, double& confidence, double& budget_s) {
  const OptionGroup certificate(verb, group::certificate);
  certificate.add("--confidence", confidence, a_share("LEVEL", {0.5, 0.999999, true, true}),
                  fmt::format("Confidence that all statements of the certificate hold, e.g. 0.999 or 99.9%; "
                              "default {}",
                              confidence));
  certificate.add("--budget", budget_s, positive_number("SECONDS"),
                  fmt::format("Time limit of the certificate in seconds; default {}", budget_s));
}

void add_state_options(CLI::App& verb, std::optional<std::uint32_t>& states, const std::string& text,
                       AvailabilityGoal& goal) {
  const OptionGroup group(verb, group::states);
  group.add("--states", states, whole_number("N", 0, 10'000), text);
  const auto add = [&](const char* flag, AvailabilityRule rule, const CLI::Validator& kind,
                       const char* help) {
    return group.add_call<double>(flag, [&goal, rule](double value) { goal = {rule, value}; }, kind, help);
  };
  auto* labels = add("--availability", AvailabilityRule::labels, a_share("SHARE", {0.5, 0.9999, true, true}),
                     "Minimum share of the states in which each label is reached, e.g. 0.95 or 95%; default: "
                     "that of its label type");
  auto* shop = add("--all-at-once", AvailabilityRule::shop, a_share("SHARE", {0.01, 0.9999, true, true}),
                   "Instead, minimum share of the states in which all labels are reached at once")
                   ->excludes(labels);
  add("--mean-missed", AvailabilityRule::misses, positive_number("LABELS"),
      "Instead, maximum mean number of missed labels")
      ->excludes(labels)
      ->excludes(shop);
}

void add_without(CLI::App& verb, std::vector<Cause>& without) {
  verb.add_option_function<std::vector<std::string>>(
          "--without",
          [&without](const std::vector<std::string>& keys) {
            for (const std::string& key : keys) without.push_back(cause_of_key(key));
          },
          fmt::format(
              "Leave these changes out: keys of 'variation' ('mounting' includes 'unit_power_db'), or "
              "'reflectances' for their ranges. {}",
              fmt::join(cause_keys, ", ")))
      ->transform(one_of({cause_keys.begin(), cause_keys.end()}))
      ->option_text("KEY...")
      ->group(group::states);
}

}  // namespace shelfbeam::app
