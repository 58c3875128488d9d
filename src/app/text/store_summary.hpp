#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/material/material_shares.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

#include "app/loaded_store.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

struct MaterialSummary {
  std::string name;
  std::string_view type;
  MaterialShares normal, mean;  ///< of light from straight on; from all directions
  bool is_transparent = false;
  double area = 0;  ///< m^2
  std::size_t triangles = 0;
};

struct LabelTypeSummary {
  std::string name;
  std::string_view responsivity;
  std::array<double, 2> size{};  ///< m
  std::size_t labels = 0;
  double requirement = 0;
};

struct TransceiverTypeSummary {
  std::string name;
  std::string_view emission;
  std::string file;   ///< that the emission is from, if any
  double radius = 0;  ///< m
  double flux = 0;    ///< W
  double peak = 0;    ///< W/sr
  std::size_t units = 0;
  std::size_t axes = 0;  ///< how many different ones the units have
  double cost = 0;
};

/// What `inspect` shows of a store.
struct StoreSummary {
  std::vector<MaterialSummary> materials;
  std::vector<LabelTypeSummary> label_types;
  std::vector<TransceiverTypeSummary> transceiver_types;
  std::size_t mounting_points = 0;       ///< different positions of candidates
  std::size_t with_several_options = 0;  ///< of these, the ones with more than one candidate
  std::vector<std::string> uncovered;    ///< light that the default strategy leaves out
  std::vector<std::string> by_chance;    ///< light that it finds by chance only
};

StoreSummary summarize(const Scene& scene);

nlohmann::ordered_json summary_json(const Scene& scene, const StoreSummary& summary);
void print_summary(const Scene& scene, const StoreSummary& summary);
/// A line each for the warnings of a scene and the light that its simulation finds by chance only, unless
/// JSON or nothing is to be printed.
void print_warnings(const CommonOptions& common, const Scene& scene, Strategy strategy);

}  // namespace shelfbeam::app
