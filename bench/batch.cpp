// Measures the overhead of `batch`, and simulates the schedule of a chain on a cluster.
//
//   build/release/bench_batch overhead [--count N] [--rounds N]
//
// Plans a generated chain (scripts/make-chain) with `batch`, and with a loop that starts `plan` for each shop
// on as many threads. Both take turns. Prints durations and processor times, their ratios, and the cost per
// kind of shop.
//
// --count   shops (default: 60)
// --rounds  runs of each (default: 3)
//
//   build/release/bench_batch schedule RESULTS.csv [--shops N] [--nodes N,...] [--cores N] [--start SECONDS]
//                                      [--mix NAME=WEIGHT,...]
//
// Draws shops from the measured plans of a batch, and gives each to the first free core. Prints the duration
// of the chain, the longest plan, and the share of time in which cores are busy.
//
// --shops   shops of the chain (default: 1000)
// --nodes   sizes of the cluster (default: 1,16,256)
// --cores   cores per node (default: 16)
// --start   time between the end of a plan and the start of the next on the same core (default: 2 s)
// --mix     shares of the measured stores (default: equal)

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <queue>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/file.hpp"

#include "programs.hpp"
#include "support.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;
namespace fs = std::filesystem;

// No decision of these plans depends on time.
const std::vector<std::string> plan_options{"--samples", "2000"};

std::vector<std::string> with_options(std::vector<std::string> command) {
  command.insert(command.end(), plan_options.begin(), plan_options.end());
  return command;
}

// Returns the processor time of all plans.
double plan_in_loop(const std::vector<fs::path>& shops, const fs::path& folder, unsigned threads) {
  std::atomic<std::size_t> next{0};
  std::vector<double> cpu_s(threads);
  std::vector<std::thread> workers;
  for (unsigned worker = 0; worker < threads; ++worker)
    workers.emplace_back([&, worker] {
      for (std::size_t k = next++; k < shops.size(); k = next++)
        cpu_s[worker] += run_program(with_options({this_program(), "plan", shops[k].string(), "-o",
                                                   (folder / std::to_string(k)).string(), "--seed", "1",
                                                   "--threads", "1"}))
                             .cpu_seconds;
    });
  for (std::thread& worker : workers) worker.join();
  double all = 0;
  for (const double seconds : cpu_s) all += seconds;
  return all;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The numbers of some columns of results.csv, by name of the store.
struct Cost {
  std::string name;
  double cpu_s = 0, memory = 0;
};

std::vector<Cost> costs_in(const fs::path& file) {
  const std::string text = read_file(file);
  CsvReader csv(text, file.string());
  std::vector<Cost> costs;
  std::map<std::string, std::size_t> column;
  for (bool is_head = true; csv.next(); is_head = false) {
    if (is_head) {
      for (std::size_t k = 0; k < csv.fields().size(); ++k) column[csv.text(k)] = k;
      continue;
    }
    costs.push_back(
        {csv.text(column.at("name")), csv.number(column.at("cpu_s")), csv.number(column.at("peak_memory"))});
  }
  return costs;
}

void print_costs(const std::vector<Cost>& costs) {
  std::map<std::string, std::vector<Cost>> by_kind;
  for (const Cost& cost : costs) by_kind[cost.name.substr(cost.name.find('-') + 1)].push_back(cost);
  fmt::print("\n| kind of shop | shops | mean processor time | max memory |\n| --- | --- | --- | --- |\n");
  for (const auto& [kind, of_kind] : by_kind) {
    double sum = 0, peak = 0;
    for (const Cost& cost : of_kind) {
      sum += cost.cpu_s;
      peak = std::max(peak, cost.memory);
    }
    fmt::print("| {} | {} | {:.2f} s | {:.0f} MB |\n", kind, of_kind.size(),
               sum / static_cast<double>(of_kind.size()), 1e-6 * peak);
  }
}

void overhead(std::size_t count, std::size_t rounds) {
  const test::TempFolder folder;
  run_program({"python3", SHELFBEAM_SOURCE_DIR "/scripts/make-chain", (folder / "shops").string(), "--count",
               std::to_string(count)});
  std::vector<fs::path> shops;
  for (const auto& entry : fs::directory_iterator(folder / "shops"))
    shops.push_back(entry.path() / "store.json");
  std::sort(shops.begin(), shops.end());
  const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<double> wall, cpu;
  fmt::print("{} shops, {} plans at a time, options:", count, threads);
  for (const std::string& option : plan_options) fmt::print(" {}", option);
  fmt::print("\n");
  for (std::size_t round = 1; round <= rounds; ++round) {
    const fs::path results = folder / fmt::format("batch{}", round);
    double loop_cpu = 0, batch_cpu = 0;
    const double loop_wall =
        wall_seconds([&] { loop_cpu = plan_in_loop(shops, folder / fmt::format("loop{}", round), threads); });
    const double batch_wall = wall_seconds([&] {
      batch_cpu = run_program(with_options({this_program(), "batch", (folder / "shops").string(), "-o",
                                            results.string(), "--"}))
                      .cpu_seconds;
    });
    fmt::print("round {}: loop {:.2f} s, {:.2f} s of processor time; batch {:.2f} s, {:.2f} s\n", round,
               loop_wall, loop_cpu, batch_wall, batch_cpu);
    wall.push_back(batch_wall / loop_wall);
    cpu.push_back(batch_cpu / loop_cpu);
    if (round == rounds) {
      fmt::print("batch over loop, median: duration {:.4f}, processor time {:.4f}\n", median(wall),
                 median(cpu));
      print_costs(costs_in(results / "results.csv"));
    }
  }
}

struct Cluster {
  std::size_t shops = 1000, cores = 16;
  double start_s = 2;
  std::vector<std::size_t> nodes{1, 16, 256};
  std::map<std::string, double> mix;
};

void schedule(const fs::path& file, const Cluster& cluster) {
  const std::vector<Cost> costs = costs_in(file);
  std::vector<double> weights;
  fmt::print("| store | share | processor time | memory |\n| --- | --- | --- | --- |\n");
  double all = 0;
  for (const Cost& cost : costs) {
    const auto found = cluster.mix.find(cost.name);
    weights.push_back(cluster.mix.empty() ? 1 : found == cluster.mix.end() ? 0 : found->second);
    all += weights.back();
  }
  for (std::size_t k = 0; k < costs.size(); ++k)
    fmt::print("| {} | {:.0f} % | {:.1f} s | {:.0f} MB |\n", costs[k].name, 100 * weights[k] / all,
               costs[k].cpu_s, 1e-6 * costs[k].memory);
  std::mt19937_64 random(1);
  std::discrete_distribution<std::size_t> draw(weights.begin(), weights.end());
  std::vector<double> plans;
  for (std::size_t k = 0; k < cluster.shops; ++k) plans.push_back(costs[draw(random)].cpu_s);
  double work = 0;
  for (const double plan : plans) work += plan;
  fmt::print("\n{} shops: {:.1f} processor hours; longest plan {:.0f} s\n", plans.size(), work / 3600,
             *std::max_element(plans.begin(), plans.end()));
  fmt::print("\n| nodes | cores | duration | cores busy |\n| --- | --- | --- | --- |\n");
  for (const std::size_t nodes : cluster.nodes) {
    const std::size_t cores = nodes * cluster.cores;
    std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
    for (std::size_t core = 0; core < cores; ++core) free_at.push(0);
    double end = 0;
    for (const double plan : plans) {
      const double ended = free_at.top() + cluster.start_s + plan;
      free_at.pop();
      free_at.push(ended);
      end = std::max(end, ended);
    }
    fmt::print("| {} | {} | {:.1f} min | {:.0f} % |\n", nodes, cores, end / 60,
               100 * work / (end * static_cast<double>(cores)));
  }
}

std::map<std::string, double> mix_of(const std::string& text) {
  std::map<std::string, double> mix;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.size(), text.find(',', at)), equals = text.find('=', at);
    mix[text.substr(at, equals - at)] = std::stod(text.substr(equals + 1, end - equals - 1));
    at = end + 1;
  }
  return mix;
}

