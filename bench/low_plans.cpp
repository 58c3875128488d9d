// Examines whether certificates hold in a shop with labels just above the floor under a low ceiling, where
// standard errors were once too small. This build and an earlier one make many plans of a store whose
// solution is known.
//
//   build/release/bench_low_plans [--before PROGRAM] [--plans N] [--jobs J] [--budget S] [--folder FOLDER]
//   [--reference N]
//
// --before     an earlier program for comparison
// --plans      plans per program, with seeds 1, 2, ... (default: 200)
// --jobs       plans that run at the same time, on one thread each (default: 2)
// --budget     seconds for the certificate of a plan (default: 30)
// --folder     folder of the store, its reference and the plans (default: low_plans). The same command
//              continues there. Delete it when a program has changed.
// --reference  samples per label of the reference (default: 20,000,000, which takes some minutes)
//
// At 99 %, at most two wrong plans of 200 are expected; more than 6 have a probability below 0.5 %.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/parallel.hpp"

#include "low_shop.hpp"
#include "programs.hpp"
#include "support.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;
using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr double confidence = 0.99;

struct Settings {
  std::string earlier_program;  ///< empty: none
  std::size_t plans = 200;
  int jobs = 2;
  int budget_s = 30;
  fs::path folder = "low_plans";
  std::uint64_t reference_samples = 20000000;
};

/// Counts of plans.
struct Tally {
  std::size_t plans = 0;
  std::size_t wrong = 0;  ///< plans with a false statement; the four kinds below may occur in one plan
  std::size_t wrongly_reached = 0, wrongly_missed = 0, bound_too_high = 0, no_selection = 0;
  std::size_t more_units = 0, undecided = 0;
  std::size_t verdicts = 0, bounds = 0;  ///< examined verdicts on labels; examined bounds on the count
  std::size_t too_near = 0;              ///< verdicts on labels too near the requirement for the reference
  double cpu_seconds = 0;
};

/// A program, and whether its plans are certified.
struct Planner {
  std::string name;
  std::string program;
  bool certifies = true;
};

/// A finished plan: placement.json, and its CPU time.
struct Plan {
  Json placement;
  double cpu_seconds = 0;
};

Plan planned(const Settings& settings, const LowShop& shop, const Planner& planner, std::size_t seed) {
  const fs::path folder = settings.folder / fmt::format("{}-{}-{}-{}", planner.name,
                                                        settings.reference_samples, settings.budget_s, seed);
  const fs::path answer = folder / "placement.json", kept = folder / "kept.json";
  if (!fs::exists(kept)) {
    fs::remove_all(folder);
    std::vector<std::string> command{planner.program, "plan", shop.file().string(), "-o", folder.string()};
    command.insert(command.end(), {"--samples", "2000", "--seed", std::to_string(seed)});
    command.insert(command.end(), {"--threads", "1", "--quiet"});
    if (planner.certifies)
      command.insert(command.end(), {"--budget", std::to_string(settings.budget_s), "--confidence",
                                     fmt::format("{}", confidence)});
    else
      command.emplace_back("--no-certificate");
    const Ended ended = run_program(command);
    // Plans without a selection or with open statements count, too.
    if (ended.exit_code != 0 && ended.exit_code != 1 && ended.exit_code != 3)
      throw std::runtime_error(
          fmt::format("'{} plan' ended with exit code {}", planner.program, ended.exit_code));
    const Json plan{{"placement", Json::parse(read_file(answer))}, {"cpu_seconds", ended.cpu_seconds}};
    // The matrices and reports of many plans would fill the disk.
    for (const auto& file : fs::directory_iterator(folder)) fs::remove(file);
    write_file(kept, plan.dump());
  }
  const Json plan = Json::parse(read_file(kept));
  return {plan["placement"], plan["cpu_seconds"]};
}

