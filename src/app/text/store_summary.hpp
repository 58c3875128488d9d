#pragma once

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

#include "app/verbs.hpp"

namespace shelfbeam::app {

/// What `inspect` shows of a store: areas, counts, and the light that the default strategy leaves out or
/// finds by chance only.
nlohmann::ordered_json summary_json(const Scene& scene);
void print_summary(const Scene& scene);

/// A line each for the warnings of a scene and the light that its simulation finds by chance only, unless
/// JSON or nothing is to be printed.
void print_warnings(const CommonOptions& common, const Scene& scene, Strategy strategy);

}  // namespace shelfbeam::app