std::vector<std::size_t> numbers_in(const std::string& text) {
  std::vector<std::size_t> numbers;
  for (std::size_t at = 0; at < text.size(); at = std::min(text.size(), text.find(',', at)) + 1)
    numbers.push_back(std::stoul(text.substr(at)));
  return numbers;
}

void run(int argc, char** argv) {
  Words words(argc, argv);
  const std::string command = words.any_left() ? words.next() : "";
  if (command == "overhead") {
    std::size_t count = 60, rounds = 3;
    while (words.any_left()) {
      const std::string option = words.next();
      if (option == "--count")
        count = std::stoul(words.value());
      else if (option == "--rounds")
        rounds = std::stoul(words.value());
      else
        throw std::invalid_argument("unknown option " + option);
    }
    overhead(count, rounds);
  } else if (command == "schedule") {
    const fs::path file = words.value();
    Cluster cluster;
    while (words.any_left()) {
      const std::string option = words.next();
      if (option == "--shops")
        cluster.shops = std::stoul(words.value());
      else if (option == "--nodes")
        cluster.nodes = numbers_in(words.value());
      else if (option == "--cores")
        cluster.cores = std::stoul(words.value());
      else if (option == "--start")
        cluster.start_s = std::stod(words.value());
      else if (option == "--mix")
        cluster.mix = mix_of(words.value());
      else
        throw std::invalid_argument("unknown option " + option);
    }
    schedule(file, cluster);
  } else {
    throw std::invalid_argument("bench_batch overhead or bench_batch schedule RESULTS.csv");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
