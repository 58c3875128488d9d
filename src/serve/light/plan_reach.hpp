#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <utility>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::serve {

/// The labels that the newest plan in the folder of a project reaches, by their ids.
class PlanReach {
 public:
  explicit PlanReach(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Reads the newest plan again if it has changed.
  void look();
  /// `baseline` of the event `light` (docs/formats/planner.md#light).
  nlohmann::ordered_json json(const Scene& scene) const;

 private:
  std::filesystem::path folder_;
  std::string plan_;
  std::filesystem::file_time_type time_{};
  std::unordered_map<std::string, bool> reached_;
};

}  // namespace shelfbeam::serve
