// Examines whether certificates hold, and how many questions they decide, in small shops whose solutions are
// known by enumeration: labels just above the floor under a low ceiling, aisles, a hall, and a shop with a
// back room whose unit decides. This build and an earlier one make many plans; each requirement is tight (one
// selection just suffices) or loose.
//
//   build/release/bench_certificates [--before PROGRAM] [--plans N] [--before-plans N] [--jobs J] [--budget
//   S]
//       [--samples N] [--shop low|aisles|high|back]... [--problem plain|single|weighted|lexicographic]...
//       [--offset PERCENT|loose]... [--folder FOLDER] [--reference N]
//
// --before        an earlier program for comparison
// --plans         plans per shop and program, shared by its problems and requirements (default: 200)
// --before-plans  the same for the earlier program (default: as --plans)
// --jobs          plans that run at the same time, on one thread each (default: 2)
// --budget        seconds for the certificate of a plan (default: 10)
// --samples       samples per label of the planning matrix (default: that of each program)
// --shop          shops (default: all)
// --problem       problems (default: all)
// --offset        requirements, relative to the one that changes the solution, in percent (default: -1,
// loose)
// --folder        folder of the stores, references and plans (default: certificates). The same command
//                 continues there. Delete it when a program has changed.
// --reference     samples per label of the references (default: 20,000,000, which takes some minutes)
//
// At 99 %, at most two wrong plans of 200 are expected; more than 6 have a probability below 0.5 %.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
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

#include "known_shop.hpp"
#include "programs.hpp"
#include "support.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;
using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Settings {
  std::string earlier_program;  ///< empty: none
  std::size_t plans = 200, earlier_plans = 0;
  int jobs = 2;
  int budget_s = 10;
  std::string samples;
  std::vector<std::string> shops, problems, offsets;
  fs::path folder = "certificates";
  std::uint64_t reference_samples = 20000000;
};

/// Counts of plans.
struct Tally {
  std::size_t plans = 0;
  std::size_t wrong = 0;  ///< with a false statement on a label or a bound
  std::size_t wrong_labels = 0, wrong_bounds = 0;
  std::size_t decided = 0;   ///< all labels, and the count or the cost
  std::size_t worse = 0;     ///< decided, and more expensive than the solution: a wrong bound, too
  std::size_t too_near = 0;  ///< verdicts on labels too near the requirement for the reference
  double cpu_seconds = 0;

  void add(const Tally& more) {
    for (const auto count : {&Tally::plans, &Tally::wrong, &Tally::wrong_labels, &Tally::wrong_bounds,
                             &Tally::decided, &Tally::worse, &Tally::too_near})
      this->*count += more.*count;
    cpu_seconds += more.cpu_seconds;
  }
};

struct Planner {
  std::string name, program;
  std::size_t plans = 0;
};

/// A question about a shop whose answer is known.
struct Question {
  const KnownShop* shop = nullptr;
  std::string shop_name, offset;
  KnownProblem problem;
  KnownShop::Case known;
};

struct Plan {
  Json placement;
  double cpu_seconds = 0;
};

Plan planned(const Settings& settings, const Question& question, const Planner& planner, std::size_t seed) {
  const fs::path folder =
      settings.folder / fmt::format("{}-{}-{}-{}-{}-{}-{}", planner.name, question.shop_name,
                                    question.problem.name, question.offset, settings.samples,
                                    settings.budget_s, seed);
  const fs::path kept = folder / "kept.json";
  if (!fs::exists(kept)) {
    fs::remove_all(folder);
    std::vector<std::string> command{planner.program, "plan", question.known.store.string(), "-o",
                                     folder.string()};
    command.insert(command.end(), {"--seed", std::to_string(seed), "--threads", "1", "--quiet", "--budget",
                                   std::to_string(settings.budget_s)});
    if (!settings.samples.empty()) command.insert(command.end(), {"--samples", settings.samples});
    command.insert(command.end(), question.problem.options.begin(), question.problem.options.end());
    if (question.problem.has_prices)
      command.insert(command.end(), {"--costs", question.shop->prices_file().string()});
    const Ended ended = run_program(command);
    // Plans without a selection or with open statements count, too.
    if (ended.exit_code != 0 && ended.exit_code != 1 && ended.exit_code != 3)
      throw std::runtime_error(
          fmt::format("'{} plan' ended with exit code {}", planner.program, ended.exit_code));
    const Json plan{{"placement", Json::parse(read_file(folder / "placement.json"))},
                    {"cpu_seconds", ended.cpu_seconds}};
    // The matrices and reports of many plans would fill the disk.
    for (const auto& file : fs::directory_iterator(folder)) fs::remove(file);
    write_file(kept, plan.dump());
  }
  const Json plan = Json::parse(read_file(kept));
  return {plan["placement"], plan["cpu_seconds"]};
}

