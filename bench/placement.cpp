// Compares our search with MIP solvers on the same placement problems, one after the other in one process.

#include "shelfbeam/placement/answer/placement.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/names.hpp"

#include "placement_bounds.hpp"
#include "placement_classes.hpp"
#include "placement_instances.hpp"
#include "placement_steps.hpp"
#include "support.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;

constexpr const char* usage =
    R"(bench_placement [SIGNAL...] [--limit S] [--scale X,Y...] [--noise S] [--only-count] [--json]
bench_placement --bounds [SIGNAL...] [--limit S] [--scale X,Y...] [--noise S]
bench_placement --steps [SIGNAL...] [--limit S] [--scale X,Y...] [--noise S]
bench_placement --classes [--seeds N] [--limit S]
bench_placement --wide [--limit S]

Solves the same placement problems with our search and every MIP solver, and prints times and their ratios.

SIGNAL        any matrix that 'shelfbeam place' reads; by default the thesis environment is simulated with the
              uniform estimator (5,000 to 100,000 samples) and the reuse estimator (10,000)
--limit S     time limit per run in seconds (60). If it ends one run, the ratio is a bound, marked > or <;
              if it ends both, the mark is -
--scale X,Y   repeat with all requirements multiplied by X, Y, ..., which gives placements of more units
--noise S     multiply every signal by lognormal noise of this relative standard deviation
--only-count  omit second objectives
--json        print rows as JSON
--bounds      print instead the sizes after reductions, and linear programming bounds with and without shares
--steps       print instead the steps of our search for several questions, as a Markdown table
--classes     compare on random weighted covers of eight classes, N seeds each (5), in CPU time on one thread
--wide        compare on random weighted covers of 500 rows by 60,000 columns
)";

struct Settings {
  InstanceChoice instances;
  double limit = 60;
  bool only_count = false;
  bool json = false;
  bool bounds = false, steps = false, classes = false, wide = false;
  std::size_t seeds = 5;
  bool help = false;
};

struct Entrant {
  std::string name;
  PlaceOptions options;
};

std::vector<Entrant> entrants(double limit) {
  std::vector<Entrant> all = {{"shelfbeam", {.time_limit_s = limit}}};
  for (const milp::Backend& backend : milp::backends())
    all.push_back(
        {std::string(backend.name),
         {.solver = SolverChoice::mip, .backend = std::string(backend.name), .time_limit_s = limit}});
  return all;
}

std::vector<PlacementProblem> problems(bool only_count) {
  std::vector<PlacementProblem> all;
  for (const auto model : {CommunicationModel::non_cooperative, CommunicationModel::cooperative}) {
    all.push_back({.model = model, .objective = Objective::count});
    if (only_count) continue;
    // In the cooperative model links are a constant times the count, so effective links are minimised
    // instead.
    all.push_back({.model = model,
                   .objective = model == CommunicationModel::cooperative ? Objective::effective_links
                                                                         : Objective::links});
    all.push_back({.model = model, .objective = Objective::signal});
  }
  return all;
}

class Table {
 public:
  explicit Table(bool json) : json_(json) {
    if (!json_)
      fmt::print("{:<18} {:<16} {:<16} {:<10} {:>5} {:>11} {:>11} {:<10} {:>9} {:>8}\n", "instance", "model",
                 "objective", "by", "count", "value", "bound", "status", "s", "ratio");
  }

