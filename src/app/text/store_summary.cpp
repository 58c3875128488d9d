#include "app/text/store_summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/fields/finding_json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/material/material_shares.hpp"
#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/report/messages/light.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/transport/world/coverage.hpp"

#include "app/text/style.hpp"
#include "app/text/terminal.hpp"

namespace shelfbeam::app {

namespace {

// Vectors that differ by less than 1e-6 (positions: a micrometre) count as equal.
std::tuple<long, long, long> rounded(const Vec3& v) {
  return {std::lround(v.x * 1e6), std::lround(v.y * 1e6), std::lround(v.z * 1e6)};
}

// Closed forms have their maximum on the axis or at 45 degrees, tables at a node.
double peak_intensity(const Emission& emission) {
  if (const auto* table = std::get_if<EmissionTable>(&emission))
    return *std::max_element(table->intensity.values().begin(), table->intensity.values().end());
  const double half = std::sqrt(0.5);
  return std::max(intensity(emission, {0, 0, 1}), intensity(emission, {half, 0, half}));
}

struct MaterialUse {
  MaterialShares normal, mean;  // at normal incidence; averaged over all directions
  double area = 0;              // m^2
  std::size_t triangles = 0;
};

// Counts and areas per material, label type and transceiver type, and mounting points.
struct Counts {
  std::vector<MaterialUse> materials;
  std::vector<std::size_t> labels, units;
  std::vector<std::set<std::tuple<long, long, long>>> axes;  // distinct axes per type
  std::size_t mounting_points, with_several_options;

  explicit Counts(const Scene& scene)
      : labels(scene.label_types.size()),
        units(scene.transceiver_types.size()),
        axes(scene.transceiver_types.size()) {
    for (const auto& [name, material, range] : scene.materials)
      materials.push_back({shares_at_normal(material), hemispherical_shares(material)});
    const TriangleMesh& mesh = scene.mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      MaterialUse& one = materials[mesh.materials[t].value];
      ++one.triangles;
      one.area += length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
    }
    for (const Label& label : scene.labels) ++labels[label.type.value];
    for (const Transceiver& unit : scene.transceivers) {
      ++units[unit.type.value];
      axes[unit.type.value].insert(rounded(unit.axis));
    }
    const DistinctPositions groups = distinct_positions(positions_of(scene.transceivers));
    std::vector<std::size_t> options(groups.count);
    for (const std::uint32_t group : groups.group_of) ++options[group];
    mounting_points = groups.count;
    with_several_options = static_cast<std::size_t>(
        std::count_if(options.begin(), options.end(), [](std::size_t count) { return count > 1; }));
  }
};

using Rows = std::vector<std::vector<std::string>>;

std::size_t zones_of(const Scene& scene) {
  return scene.room ? scene.room->zones.size() : 0;
}

void print_head(const Scene& scene, const Counts& counts) {
  const Vec3 size = scene.upper - scene.lower;
  fmt::print("{}\n", styled(Style::answer, one_line(scene.name)));
  fmt::print("  {:.2f} x {:.2f} x {:.2f} m, {:g} nm, {} triangles, store hash {}\n", size.x, size.y, size.z,
             scene.wavelength_nm, scene.mesh.triangles.size(), scene.store_hash);
  fmt::print("  {} fixtures", scene.fixtures.size() - scene.inner_walls());
  const auto print_count = [](std::size_t count, const char* name) {
    if (count > 0) fmt::print(", {} {}{}", count, name, count == 1 ? "" : "s");
  };
  print_count(scene.inner_walls(), "inner wall");
  print_count(zones_of(scene), "ceiling zone");
  fmt::print(", {} labels, {} candidate transceivers", scene.labels.size(), scene.transceivers.size());
  if (counts.with_several_options > 0)
    fmt::print(" at {} mounting points, {} of them with several options", counts.mounting_points,
               counts.with_several_options);
  fmt::print("\n");
}

// Shares at normal incidence, and their mean over all directions if it differs.
void print_materials(const Scene& scene, const Counts& counts) {
  const auto& all = scene.materials;
  const bool any_transparent =
      std::any_of(all.begin(), all.end(), [](const NamedMaterial& m) { return !is_opaque(m.material); });
  const auto share = [](double value) { return fmt::format("{:.3f}", value); };
  Rows rows{{"material", "type", "area m^2", "triangles", "reflectance", "mean"}};
  if (any_transparent) rows[0].insert(rows[0].end(), {"transmittance", "mean"});
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Material& material = all[k].material;
    const MaterialUse& use = counts.materials[k];
    const bool is_even = std::holds_alternative<Lambertian>(material);
    rows.push_back({all[k].name, std::string(type_name(material)), fmt::format("{:.2f}", use.area),
                    fmt::format("{}", use.triangles), share(use.normal.reflected),
                    is_even ? "" : share(use.mean.reflected)});
    if (!is_opaque(material))
      rows.back().insert(rows.back().end(), {share(use.normal.transmitted), share(use.mean.transmitted)});
  }
  print_table(rows, 2);
}

void print_label_types(const Scene& scene, const Counts& counts) {
  Rows rows{{"label type", "responsivity", "size mm", "labels", "requirement"}};
  for (std::size_t k = 0; k < scene.label_types.size(); ++k) {
    const LabelType& type = scene.label_types[k];
    const bool is_point = type.size[0] == 0 && type.size[1] == 0;
    rows.push_back({type.name, std::string(type_name(type.responsivity)),
                    is_point ? "point" : fmt::format("{:g} x {:g}", 1000 * type.size[0], 1000 * type.size[1]),
                    fmt::format("{}", counts.labels[k]), fmt::format("{:.6g}", type.requirement())});
  }
  print_table(rows, 2);
}

