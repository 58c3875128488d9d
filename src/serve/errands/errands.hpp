#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/child.hpp"
#include "serve/errands/errand.hpp"
#include "serve/http/options.hpp"
#include "serve/planning/plan_runs.hpp"

namespace shelfbeam::serve {

/// The requests of pages whose answers take a process, and the files that they leave for a page
/// (docs/formats/planner.md): `compare`, `difference`, `plan_report` and `archive`.
class Errands {
 public:
  /// `folder`: of the project. `program`: shelfbeam.
  explicit Errands(std::filesystem::path folder, const std::string& program = jobs::own_program);
  ~Errands();

  /// Begins the answer to one of these requests; returns false for another one. Throws InputError, also while
  /// an equal request is open.
  bool begin(const Request& request, const PlanRuns& plans);
  /// To be called often.
  std::vector<LateReply> poll();
  /// The page of the last `difference`, or the last `archive`.
  std::optional<http::Document> document(std::string_view name) const;

 private:
  void remove_archives() const;
  std::filesystem::path own_file(const char* name) const { return folder_ / ".shelfbeam" / name; }

  const std::filesystem::path folder_;
  Errand comparison_, difference_, report_, archive_;
};

}  // namespace shelfbeam::serve
