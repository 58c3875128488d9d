#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/transport/world/coverage.hpp"

#include "app/text/store_summary.hpp"
#include "app/text/text_table.hpp"

namespace shelfbeam::app {

namespace {

using Rows = std::vector<std::vector<std::string>>;

void print_head(const LoadedStore& store, const StoreSummary& summary) {
  const Scene& scene = store.scene;
  const Vec3 size = scene.upper - scene.lower;
  fmt::print("{}\n  {:.2f} x {:.2f} x {:.2f} m, {:g} nm, {} triangles, store hash {}\n", scene.name, size.x,
             size.y, size.z, scene.wavelength_nm, scene.mesh.triangles.size(), store.hash);
  fmt::print("  {} fixtures, {} labels, {} candidate transceivers", scene.fixtures.size(),
             scene.labels.size(), scene.transceivers.size());
  if (summary.with_several_options > 0)
    fmt::print(" at {} mounting points, {} of them with several options", summary.mounting_points,
               summary.with_several_options);
  fmt::print("\n");
}

// Of light from straight on, and the mean of light from all directions where that is another.
void print_materials(const StoreSummary& summary) {
  const auto& all = summary.materials;
  const bool any_transparent =
      std::any_of(all.begin(), all.end(), [](const MaterialSummary& m) { return m.is_transparent; });
  const auto share = [](double value) { return fmt::format("{:.3f}", value); };
  Rows rows{{"material", "type", "area m^2", "triangles", "reflectance", "mean"}};
  if (any_transparent) rows[0].insert(rows[0].end(), {"transmittance", "mean"});
  for (const MaterialSummary& m : all) {
    const bool is_even = m.type == Lambertian::type_name;
    rows.push_back({m.name, std::string(m.type), fmt::format("{:.2f}", m.area),
                    fmt::format("{}", m.triangles), share(m.normal.reflected),
                    is_even ? "" : share(m.mean.reflected)});
    if (m.is_transparent)
      rows.back().insert(rows.back().end(), {share(m.normal.transmitted), share(m.mean.transmitted)});
  }
  print_table(rows, 2);
}

void print_label_types(const StoreSummary& summary) {
  Rows rows{{"label type", "responsivity", "size mm", "labels", "requirement"}};
  for (const LabelTypeSummary& type : summary.label_types) {
    const bool is_point = type.size[0] == 0 && type.size[1] == 0;
    rows.push_back({type.name, std::string(type.responsivity),
                    is_point ? "point" : fmt::format("{:g} x {:g}", 1000 * type.size[0], 1000 * type.size[1]),
                    fmt::format("{}", type.labels), fmt::format("{:.6g}", type.requirement)});
  }
  print_table(rows, 2);
}

void print_transceiver_types(const StoreSummary& summary) {
  Rows rows{{"transceiver type", "emission", "radius m", "flux W", "peak W/sr", "units", "axes", "cost"}};
  for (const TransceiverTypeSummary& type : summary.transceiver_types)
    rows.push_back({type.name, type.file.empty() ? std::string(type.emission) : type.file,
                    type.radius == 0 ? "point" : fmt::format("{:g}", type.radius),
                    fmt::format("{:.4g}", type.flux), fmt::format("{:.4g}", type.peak),
                    fmt::format("{}", type.units), fmt::format("{}", type.axes),
                    fmt::format("{:g}", type.cost)});
  print_table(rows, 2);
}

void print_uncovered(const StoreSummary& summary) {
  if (summary.uncovered.empty()) return;
  fmt::print("\nnot simulated, unless the transceiver type gets a radius:\n");
  for (const std::string& light : summary.uncovered) fmt::print("  {}\n", light);
}

void print_by_chance(const StoreSummary& summary) {
  if (summary.by_chance.empty()) return;
  fmt::print("\nfound by chance only, with large errors:\n");
  for (const std::string& light : summary.by_chance) fmt::print("  {}\n", light);
}

void print_warnings(const Scene& scene) {
  for (const std::string& warning : scene.warnings) fmt::print("warning: {}\n", warning);
}

}  // namespace

void print_warnings(const CommonOptions& common, const Scene& scene, Strategy strategy) {
  if (common.json || common.quiet) return;
  print_warnings(scene);
  for (const std::string& light : chance_light(scene, strategy))
    fmt::print("warning: {} is found by chance only: take more samples, and see which errors are flagged\n",
               light);
}

void print_summary(const LoadedStore& store, const StoreSummary& summary) {
  print_head(store, summary);
  fmt::print("\n");
  print_materials(summary);
  fmt::print("\n");
  print_label_types(summary);
  fmt::print("\n");
  print_transceiver_types(summary);
  print_uncovered(summary);
  print_by_chance(summary);
  if (!store.scene.warnings.empty()) fmt::print("\n");
  print_warnings(store.scene);
}

}  // namespace shelfbeam::app