// Compares verdicts with the truth. Labels that are neither missed nor undecided are certified as reached.
void examine_labels(const LowShop& shop, const Json& certificate, const std::vector<std::size_t>& selected,
                    Tally& found) {
  const std::set<std::string> missed = certificate["missed"], undecided = certificate["undecided"];
  for (std::size_t i = 0; i < shop.reference().rows(); ++i) {
    const std::string& id = shop.reference().labels[i].id;
    if (undecided.count(id) > 0) continue;
    const LowShop::Sum truth = shop.sum(i, selected);
    ++found.verdicts;
    if (!truth.is_clear) {
      ++found.too_near;
    } else if (missed.count(id) > 0) {
      found.wrongly_missed += truth.is_reached ? 1 : 0;
    } else {
      found.wrongly_reached += truth.is_reached ? 0 : 1;
    }
  }
}

// The statements of a plan in the form of a certificate. An uncertified plan has no undecided labels.
Json statement(const Planner& planner, const Json& placement) {
  if (planner.certifies) return placement["certificate"];
  Json missed = Json::array();
  for (const Json& label : placement["unreachable"]) missed.push_back(label["label"]);
  const Json& bound = placement["count_lower_bound"];
  return {{"missed", missed},
          {"undecided", Json::array()},
          {"count_lower_bound", bound.is_null() ? Json(0) : bound},
          {"open", ""}};
}

Tally examine(const LowShop& shop, const Planner& planner, const Plan& plan) {
  Tally found;
  found.plans = 1;
  found.cpu_seconds = plan.cpu_seconds;
  // The plan was stopped before it had anything to certify.
  if (planner.certifies && !plan.placement.contains("certificate")) {
    found.undecided = 1;
    return found;
  }
  const Json said = statement(planner, plan.placement);
  std::map<std::string, std::size_t> columns;
  for (const TransceiverColumn& unit : shop.reference().transceivers)
    columns.emplace(unit.id, columns.size());
  std::vector<std::size_t> selected;
  for (const std::string id : plan.placement["selected"]) selected.push_back(columns.at(id));
  if (!selected.empty()) {
    examine_labels(shop, said, selected, found);
  } else if (!said["missed"].empty()) {
    // The plan states that no selection reaches these labels, but some do.
    found.verdicts = said["missed"].size();
    found.no_selection = 1;
  }
  const std::size_t bound = said["count_lower_bound"];
  found.bounds = bound > 0 ? 1 : 0;
  found.bound_too_high = bound > LowShop::units ? 1 : 0;
  found.more_units = selected.size() > LowShop::units ? 1 : 0;
  found.undecided = said["open"].get<std::string>().empty() ? 0 : 1;
  for (std::size_t* kind : {&found.wrongly_reached, &found.wrongly_missed}) *kind = *kind > 0 ? 1 : 0;
  found.wrong =
      found.wrongly_reached + found.wrongly_missed + found.bound_too_high + found.no_selection > 0 ? 1 : 0;
  return found;
}

void add(Tally& sum, const Tally& more) {
  for (const auto count : {&Tally::plans, &Tally::wrong, &Tally::wrongly_reached, &Tally::wrongly_missed,
                           &Tally::bound_too_high, &Tally::no_selection, &Tally::more_units,
                           &Tally::undecided, &Tally::verdicts, &Tally::bounds, &Tally::too_near})
    sum.*count += more.*count;
  sum.cpu_seconds += more.cpu_seconds;
}

// The probability of at least `wrong` wrong plans if each is wrong with probability 1 - confidence.
double chance_of(std::size_t wrong, std::size_t plans) {
  const double p = 1 - confidence;
  const auto n = static_cast<double>(plans);
  double fewer = 0;
  for (std::size_t k = 0; k < wrong; ++k) {
    const auto x = static_cast<double>(k);
    const double ways = std::lgamma(n + 1) - std::lgamma(x + 1) - std::lgamma(n - x + 1);
    fewer += std::exp(ways + x * std::log(p) + (n - x) * std::log1p(-p));
  }
  return std::max(0.0, 1 - fewer);
}

struct Column {
  std::string name;
  Tally tally;
};

