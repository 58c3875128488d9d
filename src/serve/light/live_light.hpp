#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "jobs/child.hpp"
#include "serve/http/message.hpp"
#include "serve/http/options.hpp"
#include "serve/light/light_child.hpp"
#include "serve/light/loaded_light.hpp"
#include "serve/light/plan_reach.hpp"

namespace shelfbeam::serve {

/// The light of the shop that is being drawn: what pages are told of it (docs/formats/planner.md#light). The
/// heavy work is done by another process, which begins when nothing has changed for a while and pauses during
/// gestures.
class LiveLight {
 public:
  using Clock = std::chrono::steady_clock;
  using Json = nlohmann::ordered_json;

  /// `folder`: of the project. `is_on`: false: nothing is computed. `program`: shelfbeam.
  explicit LiveLight(std::filesystem::path folder, bool is_on = true,
                     std::string program = jobs::own_program);

  /// The shop has changed. `text`: of the store file; `changes_light`: more than the units on the plan may
  /// have changed. Columns of new units follow from `poll` or at once from `messages`.
  void change(const std::string& text, std::uint64_t revision, const Draft& draft, bool changes_light,
              Clock::time_point now);
  /// Everything that a new page must know.
  std::vector<http::Message> everything() const;
  /// To be called often. Returns messages for all pages.
  std::vector<http::Message> poll(const Draft& draft, Clock::time_point now);
  /// Messages for all pages since the last call of this function or `poll`.
  std::vector<http::Message> messages(const Draft& draft);

  /// A gesture of a page begins or ends.
  void hold(http::TabId tab);
  void release(http::TabId tab, Clock::time_point now);

  /// The answer to a request `mount`.
  static Json mount(const Json& request, const Draft& draft);
  /// The answer to a request `drag`, by the coarse operator where the fine one takes too long. Throws
  /// InputError, also if there is no operator yet.
  http::Message drag(const Json& request, const Draft& draft);

 private:
  struct Unit {
    std::size_t index;
    std::string id, key;
  };

  void list_units(const Draft& draft);
  std::vector<std::string> keys() const;
  void preview_new_units(const Draft& draft);
  void start();
  void take(std::string frame);
  void keep(const std::string& key, http::Message message);
  LoadedLight::Source source(jobs::LightStage stage) const;
  Json state() const;

  const std::filesystem::path folder_, keep_;
  const bool is_on_;
  LightChild child_;
  LoadedLight light_;
  PlanReach plan_;
  std::string text_;
  std::uint64_t generation_ = 0, revision_ = 0;
  std::vector<Unit> units_;
  std::vector<std::string> started_;  // the keys of the units with which the process began
  bool has_labels_ = false;
  std::map<std::string, http::Message> columns_;  // by the key of the unit
  http::Message requirements_;
  std::vector<http::Message> news_;

  std::string phase_ = "none", message_;
  Json operator_, undecided_, progress_, baseline_;
  Json told_;  // the last state
  std::set<http::TabId> holds_;
  bool is_paused_ = false;
  int fine_tries_ = 0;         // of columns by the fine operator for drags, the last ones,
  double fine_ms_ = HUGE_VAL;  // and the least time that one took
  std::optional<Clock::time_point> start_at_, resume_at_;
  Clock::time_point looked_{};
};

}  // namespace shelfbeam::serve
