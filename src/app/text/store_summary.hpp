#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

#include "app/verbs.hpp"

namespace shelfbeam::app {

/// The output of `inspect`: areas, counts, and the light that the default strategy omits or samples only by
/// chance.
nlohmann::ordered_json summary_json(const Scene& scene);

/// The warnings and `written`, a line about the file that was written, if any, come before the tables.
void print_summary(const Scene& scene, const std::string& written);
/// A heading and a line per member; nothing for an empty list.
void print_list(std::string_view heading, const std::vector<std::string>& lines);

/// Prints one line per warning; nothing with --quiet. With --json, they go to standard error.
void print_warnings(const CommonOptions& common, const std::vector<Finding>& warnings);

/// Prints one line per warning of a scene and per kind of light that is hard to sample;
/// nothing with --json or --quiet.
void print_warnings(const CommonOptions& common, const Scene& scene, Strategy strategy);

}  // namespace shelfbeam::app