void print_transceiver_types(const Scene& scene, const Counts& counts) {
  Rows rows{{"transceiver type", "emission", "radius m", "flux W", "peak W/sr", "units", "axes", "cost"}};
  for (std::size_t k = 0; k < scene.transceiver_types.size(); ++k) {
    const TransceiverType& type = scene.transceiver_types[k];
    rows.push_back({type.name, type.file.empty() ? std::string(type_name(type.emission)) : type.file,
                    type.radius == 0 ? "point" : fmt::format("{:g}", type.radius),
                    fmt::format("{:.4g}", power(type.emission)),
                    fmt::format("{:.4g}", peak_intensity(type.emission)), fmt::format("{}", counts.units[k]),
                    fmt::format("{}", counts.axes[k].size()), fmt::format("{:g}", type.cost)});
  }
  print_table(rows, 2);
}

void print_warning(const std::string& text) {
  fmt::print("{} {}\n", styled(Style::warning, "warning:"), one_line(text));
}

void print_warnings(const Scene& scene) {
  for (const Finding& warning : scene.warnings) print_warning(warning.sentence);
  if (scene.ignored_warnings > 0)
    fmt::print("{}\n", counted(scene.ignored_warnings, "warning") + " ignored, as the store asks");
}

}  // namespace

void print_list(std::string_view heading, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  fmt::print("\n{}:\n", heading);
  for (const std::string& line : lines) fmt::print("  {}\n", one_line(line));
}

void print_warnings(const CommonOptions& common, const std::vector<Finding>& warnings) {
  if (common.quiet) return;
  for (const Finding& warning : warnings) {
    if (common.json)
      print_message("warning: {}\n", one_line(warning.sentence));
    else
      print_warning(warning.sentence);
  }
}

void print_warnings(const CommonOptions& common, const Scene& scene, Strategy strategy) {
  if (common.json || common.quiet) return;
  print_warnings(scene);
  for (const std::string& light : light_texts(english(), chance_light(scene, strategy), scene))
    print_warning(light + " is hard to sample: use more samples and check the flagged entries");
}

void print_summary(const Scene& scene, const std::string& written) {
  const Counts counts(scene);
  print_head(scene, counts);
  print_warnings(scene);
  if (!written.empty()) fmt::print("{}\n", written);
  fmt::print("\n");
  print_materials(scene, counts);
  fmt::print("\n");
  print_label_types(scene, counts);
  fmt::print("\n");
  print_transceiver_types(scene, counts);
  print_list("not simulated unless the transceiver type has a radius",
             light_texts(english(), uncovered_light(scene), scene));
  print_list("hard to sample, with large standard errors",
             light_texts(english(), chance_light(scene), scene));
}

nlohmann::ordered_json summary_json(const Scene& scene) {
  const Counts counts(scene);
  nlohmann::ordered_json json;
  json["name"] = scene.name;
  json["store_hash"] = scene.store_hash;
  json["wavelength_nm"] = scene.wavelength_nm;
  json["lower"] = {scene.lower.x, scene.lower.y, scene.lower.z};
  json["upper"] = {scene.upper.x, scene.upper.y, scene.upper.z};
  json["triangles"] = scene.mesh.triangles.size();
  json["fixtures"] = scene.fixtures.size() - scene.inner_walls();
  if (scene.inner_walls() > 0) json["inner_walls"] = scene.inner_walls();
  if (zones_of(scene) > 0) json["ceiling_zones"] = zones_of(scene);
  json["labels"] = scene.labels.size();
  json["transceivers"] = scene.transceivers.size();
  json["mounting_points"] = counts.mounting_points;
  json["mounting_points_with_several_options"] = counts.with_several_options;
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const auto& [name, material, range] = scene.materials[k];
    const auto& [normal, mean, area, triangles] = counts.materials[k];
    auto& one = json["materials"][name];
    one = {{"type", type_name(material)},
           {"reflectance", normal.reflected},
           {"mean_reflectance", mean.reflected}};
    if (!is_opaque(material)) {
      one["transmittance"] = normal.transmitted;
      one["mean_transmittance"] = mean.transmitted;
    }
    one["area_m2"] = area;
    one["triangles"] = triangles;
  }
  for (std::size_t k = 0; k < scene.label_types.size(); ++k) {
    const LabelType& type = scene.label_types[k];
    json["label_types"][type.name] = {{"responsivity", type_name(type.responsivity)},
                                      {"size_m", type.size},
                                      {"labels", counts.labels[k]},
                                      {"requirement", type.requirement()}};
  }
  for (std::size_t k = 0; k < scene.transceiver_types.size(); ++k) {
    const TransceiverType& type = scene.transceiver_types[k];
    auto& one = json["transceiver_types"][type.name];
    one = {{"emission", type_name(type.emission)},
           {"radius_m", type.radius},
           {"flux_w", power(type.emission)},
           {"peak_w_per_sr", peak_intensity(type.emission)},
           {"transceivers", counts.units[k]},
           {"axes", counts.axes[k].size()},
           {"cost", type.cost}};
    if (!type.file.empty()) one["file"] = type.file;
  }
  json["not_simulated"] = light_texts(english(), uncovered_light(scene), scene);
  json["found_by_chance"] = light_texts(english(), chance_light(scene), scene);
  json["warnings"] = sentences(scene.warnings);
  json["findings"] = to_json(scene.warnings);
  json["ignored_warnings"] = scene.ignored_warnings;
  return json;
}

}  // namespace shelfbeam::app
