#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam::serve {

using Json = nlohmann::ordered_json;

enum class RunState : std::uint8_t {
  waiting,     ///< another plan runs
  previewing,  ///< a first answer is computed
  running,
  done,
  stopped,  ///< by the user; the results so far are kept
  failed
};

}  // namespace shelfbeam::serve

namespace shelfbeam {

template <>
inline constexpr auto names_of<serve::RunState> =
    std::to_array<Named<serve::RunState>>({{"waiting", serve::RunState::waiting},
                                           {"previewing", serve::RunState::previewing},
                                           {"running", serve::RunState::running},
                                           {"done", serve::RunState::done},
                                           {"stopped", serve::RunState::stopped},
                                           {"failed", serve::RunState::failed}});

}  // namespace shelfbeam

namespace shelfbeam::serve {

/// The progress of a run, as its process reports it (docs/formats/job.md).
struct RunProgress {
  std::string task, detail;
  std::optional<double> share, seconds_left, incumbent, bound;
  std::vector<std::string> selected;  ///< ids
  bool counts_units = false;          ///< the bounds are numbers of units

  /// Of a placement or a proof. A later one begins with a bound of its own: the best one stays as long as it
  /// answers the same question and no incumbent contradicts it. `is_maximum`: the bound is an upper one.
  void take_bounds(double new_incumbent, double new_bound, bool is_maximum);
};

/// A plan that was asked for in the planner, or that the folder of the project has.
struct PlanRun {
  std::uint64_t id = 0;
  std::string folder;   ///< its name in that of the project
  Json plan = nullptr;  ///< the request (docs/formats/job.md); null: of another program
  RunState state = RunState::waiting;
  std::string begun = {}, ended = {};  ///< UTC (ISO 8601)
  std::string shop = {};               ///< shop_hash of the store that is planned
  std::int64_t written = 0;            ///< time of its placement.json, ns; 0: not known
  bool is_continued = false;           ///< after an interruption of the program
  bool is_entered = false;             ///< its units were selected in the store
  bool is_cancelled = false;           ///< it was asked to end with its results so far
  RunProgress progress = {};           ///< not kept
  Json first = nullptr;                ///< the first answer: the event `result`, with `selected`
  Json result = nullptr;               ///< the event `result` or `error`

  /// It has ended with an error.
  void fail(const std::exception& error);
  bool is_active() const { return state <= RunState::running; }
  /// It has ended, and has chosen units.
  bool has_plan() const {
    return !is_active() && result.is_object() && result.contains("selected") && !result["selected"].empty();
  }
  /// The ids of its units, or of those of its first answer; null without either.
  Json selected() const {
    if (has_plan()) return result["selected"];
    return first.is_object() ? first["selected"] : Json();
  }
};

/// The run without its progress.
Json to_json(const PlanRun& run);
/// Throws nlohmann::json::exception, and InputError for a folder that is none of the project.
PlanRun run_of(const Json& json);

/// The placement.json of a folder without the names of the labels. Throws InputError and Json::exception.
Json placement_in(const std::filesystem::path& folder);

/// The result of a plan in a folder as the event `result`, without a sentence, by its placement.json. Null if
/// that is none.
Json result_in(const std::filesystem::path& folder);

/// A hash of a store without its selection of units, which every plan changes, and without the values that
/// it confirms.
std::string shop_hash(const Json& store);

}  // namespace shelfbeam::serve
