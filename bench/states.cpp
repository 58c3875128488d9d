// Examines plans for shops that change.
//
//   build/release/bench_states known [--repetitions N] [--jobs J]
//   build/release/bench_states shops [NAME]... [--states N] [--folder FOLDER] [--time-limit S] [--budget S]
//   build/release/bench_states cost [NAME]...
//   build/release/bench_states placement FILE [--sampled PART]... [--states N] [--time-limit S]
//
// known      many plans for a small shop whose availabilities are known: counts false statements. At 99 %
//            confidence, more than 6 of 200 plans with one have a probability below 0.5 %. The control takes
//            the observed availability without correction. Default: 200 repetitions, 2 at a time.
// shops      plans examples/NAME with people and stock that vary (default: thesis, grocery, supermarket), and
//            compares the plan for the shop as the file gives it with the plan over states
// cost       processor time of 100 states against a simulation with 2000 samples, all candidates of
//            examples/NAME (default: supermarket)
// placement  a placement over the first states (default: all) of a signal file of `simulate --states`, and
//            its steps; --sampled: over those of `simulate --states --for-plan`, with the labels and
//            candidates of the signal file

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/placement/scenarios/place_over_scenarios.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/parts/sampled_states.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "programs.hpp"
#include "support.hpp"
#include "unit/plan/states/known_states.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;
using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Settings {
  std::vector<std::string> names, sampled;
  std::size_t repetitions = 200;
  unsigned jobs = 2;
  fs::path folder = "states";
  std::uint32_t states = 100;
  double time_limit_s = 60, budget_s = 600;
};

// One label per aisle: just safe, just unsafe with one unit, and an aisle with a bad half.
void examine_known(const Settings& settings) {
  const test::KnownStates shop({{{0.03, 0.03}, {0.055, 0.055}, {0.01, 0.2}}});
  std::mutex guard;
  std::size_t certified = 0, wrong_plans = 0, wrong_bounds = 0, wrong = 0, at_its_word = 0, units = 0;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < settings.repetitions; k = next++) {
      RunControl control;
      control.threads = 1;
      const PlanOverStates plan = shop.plan(k + 1, {}, control);
      const Availability& found = plan.availability;
      const std::lock_guard lock(guard);
      const bool wrong_plan = found.certified && !shop.keeps_to(0.95, plan.placement.selected);
      const bool wrong_bound = found.lower_bound > static_cast<double>(shop.fewest());
      certified += found.certified ? 1 : 0;
      units += plan.placement.selected.size();
      wrong_plans += wrong_plan ? 1 : 0;
      wrong_bounds += wrong_bound ? 1 : 0;
      wrong += wrong_plan || wrong_bound ? 1 : 0;
      at_its_word += shop.keeps_to(0.95, found.sample_selected) ? 0 : 1;
    }
  };
  std::vector<std::thread> jobs;
  for (unsigned k = 0; k < settings.jobs; ++k) jobs.emplace_back(work);
  for (std::thread& job : jobs) job.join();
  fmt::print(
      "{} plans: {} certified, {:.2f} units on average; the fewest that keep every label at 95 %: {}\n"
      "  with a false statement: {} (plan {}, bound {}); more than 6 of 200 reject the confidence of 99 %\n"
      "  control, sampled availability without correction: {} false\n",
      settings.repetitions, certified, static_cast<double>(units) / static_cast<double>(settings.repetitions),
      shop.fewest(), wrong, wrong_plans, wrong_bounds, at_its_word);
}

// The example with stock and 5 to 20 people that vary.
fs::path varied_store(const Settings& settings, const std::string& name) {
  Json store = Json::parse(read_file(store_file(name)), nullptr, true, true);
  store["materials"]["clothes of people"] = {{"type", "lambertian"}, {"reflectance", 0.4}};
  store["variation"] = {{"stocking", {{"uniform", {0.4, 1}}}},
                        {"people",
                         {{{"area", "room"},
                           {"number", {{"uniform", {5, 20}}}},
                           {"size", {0.5, 0.3, 1.75}},
                           {"material", "clothes of people"}}}}};
  const fs::path folder = settings.folder / name;
  fs::create_directories(folder);
  fs::copy(store_file(name).parent_path(), folder,
           fs::copy_options::recursive | fs::copy_options::update_existing);
  write_file(folder / "varied.json", store.dump(1));
  return folder / "varied.json";
}

void print_outcome(const std::string& plan, const Json& outcome) {
  fmt::print("  {:<34} {:>5} {:>6} {:>5} {:>6.1f} % {:>6.1f} % {:>7.2f}\n", plan, outcome["units"].get<int>(),
             outcome["states"].get<int>(), outcome["labels_below"].get<int>(),
             100 * outcome["worst_availability"].get<double>(), 100 * outcome["all_reached"].get<double>(),
             outcome["mean_missed"].get<double>());
}

