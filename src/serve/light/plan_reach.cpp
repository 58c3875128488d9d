#include "serve/light/plan_reach.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <string_view>
#include <system_error>
#include <vector>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"

#include "jobs/plan_folder.hpp"
#include "serve/live/newest_plan.hpp"

namespace shelfbeam::serve {

namespace {

namespace fs = std::filesystem;

// The page adds signals up: it has no comparison with a plan by another rule.
bool adds_up(const fs::path& placement) {
  const auto json = nlohmann::json::parse(read_text(placement));
  return json.at("model") == "cooperative" && !json.at("survives_failure").get<bool>();
}

std::unordered_map<std::string, bool> reached_in(const fs::path& file) {
  std::unordered_map<std::string, bool> reached;
  const std::string text = read_text(file);
  CsvReader csv(text, file.string());
  if (!csv.next()) return reached;
  const std::vector<std::string> names = csv.column_names();
  const auto column = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::size_t requirement = column("requirement"), signal = column("signal");
  if (requirement == names.size() || signal == names.size()) return reached;
  while (csv.next()) {
    csv.expect_fields(std::max(requirement, signal) + 1, names.size());
    reached[csv.id(0)] = is_met(csv.number(signal), csv.number(requirement));
  }
  return reached;
}

}  // namespace

void PlanReach::look() {
  const std::string plan = newest_plan(folder_);
  const fs::path file = folder_ / plan / jobs::labels_name;
  std::error_code missing;
  const auto time = plan.empty() ? fs::file_time_type{} : fs::last_write_time(file, missing);
  if (plan == plan_ && (missing || time == time_)) return;
  plan_ = plan;
  time_ = time;
  reached_.clear();
  if (plan.empty() || missing || !is_plain_file(file)) return;
  try {
    if (adds_up(folder_ / plan / jobs::placement_name)) reached_ = reached_in(file);
  } catch (const std::exception&) {
    reached_.clear();  // a table that somebody has changed is no baseline
  }
}

nlohmann::ordered_json PlanReach::json(const Scene& scene) const {
  if (reached_.empty()) return nullptr;
  std::string text;
  for (const Label& label : scene.labels) {
    const auto found = reached_.find(label.id);
    text += found == reached_.end() ? '-' : found->second ? '1' : '0';
  }
  return {{"plan", plan_}, {"reached", text}};
}

}  // namespace shelfbeam::serve
