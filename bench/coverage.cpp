// Examines whether the standard errors of path reuse are reliable: the share of 95 % intervals that contain
// the truth in a zoo of small rooms. The truth is a long run of the paper's estimator (walks or particles,
// whichever converges in the room).
//
//   build/release/bench_coverage [ROOM...] [OPTION...]
//
// ROOM: the name, or part of the name, of a room of the zoo, or a store file (default: all rooms of the zoo).
//
//   --folder FOLDER  folder of store files, references and the counts of every seed (default: coverage). The
//                    same command continues there. Delete it when the program has changed; references may
//                    stay.
//   --seeds N        number of seeds, each with its own cache and random numbers (default: 30)
//   --batches N      batches per seed (default: 764, with 100,084 first rays per label). They are evaluated
//                    as runs of 16 batches (2,096 first rays), of 77 batches (10,087), and of all
//   --walks N        walks of the reference per label (default: 1,000,000), times the room's effort (4 to 32)
//   --old-spots      control: caps at 4 m from the unit, equal for all receivers, and none for vertices
//
// The last column is the reference's share of the squared errors in percent.

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "support.hpp"
#include "unit/transport/interval_coverage.hpp"
#include "unit/transport/zoo.hpp"

namespace {

using namespace shelfbeam;
using test::ClassCoverage;
using test::CoverageCount;
using test::CoverageTable;
using test::ZooRoom;
using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Settings {
  std::vector<std::string> rooms;
  fs::path folder = "coverage";
  std::uint32_t seeds = 30, batches = 764;
  std::uint64_t walks = 1000000;
  bool old_spots = false;
};

std::string file_name(std::string room) {
  for (char& c : room)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  return room;
}

// Files in the folder are named by the room, so they must belong to this store.
void keep_store(const Settings& settings, const ZooRoom& room) {
  const fs::path file = settings.folder / (file_name(room.name) + ".json");
  if (!fs::exists(file))
    write_file(file, room.store);
  else if (read_file(file) != room.store)
    throw std::runtime_error(fmt::format("{} is another store: choose another folder", file.string()));
}

test::Reference reference(const Settings& settings, const ZooRoom& room, const Scene& scene) {
  const fs::path file =
      settings.folder / fmt::format("{}-{}.h5", file_name(room.name), settings.walks * room.effort);
  if (!fs::exists(file)) {
    SimulationOptions options;
    options.estimator = EstimatorKind::uniform;
    options.strategy = room.reference;
    options.direct = DirectLight::exact;
    options.samples = settings.walks * room.effort;
    options.seed = 99;
    simulate_to_file(scene, options, file);
  }
  const SignalMatrix matrix = read_signal_file(file);
  return {{matrix.mean.begin(), matrix.mean.end()},
          {matrix.standard_error.begin(), matrix.standard_error.end()},
          matrix.flags};
}

Json as_json(const CoverageCount& count) {
  return {count.pairs, count.held, count.beyond_3, count.beyond_6, count.worst};
}

CoverageCount from_json(const Json& json) {
  return {json[0], json[1], json[2], json[3], json[4]};
}

// The counts of one seed, which are kept in a file.
CoverageTable run(const Settings& settings, const ZooRoom& room, const Scene& scene, const World& world,
                  const test::Reference& known, std::uint32_t seed) {
  const fs::path file =
      settings.folder / fmt::format("{}-{}-{}-{}{}.json", file_name(room.name), settings.walks * room.effort,
                                    settings.batches, seed, settings.old_spots ? "-old" : "");
  CoverageTable table;
  if (fs::exists(file)) {
    const Json kept = Json::parse(std::ifstream(file));
    for (const auto& [length, classes] : kept.items())
      for (const auto& [name, counts] : classes.items())
        table[static_cast<std::uint32_t>(std::stoul(length))][name] = {from_json(counts[0]),
                                                                       from_json(counts[1]), counts[2]};
    return table;
  }
  ReuseEffort effort;
  if (settings.old_spots) effort.spots = {.min_cap_distance = 4, .near_distance = 0, .for_vertices = false};
  const ReuseEstimator estimator(world, seed, effort);
  std::vector<std::uint32_t> lengths;
  for (const std::uint32_t length : {16U, 77U, settings.batches})
    if (length <= settings.batches && (lengths.empty() || lengths.back() != length))
      lengths.push_back(length);
  table = test::coverage_of(scene, world, estimator, known, lengths, settings.batches);
  Json kept;
  for (const auto& [length, classes] : table)
    for (const auto& [name, counts] : classes)
      kept[std::to_string(length)][name] = {as_json(counts.all), as_json(counts.unflagged),
                                            counts.of_reference};
  write_file(file, kept.dump());
  return table;
}

void print_row(const std::string& name, const ClassCoverage& counts) {
  const auto print = [](const CoverageCount& c) {
    fmt::print(" {:>9} {:>6.1f} {:>6.2f} {:>5} {:>6.1f}", c.pairs, 100 * c.share(c.held),
               100 * c.share(c.beyond_3), c.beyond_6, c.worst);
  };
  fmt::print("  {:<36}", name);
  print(counts.unflagged);
  fmt::print(" {:>7.2f} |", 100 * counts.flagged());
  print(counts.all);
  fmt::print(" {:>9.1f}\n", 100 * counts.reference_share());
}

void print_head(const std::string& title) {
  fmt::print("{:<38} {:>9} {:>6} {:>6} {:>5} {:>6} {:>7} | {:>9} {:>6} {:>6} {:>5} {:>6} {:>9}\n", title,
             "unflagged", "95 %", "> 3", "> 6", "worst", "flagged", "all", "95 %", "> 3", "> 6", "worst",
             "reference");
}

ClassCoverage sum(const std::map<std::string, ClassCoverage>& classes) {
  ClassCoverage all;
  for (const auto& [name, counts] : classes) all += counts;
  return all;
}

double largest_reflectance(const Scene& scene) {
  double largest = 0;
  const std::vector<bool> used = scene.used_materials();
  for (std::size_t k = 0; k < used.size(); ++k)
    if (used[k]) largest = std::max(largest, given_reflectance(scene.materials[k].material).value_or(0));
  return largest;
}

std::vector<ZooRoom> chosen(const Settings& settings) {
  std::vector<ZooRoom> all = test::zoo();
  if (settings.rooms.empty()) return all;
  std::vector<ZooRoom> rooms;
  for (const std::string& name : settings.rooms) {
    if (fs::exists(name)) {
      ZooRoom room{fs::path(name).stem(), read_file(name)};
      if (fs::path(name).has_parent_path()) room.folder = fs::path(name).parent_path();
      room.reflectance = largest_reflectance(room.scene());
      rooms.push_back(room);
      continue;
    }
    const std::size_t before = rooms.size();
    for (const ZooRoom& room : all)
      if (room.name.find(name) != std::string::npos) rooms.push_back(room);
    if (rooms.size() == before) throw std::invalid_argument("no room '" + name + "'");
  }
  return rooms;
}

void examine(const Settings& settings) {
  fs::create_directories(settings.folder);
  CoverageTable all;
  std::map<std::uint32_t, std::vector<std::pair<std::string, ClassCoverage>>> by_room;
  for (const ZooRoom& room : chosen(settings)) {
    const Scene scene = room.scene();
    const World world(scene);
    const auto start = std::chrono::steady_clock::now();
    keep_store(settings, room);
    const test::Reference known = reference(settings, room, scene);
    CoverageTable of_room;
    std::mutex mutex;
    for_each_task(settings.seeds, [&](std::size_t seed) {
      const CoverageTable table = run(settings, room, scene, world, known, static_cast<std::uint32_t>(seed));
      const std::scoped_lock lock(mutex);
      for (const auto& [length, classes] : table)
        for (const auto& [name, counts] : classes) {
          of_room[length][name] += counts;
          if (room.reflectance <= 0.97) all[length][name] += counts;
        }
    });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print(stderr, "{}: {} labels, {} units, {} entries without a reliable reference, {:.0f} s\n",
               room.name, scene.labels.size(), scene.transceivers.size(),
               std::count(known.flags.begin(), known.flags.end(), 1), seconds);
    for (const auto& [length, classes] : of_room) by_room[length].emplace_back(room.name, sum(classes));
  }
  for (const auto& [length, rooms] : by_room) {
    print_head(fmt::format("runs of {} batches", length));
    for (const auto& [name, counts] : rooms) print_row(name, counts);
    print_row("all up to reflectance 0.97", sum(all[length]));
    fmt::print("\n  {:<13}{:<10}{}\n", "label", "unit", "of the requirement");
    ClassCoverage small;
    for (const auto& [name, counts] : all[length])
      if (counts.unflagged.pairs >= 2000)
        print_row(name, counts);
      else
        small += counts;
    if (small.all.pairs > 0) print_row("classes of fewer than 2,000", small);
    fmt::print("\n");
  }
}

Settings parse(int argc, char** argv) {
  Settings settings;
  bench::Words words(argc, argv);
  while (words.any_left()) {
    const std::string word = words.next();
    if (word == "--folder")
      settings.folder = words.value();
    else if (word == "--seeds")
      settings.seeds = static_cast<std::uint32_t>(std::stoul(words.value()));
    else if (word == "--batches")
      settings.batches = static_cast<std::uint32_t>(std::stoul(words.value()));
    else if (word == "--walks")
      settings.walks = std::stoull(words.value());
    else if (word == "--old-spots")
      settings.old_spots = true;
    else if (word.starts_with("--"))
      throw std::invalid_argument("unknown option " + word);
    else
      settings.rooms.push_back(word);
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    examine(parse(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
