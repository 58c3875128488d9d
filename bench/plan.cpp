// Times `plan` to its end, with all defaults, and prints what its certificates state.
//
//   build/release/bench_plan [--before PROGRAM] [--seeds N] [--rays] [--folder FOLDER] [STORE...]
//
// --before  an earlier program; both programs take turns
// --seeds   plans per store and program, with seeds 1, 2, ... (default: 1)
// --rays    also count the rays that each program casts
// --folder  folder of the plans (default: plans)
// STORE     store files or names of examples (default: thesis grocery; supermarket takes some minutes)

#include <chrono>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"

#include "programs.hpp"
#include "support.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;
namespace fs = std::filesystem;

struct Settings {
  std::string earlier_program;  ///< empty: none
  std::size_t seeds = 1;
  bool counts_rays = false;
  fs::path folder = "plans";
  std::vector<fs::path> stores;
};

struct Planner {
  std::string name, program;
};

// Runs one plan and prints a line about it; returns its wall time in seconds.
double run_plan(const Planner& planner, const fs::path& store, std::size_t seed, const fs::path& folder,
                bool counts_rays) {
  fs::remove_all(folder);
  const fs::path ray_file = folder.string() + ".rays";
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::string> command{planner.program, "plan",   store.string(),       "-o",
                                   folder.string(), "--seed", std::to_string(seed), "--quiet"};
  if (counts_rays)
    command.insert(command.begin(), {"env", fmt::format("LD_PRELOAD={}", SHELFBEAM_RAY_COUNTER),
                                     fmt::format("SHELFBEAM_RAY_FILE={}", ray_file.string())});
  const Ended ended = run_program(command);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto placement = nlohmann::json::parse(read_file(folder / "placement.json"));
  const auto& certificate = placement["certificate"];
  const double rays = counts_rays ? std::stod(read_file(ray_file)) : 0;
  fmt::print("{:<12} {:<8} {:>4} {:>8.1f} {:>8.1f} {:>12} {:>5} {:>6} {:>9} {:>6}  {}\n",
             store.parent_path().filename().string(), planner.name, seed, seconds, ended.cpu_seconds,
             counts_rays ? fmt::format("{:.1f}", rays / 1e6) : "", placement["count"].get<std::size_t>(),
             certificate["count_lower_bound"].get<std::size_t>(), certificate["undecided"].size(),
             ended.exit_code, certificate["open"].get<std::string>());
  std::fflush(stdout);
  return seconds;
}

void run(const Settings& settings) {
  fs::create_directories(settings.folder);
  std::vector<Planner> planners{{"now", this_program()}};
  if (!settings.earlier_program.empty()) planners.push_back({"before", settings.earlier_program});
  fmt::print("{:<12} {:<8} {:>4} {:>8} {:>8} {:>12} {:>5} {:>6} {:>9} {:>6}  {}\n", "store", "program",
             "seed", "wall s", "CPU s", "million rays", "count", "bound", "undecided", "exit", "open");
  for (const fs::path& store : settings.stores) {
    std::vector<double> seconds(planners.size(), 0.0);
    for (std::size_t seed = 1; seed <= settings.seeds; ++seed)
      for (std::size_t k = 0; k < planners.size(); ++k)
        seconds[k] +=
            run_plan(planners[k], store, seed, settings.folder / planners[k].name, settings.counts_rays);
    if (planners.size() > 1) fmt::print("{:<12} before / now: {:.2f}\n", "", seconds[1] / seconds[0]);
  }
}

Settings parse(int argc, char** argv) {
  Settings settings;
  Words words(argc, argv);
  while (words.any_left()) {
    const std::string word = words.next();
    if (word == "--before")
      settings.earlier_program = words.value();
    else if (word == "--seeds")
      settings.seeds = std::stoul(words.value());
    else if (word == "--rays")
      settings.counts_rays = true;
    else if (word == "--folder")
      settings.folder = words.value();
    else if (word.starts_with("-"))
      throw std::invalid_argument("unknown option " + word);
    else
      settings.stores.push_back(store_file(word));
  }
  if (settings.stores.empty()) settings.stores = {store_file("thesis"), store_file("grocery")};
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