void plan_shop(const Settings& settings, const std::string& name) {
  const fs::path store = varied_store(settings, name), folder = settings.folder / (name + "-plan");
  Ended ended;
  const double seconds = wall_seconds([&] {
    ended = run_program({this_program(), "plan", store.string(), "-o", folder.string(), "--overwrite",
                         "--quiet", "--states", std::to_string(settings.states), "--time-limit",
                         fmt::format("{}", settings.time_limit_s), "--budget",
                         fmt::format("{}", settings.budget_s)});
  });
  const Json file = Json::parse(read_file(folder / "placement.json"));
  const Json& states = file["states"];
  fmt::print("{}: {:.0f} s ({:.0f} s of processor time); sample {} of at least {}, lower bound {}\n", name,
             seconds, ended.cpu_seconds, states["sample_value"].dump(), states["sample_lower_bound"].dump(),
             states["lower_bound"].dump());
  fmt::print("  {:<34} {:>5} {:>6} {:>5} {:>8} {:>8} {:>7}\n", "plan", "units", "states", "below", "worst",
             "all", "missed");
  print_outcome("for the shop as in the store file", states["nominal"]);
  print_outcome("fewest in the sampled states", states["sample"]);
  for (const Json& outcome : states["examined"]) print_outcome("examined in fresh states", outcome);
  fmt::print("  certified: {}; {}\n", states["certified"].dump(), states["open"].dump());
}

void compare_cost(const Settings& settings, const std::string& name) {
  const std::string store = varied_store(settings, name).string(),
                    output = (settings.folder / "cost.h5").string();
  const auto seconds = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command{this_program(), "simulate", store, "-o", output, "--quiet"};
    command.insert(command.end(), options.begin(), options.end());
    return run_program(command).cpu_seconds;
  };
  const double one = seconds({"--samples", "2000"}), states = seconds({"--states", "100"});
  fmt::print("{}: simulate --samples 2000 {:.1f} s, --states 100 {:.1f} s of processor time: {:.1f} times\n",
             name, one, states, states / one);
}

void place_file(const Settings& settings, const std::string& file) {
  const StoredSignals matrix = read_signal_file(file);
  const std::vector<fs::path> parts(settings.sampled.begin(), settings.sampled.end());
  const std::optional<SampledStates> sampled =
      parts.empty() ? std::nullopt : std::optional(SampledStates(parts));
  if (!sampled && !matrix.states) throw std::invalid_argument(file + " has no states");
  const std::vector<LabelId> labels = sampled ? all_numbers<LabelId>(matrix.rows()) : matrix.states->hard;
  const std::uint32_t states = std::min(sampled ? sampled->count() : matrix.states->states, settings.states);
  const std::size_t size = labels.size() * matrix.columns();
  ScenarioTable table = make_scenario_table(make_signal_table(matrix), labels, states);
  for (std::uint32_t s = 0; s < states; ++s) {
    if (sampled) {
      set_scenario(table, s, 0, sampled->state(s));
      continue;
    }
    const auto begin = matrix.states->signal.begin() + static_cast<std::ptrdiff_t>(s * size);
    set_scenario(table, s, 0,
                 {{begin, begin + static_cast<std::ptrdiff_t>(size)}, std::vector<float>(size, 0.0F)});
  }
  MissAllowance allowance;
  allowance.of_label.assign(labels.size(), allowed_misses(0.95, states));
  PlaceOptions options;
  options.time_limit_s = settings.time_limit_s;
  ScenarioPlacement found;
  const double seconds = wall_seconds([&] { found = place_over_scenarios(table, {}, allowance, options); });
  fmt::print("{}: {} units, at least {}, after {:.0f} s, {} placements on cuts, {} cuts\n", file, found.value,
             found.lower_bound, seconds, found.calls, found.cuts);
  fmt::print("  steps: {}\n", steps_json(found.steps));
}

void run(const std::string& what, const Settings& settings) {
  const auto each = [&](const std::vector<std::string>& names, const auto& use) {
    for (const std::string& name : settings.names.empty() ? names : settings.names) use(settings, name);
  };
  if (what == "known")
    examine_known(settings);
  else if (what == "shops")
    each({"thesis", "grocery", "supermarket"}, plan_shop);
  else if (what == "cost")
    each({"supermarket"}, compare_cost);
  else if (what == "placement")
    each({}, place_file);
  else
    throw std::invalid_argument("the first word must be known, shops, cost or placement");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Words words(argc, argv);
    const std::string what = words.any_left() ? words.next() : "";
    Settings settings;
    while (words.any_left()) {
      const std::string word = words.next();
      if (word == "--repetitions")
        settings.repetitions = std::stoul(words.value());
      else if (word == "--jobs")
        settings.jobs = static_cast<unsigned>(std::stoul(words.value()));
      else if (word == "--folder")
        settings.folder = words.value();
      else if (word == "--states")
        settings.states = static_cast<std::uint32_t>(std::stoul(words.value()));
      else if (word == "--time-limit")
        settings.time_limit_s = std::stod(words.value());
      else if (word == "--sampled")
        settings.sampled.push_back(words.value());
      else if (word == "--budget")
        settings.budget_s = std::stod(words.value());
      else
        settings.names.push_back(word);
    }
    run(what, settings);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_states: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
