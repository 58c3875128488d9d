#include "app/text/store_summary.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <variant>

#include "shelfbeam/math/places.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/world/coverage.hpp"

namespace shelfbeam::app {

namespace {

// Vectors that differ by less than a micrometre, or as directions by as little, count as one.
std::tuple<long, long, long> rounded(const Vec3& v) {
  return {std::lround(v.x * 1e6), std::lround(v.y * 1e6), std::lround(v.z * 1e6)};
}

std::vector<MaterialSummary> materials(const Scene& scene) {
  std::vector<MaterialSummary> result;
  for (const NamedMaterial& named : scene.materials) {
    const Material& material = named.material;
    result.push_back({named.name, type_name(material), shares_at_normal(material),
                      hemispherical_shares(material), !is_opaque(material)});
  }
  const TriangleMesh& mesh = scene.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    MaterialSummary& one = result[mesh.materials[t].value];
    ++one.triangles;
    one.area += length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
  }
  return result;
}

std::vector<LabelTypeSummary> label_types(const Scene& scene) {
  std::vector<LabelTypeSummary> result;
  for (const LabelType& type : scene.label_types)
    result.push_back({type.name, type_name(type.responsivity), type.size, 0, type.requirement()});
  for (const Label& label : scene.labels) ++result[label.type.value].labels;
  return result;
}

// The closed forms are largest on the axis or at 45 degrees, a table at one of its nodes.
double peak_intensity(const Emission& emission) {
  if (const auto* table = std::get_if<EmissionTable>(&emission))
    return *std::max_element(table->intensity.values().begin(), table->intensity.values().end());
  const double half = std::sqrt(0.5);
  return std::max(intensity(emission, {0, 0, 1}), intensity(emission, {half, 0, half}));
}

std::vector<TransceiverTypeSummary> transceiver_types(const Scene& scene) {
  std::vector<TransceiverTypeSummary> result;
  for (const TransceiverType& type : scene.transceiver_types)
    result.push_back({type.name, type_name(type.emission), type.file, type.radius, power(type.emission),
                      peak_intensity(type.emission), 0, 0, type.cost});
  std::vector<std::set<std::tuple<long, long, long>>> axes(result.size());
  for (const Transceiver& unit : scene.transceivers) {
    ++result[unit.type.value].units;
    axes[unit.type.value].insert(rounded(unit.axis));
  }
  for (std::size_t t = 0; t < result.size(); ++t) result[t].axes = axes[t].size();
  return result;
}

}  // namespace

StoreSummary summarize(const Scene& scene) {
  StoreSummary summary;
  summary.materials = materials(scene);
  summary.label_types = label_types(scene);
  summary.transceiver_types = transceiver_types(scene);
  const Places places = places_of(positions_of(scene.transceivers));
  std::vector<std::size_t> options(places.count);
  for (const std::uint32_t place : places.of) ++options[place];
  summary.mounting_points = places.count;
  summary.with_several_options = static_cast<std::size_t>(
      std::count_if(options.begin(), options.end(), [](std::size_t count) { return count > 1; }));
  summary.uncovered = uncovered_light(scene);
  summary.by_chance = chance_light(scene);
  return summary;
}

nlohmann::ordered_json summary_json(const Scene& scene, const StoreSummary& summary) {
  nlohmann::ordered_json json;
  json["name"] = scene.name;
  json["store_hash"] = scene.store_hash;
  json["wavelength_nm"] = scene.wavelength_nm;
  json["lower"] = {scene.lower.x, scene.lower.y, scene.lower.z};
  json["upper"] = {scene.upper.x, scene.upper.y, scene.upper.z};
  json["triangles"] = scene.mesh.triangles.size();
  json["fixtures"] = scene.fixtures.size();
  json["labels"] = scene.labels.size();
  json["transceivers"] = scene.transceivers.size();
  json["mounting_points"] = summary.mounting_points;
  json["mounting_points_with_several_options"] = summary.with_several_options;
  for (const MaterialSummary& m : summary.materials) {
    auto& one = json["materials"][m.name];
    one = {{"type", m.type}, {"reflectance", m.normal.reflected}, {"mean_reflectance", m.mean.reflected}};
    if (m.is_transparent) {
      one["transmittance"] = m.normal.transmitted;
      one["mean_transmittance"] = m.mean.transmitted;
    }
    one["area_m2"] = m.area;
    one["triangles"] = m.triangles;
  }
  for (const LabelTypeSummary& type : summary.label_types)
    json["label_types"][type.name] = {{"responsivity", type.responsivity},
                                      {"size_m", type.size},
                                      {"labels", type.labels},
                                      {"requirement", type.requirement}};
  for (const TransceiverTypeSummary& type : summary.transceiver_types) {
    json["transceiver_types"][type.name] = {{"emission", type.emission},  {"radius_m", type.radius},
                                            {"flux_w", type.flux},        {"peak_w_per_sr", type.peak},
                                            {"transceivers", type.units}, {"axes", type.axes},
                                            {"cost", type.cost}};
    if (!type.file.empty()) json["transceiver_types"][type.name]["file"] = type.file;
  }
  json["not_simulated"] = summary.uncovered;
  json["found_by_chance"] = summary.by_chance;
  json["warnings"] = scene.warnings;
  return json;
}

}  // namespace shelfbeam::app
