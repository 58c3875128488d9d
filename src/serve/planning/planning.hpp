#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/scene/build/draft.hpp"

#include "jobs/child.hpp"
#include "serve/http/options.hpp"
#include "serve/planning/plan_runs.hpp"
#include "serve/request.hpp"
#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

/// The plans of a project for its pages (docs/formats/planner.md#plans): their list and their results.
class Planning {
 public:
  /// `folder`: of the project. `program`: shelfbeam.
  explicit Planning(std::filesystem::path folder, std::string program = jobs::own_program);

  /// The answer to a request `plan`, `plan_cancel`, `plan_forget`, `plan_details` or `plan_states`; nothing
  /// for another one. Throws InputError.
  std::optional<Json> answer(const Request& request, const Json& store, const Draft& draft);

  /// The edit that selects the units of a plan, or of one of its `alternatives`, and the label of its step.
  /// Throws InputError if the shop does not have a unit.
  struct Selection {
    std::string label;
    std::vector<EditOp> ops;
  };
  Selection selection(std::uint64_t id, const std::string& alternative, const Json& store,
                      const Draft& draft) const;

  /// The event `plans` for a new page.
  Json everything(const Json& store, const Draft& draft, std::uint64_t revision);
  struct News {
    std::optional<Json> event = {};            ///< `plans`, for all pages
    bool is_previewing = false;                ///< a first answer is computed, which should come soon
    std::vector<std::uint64_t> to_enter = {};  ///< plans of this very shop that have ended with units
  };
  /// To be called often. `revision`: of the store.
  News poll(const Json& store, const Draft& draft, std::uint64_t revision);
  void note_entered(std::uint64_t id) { runs_.note_entered(id); }
  void note_renewed(std::uint64_t id) { runs_.note_renewed(id); }
  const PlanRuns& runs() const { return runs_; }

  /// A file of a plan, `plans/ID/FILE`.
  std::optional<http::Document> document(std::string_view name) const;

 private:
  using Clock = std::chrono::steady_clock;

  Json placement_of(const PlanRun& run) const;
  Json details(const PlanRun& run, const Draft& draft) const;
  const std::string& shop(const Json& store, std::uint64_t revision);

  const std::filesystem::path folder_;
  PlanRuns runs_;
  std::uint64_t revision_ = 0;
  std::string shop_, told_shop_;
  Clock::time_point hashed_{};
};

}  // namespace shelfbeam::serve