  /// The first result for a problem is ours, with which the others are compared.
  void add(const std::string& instance, const PlacementProblem& problem, const std::string& by,
           const Placement& found, double seconds, bool is_ours) {
    const bool was_stopped = found.status == Status::stopped;
    if (is_ours) ours_ = {seconds, was_stopped};
    const double ratio = seconds / ours_.seconds;
    const char* const sign = !was_stopped && !ours_.was_stopped ? ""
                             : !ours_.was_stopped               ? ">"
                             : !was_stopped                     ? "<"
                                                                : "-";
    if (json_) {
      rows_.push_back({{"instance", instance},
                       {"model", to_text(problem.model)},
                       {"objective", to_text(problem.objective)},
                       {"by", by},
                       {"count", found.count()},
                       {"value", found.objective_value},
                       {"bound", found.lower_bound},
                       {"status", to_text(found.status)},
                       {"seconds", seconds},
                       {"ratio", ratio},
                       {"ratio_is", is_ours ? "" : sign}});
      return;
    }
    fmt::print("{:<18} {:<16} {:<16} {:<10} {:>5} {:>11.6g} {:>11.6g} {:<10} {:>9.3f} {:>8}\n", instance,
               to_text(problem.model), to_text(problem.objective), by, found.count(), found.objective_value,
               found.lower_bound, to_text(found.status), seconds,
               is_ours        ? ""
               : *sign == '-' ? "-"
                              : fmt::format("{}{:.3g}", sign, ratio));
    std::fflush(stdout);
  }

  void end() const {
    if (json_) fmt::print("{}\n", rows_.dump(2));
  }

 private:
  struct Ours {
    double seconds = 0;
    bool was_stopped = false;
  };

  bool json_;
  Ours ours_;
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
};

void compare(const Settings& settings) {
  Table table(settings.json);
  for_instances(settings.instances, [&](const std::string& name, const SignalTable& signals) {
    for (const PlacementProblem& problem : problems(settings.only_count)) {
      bool is_ours = true;
      for (const Entrant& entrant : entrants(settings.limit)) {
        Placement found;
        const double seconds = wall_seconds([&] { found = place(signals, problem, entrant.options); });
        table.add(name, problem, entrant.name, found, seconds, is_ours);
        is_ours = false;
      }
    }
  });
  table.end();
}

Settings parse(int argc, char** argv) {
  Settings settings;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const auto value = [&] {
      if (k + 1 == argc) throw std::invalid_argument(word + " needs a value");
      return std::string(argv[++k]);
    };
    const auto positive = [&](const std::string& text) {
      const double number = std::strtod(text.c_str(), nullptr);
      if (!(number > 0))
        throw std::invalid_argument(fmt::format("{} needs positive numbers, not {}", word, text));
      return number;
    };
    if (word == "--limit") {
      settings.limit = positive(value());
    } else if (word == "--scale") {
      std::istringstream list(value());
      for (std::string one; std::getline(list, one, ',');) settings.instances.scales.push_back(positive(one));
    } else if (word == "--noise") {
      settings.instances.noise = positive(value());
    } else if (word == "--only-count") {
      settings.only_count = true;
    } else if (word == "--json") {
      settings.json = true;
    } else if (word == "--bounds") {
      settings.bounds = true;
    } else if (word == "--steps") {
      settings.steps = true;
    } else if (word == "--classes") {
      settings.classes = true;
    } else if (word == "--wide") {
      settings.wide = true;
    } else if (word == "--seeds") {
      settings.seeds = static_cast<std::size_t>(positive(value()));
    } else if (word == "--help") {
      settings.help = true;
    } else if (word.starts_with("--")) {
      throw std::invalid_argument("unknown option " + word);
    } else {
      settings.instances.files.push_back(word);
    }
  }
  if ((settings.bounds || settings.steps) &&
      (settings.bounds == settings.steps || settings.json || settings.only_count))
    throw std::invalid_argument("--bounds or --steps can be combined only with --limit, --scale and --noise");
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Settings settings = parse(argc, argv);
    if (settings.help)
      fmt::print("{}", usage);
    else if (settings.classes)
      compare_classes(settings.seeds, settings.limit);
    else if (settings.wide)
      compare_wide(settings.limit);
    else if (settings.bounds)
      print_bounds(settings.instances, settings.limit);
    else if (settings.steps)
      print_steps(settings.instances, settings.limit);
    else
      compare(settings);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