// Compares verdicts with the truth. Labels that are neither missed nor undecided are certified as reached;
// without a selection, `missed` means that no selection reaches the label, though some do.
void examine_labels(const Question& question, const Json& certificate,
                    const std::vector<std::size_t>& selected, Tally& found) {
  const std::set<std::string> missed = certificate["missed"], undecided = certificate["undecided"];
  if (selected.empty()) {
    found.wrong_labels = missed.empty() ? 0 : 1;
    return;
  }
  const SignalMatrix& reference = question.shop->reference();
  for (std::size_t i = 0; i < reference.rows(); ++i) {
    const std::string& id = reference.labels[i].id;
    if (undecided.count(id) > 0) continue;
    const KnownShop::Sum truth =
        question.shop->sum(question.problem, question.known.requirement, i, selected);
    if (!truth.is_clear)
      ++found.too_near;
    else if ((missed.count(id) > 0) == truth.is_reached)
      found.wrong_labels = 1;
  }
}

Tally examine(const Question& question, const Plan& plan) {
  Tally found;
  found.plans = 1;
  found.cpu_seconds = plan.cpu_seconds;
  if (!plan.placement.contains("certificate")) return found;  // stopped before there was anything to certify
  const Json& certificate = plan.placement["certificate"];
  std::map<std::string, std::size_t> columns;
  for (const TransceiverColumn& unit : question.shop->reference().transceivers)
    columns.emplace(unit.id, columns.size());
  std::vector<std::size_t> selected;
  for (const std::string id : plan.placement["selected"]) selected.push_back(columns.at(id));
  examine_labels(question, certificate, selected, found);
  // An earlier program certifies no cost, and its bound on the count is that of another question.
  const double bound = question.problem.has_prices ? certificate.value("cost_lower_bound", 0.0)
                                                   : certificate["count_lower_bound"].get<double>();
  constexpr double rounding = 1e-6;
  found.wrong_bounds = bound > question.known.cost + rounding ? 1 : 0;
  const double cost = question.shop->cost(question.problem, selected);
  const bool is_decided = !selected.empty() && certificate["missed"].empty() &&
                          certificate["undecided"].empty() && bound >= cost - rounding;
  found.decided = is_decided ? 1 : 0;
  found.worse = is_decided && cost > question.known.cost + rounding ? 1 : 0;
  found.wrong = found.wrong_labels + found.wrong_bounds > 0 ? 1 : 0;
  return found;
}

std::vector<Question> questions_of(const Settings& settings, const std::string& name, const KnownShop& shop) {
  std::vector<Question> questions;
  for (const KnownProblem& problem : known_problems()) {
    if (std::find(settings.problems.begin(), settings.problems.end(), problem.name) ==
        settings.problems.end())
      continue;
    for (const std::string& offset : settings.offsets)
      questions.push_back(
          {&shop, name, offset, problem,
           offset == "loose" ? shop.loose(problem) : shop.with_margin(problem, -std::stod(offset) / 100)});
  }
  return questions;
}