void print(const LowShop& shop, const std::vector<Column>& columns) {
  const SignalMatrix& reference = shop.reference();
  fmt::print(
      "{} labels, {} candidates, requirement {:.5f}: {} units exceed it by {:.2f} %, {} miss by {:.2f} %\n",
      reference.rows(), reference.columns(), shop.requirement(), LowShop::units, 100 * shop.margin(),
      LowShop::units - 1, -100 * shop.margin_of_fewer());
  double largest = 0;
  for (std::size_t i = 0; i < reference.rows(); ++i) {
    const LowShop::Sum sum = shop.sum(i, shop.best());
    largest = std::max(largest, sum.error / sum.signal);
  }
  fmt::print("standard errors of the reference there: up to {:.3f} %\n\n", 100 * largest);
  const auto line = [&](const std::string& title, const auto& cell) {
    fmt::print("{:<48}", title);
    for (const Column& column : columns) fmt::print(" {:>15}", cell(column.tally));
    fmt::print("\n");
  };
  const auto count = [&](const std::string& title, std::size_t Tally::*member) {
    line(title, [&](const Tally& tally) { return std::to_string(tally.*member); });
  };
  fmt::print("{:<48}", "");
  for (const Column& column : columns) fmt::print(" {:>15}", column.name);
  fmt::print("\n");
  count("plans", &Tally::plans);
  count("with a wrong statement", &Tally::wrong);
  count("  a label reached that is not", &Tally::wrongly_reached);
  count("  a label missed that is not", &Tally::wrongly_missed);
  count("  a lower bound that is too high", &Tally::bound_too_high);
  count("  no selection", &Tally::no_selection);
  line(fmt::format("probability of this number at {:g} %", 100 * confidence),
       [](const Tally& tally) { return fmt::format("{:.2g}", chance_of(tally.wrong, tally.plans)); });
  count(fmt::format("with more than {} units", LowShop::units), &Tally::more_units);
  count("undecided", &Tally::undecided);
  count("verdicts examined", &Tally::verdicts);
  count("  too near the requirement for the reference", &Tally::too_near);
  count("bounds examined", &Tally::bounds);
  line("CPU time per plan, s", [](const Tally& tally) {
    return fmt::format("{:.2f}", tally.cpu_seconds / static_cast<double>(tally.plans));
  });
}

void run(const Settings& settings) {
  const LowShop shop(settings.folder, settings.reference_samples);
  std::vector<Planner> planners{{"now", this_program()}, {"uncertified", this_program(), false}};
  if (!settings.earlier_program.empty()) planners.push_back({"before", settings.earlier_program});
  std::vector<Tally> found(settings.plans * planners.size());
  std::atomic<std::size_t> done{0};
  const ThreadLimit allowed(static_cast<unsigned>(settings.jobs));
  tbb::task_arena(settings.jobs).execute([&] {
    for_each_task(found.size(), [&](std::size_t k) {
      const Planner& planner = planners[k % planners.size()];
      found[k] = examine(shop, planner, planned(settings, shop, planner, 1 + k / planners.size()));
      fmt::print(stderr, "{} of {} plans\n", ++done, found.size());
    });
  });
  std::vector<Column> columns(planners.size());
  for (std::size_t k = 0; k < planners.size(); ++k) columns[k].name = planners[k].name;
  for (std::size_t k = 0; k < found.size(); ++k) add(columns[k % planners.size()].tally, found[k]);
  print(shop, columns);
}

Settings parse(int argc, char** argv) {
  Settings settings;
  bench::Words words(argc, argv);
  while (words.any_left()) {
    const std::string word = words.next();
    if (word == "--before")
      settings.earlier_program = words.value();
    else if (word == "--plans")
      settings.plans = std::stoul(words.value());
    else if (word == "--jobs")
      settings.jobs = std::stoi(words.value());
    else if (word == "--budget")
      settings.budget_s = std::stoi(words.value());
    else if (word == "--folder")
      settings.folder = words.value();
    else if (word == "--reference")
      settings.reference_samples = std::stoull(words.value());
    else
      throw std::invalid_argument("unknown option " + word);
  }
  if (settings.plans < 1 || settings.jobs < 1)
    throw std::invalid_argument("--plans and --jobs must be at least 1");
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