void print(const std::string& first, const std::string& offset, double cost, const std::string& program,
           const Tally& tally) {
  fmt::print("{:<22} {:>7} {:>8} {:<8} {:>6} {:>6} {:>7} {:>7} {:>8} {:>9} {:>8.2f}\n", first, offset,
             cost > 0 ? fmt::format("{:g}", cost) : "", program, tally.plans, tally.wrong, tally.wrong_labels,
             tally.wrong_bounds, tally.decided, tally.too_near,
             tally.cpu_seconds / static_cast<double>(std::max<std::size_t>(1, tally.plans)));
}

void examine_shop(const Settings& settings, const std::string& name, const std::vector<Planner>& planners) {
  const KnownShop shop(settings.folder, name, settings.reference_samples);
  const std::vector<Question> questions = questions_of(settings, name, shop);
  fmt::print("\n{}: {} labels, {} candidates\n", name, shop.reference().rows(), shop.reference().columns());
  fmt::print("{:<22} {:>7} {:>8} {:<8} {:>6} {:>6} {:>7} {:>7} {:>8} {:>9} {:>8}\n", "problem", "offset",
             "solution", "program", "plans", "wrong", "labels", "bounds", "decided", "too near", "CPU s");
  for (const Planner& planner : planners) {
    std::vector<Tally> found(planner.plans);
    std::atomic<std::size_t> done{0};
    tbb::task_arena(settings.jobs).execute([&] {
      for_each_task(found.size(), [&](std::size_t k) {
        const Question& question = questions[k % questions.size()];
        found[k] = examine(question, planned(settings, question, planner, 1 + k));
        fmt::print(stderr, "{}, {}: {} of {} plans\n", name, planner.name, ++done, found.size());
      });
    });
    Tally all;
    for (std::size_t q = 0; q < questions.size(); ++q) {
      Tally one;
      for (std::size_t k = q; k < found.size(); k += questions.size()) one.add(found[k]);
      all.add(one);
      print(std::string(questions[q].problem.name), questions[q].offset, questions[q].known.cost,
            planner.name, one);
    }
    print("all", "", 0, planner.name, all);
    std::fflush(stdout);
  }
}

void run(const Settings& settings) {
  std::vector<Planner> planners{{"now", this_program(), settings.plans}};
  if (!settings.earlier_program.empty())
    planners.push_back({"before", settings.earlier_program,
                        settings.earlier_plans > 0 ? settings.earlier_plans : settings.plans});
  const ThreadLimit allowed(static_cast<unsigned>(settings.jobs));
  for (const std::string& name : settings.shops) examine_shop(settings, name, planners);
}

Settings parse(int argc, char** argv) {
  Settings settings;
  Words words(argc, argv);
  while (words.any_left()) {
    const std::string word = words.next();
    if (word == "--before")
      settings.earlier_program = words.value();
    else if (word == "--plans")
      settings.plans = std::stoul(words.value());
    else if (word == "--before-plans")
      settings.earlier_plans = std::stoul(words.value());
    else if (word == "--jobs")
      settings.jobs = std::stoi(words.value());
    else if (word == "--budget")
      settings.budget_s = std::stoi(words.value());
    else if (word == "--samples")
      settings.samples = words.value();
    else if (word == "--shop")
      settings.shops.push_back(words.value());
    else if (word == "--problem")
      settings.problems.push_back(words.value());
    else if (word == "--offset")
      settings.offsets.push_back(words.value());
    else if (word == "--folder")
      settings.folder = words.value();
    else if (word == "--reference")
      settings.reference_samples = std::stoull(words.value());
    else
      throw std::invalid_argument("unknown option " + word);
  }
  if (settings.plans < 1 || settings.jobs < 1)
    throw std::invalid_argument("--plans and --jobs must be at least 1");
  if (settings.shops.empty()) settings.shops.assign(KnownShop::names.begin(), KnownShop::names.end());
  if (settings.problems.empty())
    for (const KnownProblem& problem : known_problems()) settings.problems.emplace_back(problem.name);
  if (settings.offsets.empty()) settings.offsets = {"-1", "loose"};
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
