#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/math/places.hpp"
#include "shelfbeam/report/report.hpp"

#include "arguments.hpp"
#include "loaded_store.hpp"
#include "print_json.hpp"
#include "verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  std::filesystem::path store, plan;
};

struct MaterialUse {
  std::size_t triangles = 0;
  double area = 0;  ///< m^2
};

std::vector<MaterialUse> material_use(const Scene& scene) {
  std::vector<MaterialUse> use(scene.materials.size());
  const TriangleMesh& mesh = scene.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    MaterialUse& one = use[mesh.materials[t].value];
    ++one.triangles;
    one.area += length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
  }
  return use;
}

double hemispherical_albedo(const Material& material) {
  return albedo(material, {0, 0, 1});
}

template <class List, class TypeId>
std::size_t count_of(const List& list, TypeId type) {
  std::size_t count = 0;
  for (const auto& item : list) count += item.type == type ? 1 : 0;
  return count;
}

std::size_t mounting_points(const Scene& scene) {
  return places_of(positions_of(scene.transceivers)).count;
}

nlohmann::ordered_json as_json(const LoadedStore& store) {
  const Scene& scene = store.scene;
  nlohmann::ordered_json json;
  json["name"] = scene.name;
  json["store_hash"] = store.hash;
  json["lower"] = {scene.lower.x, scene.lower.y, scene.lower.z};
  json["upper"] = {scene.upper.x, scene.upper.y, scene.upper.z};
  json["triangles"] = scene.mesh.triangles.size();
  json["fixtures"] = scene.fixtures.size();
  json["labels"] = scene.labels.size();
  json["transceivers"] = scene.transceivers.size();
  json["mounting_points"] = mounting_points(scene);
  const auto use = material_use(scene);
  for (std::size_t m = 0; m < use.size(); ++m)
    json["materials"][scene.materials[m].name] = {
        {"type", type_name(scene.materials[m].material)},
        {"reflectance", hemispherical_albedo(scene.materials[m].material)},
        {"area_m2", use[m].area},
        {"triangles", use[m].triangles}};
  for (std::size_t t = 0; t < scene.label_types.size(); ++t)
    json["label_types"][scene.label_types[t].name] = {
        {"labels", count_of(scene.labels, LabelTypeId{static_cast<std::uint32_t>(t)})},
        {"requirement", scene.label_types[t].requirement()}};
  for (std::size_t t = 0; t < scene.transceiver_types.size(); ++t)
    json["transceiver_types"][scene.transceiver_types[t].name] = {
        {"transceivers", count_of(scene.transceivers, TransceiverTypeId{static_cast<std::uint32_t>(t)})},
        {"emission", type_name(scene.transceiver_types[t].emission)},
        {"flux_w", power(scene.transceiver_types[t].emission)},
        {"cost", scene.transceiver_types[t].cost}};
  json["warnings"] = scene.warnings;
  return json;
}

void print(const LoadedStore& store) {
  const Scene& scene = store.scene;
  const Vec3 size = scene.upper - scene.lower;
  fmt::print("{}\n  {:.2f} x {:.2f} x {:.2f} m, {:g} nm, {} triangles, store hash {}\n", scene.name, size.x,
             size.y, size.z, scene.wavelength_nm, scene.mesh.triangles.size(), store.hash);
  const std::size_t points = mounting_points(scene);
  fmt::print("  {} fixtures, {} labels, {} candidate transceivers{}\n\n", scene.fixtures.size(),
             scene.labels.size(), scene.transceivers.size(),
             points < scene.transceivers.size() ? fmt::format(" at {} mounting points", points) : "");
  fmt::print("  {:<16} {:<12} {:>11} {:>10} {:>10}\n", "material", "type", "reflectance", "area m^2",
             "triangles");
  const auto use = material_use(scene);
  for (std::size_t m = 0; m < use.size(); ++m)
    fmt::print("  {:<16} {:<12} {:>11.3f} {:>10.2f} {:>10}\n", scene.materials[m].name,
               type_name(scene.materials[m].material), hemispherical_albedo(scene.materials[m].material),
               use[m].area, use[m].triangles);
  fmt::print("\n  {:<16} {:>8} {:>16}\n", "label type", "labels", "requirement");
  for (std::size_t t = 0; t < scene.label_types.size(); ++t)
    fmt::print("  {:<16} {:>8} {:>16.6g}\n", scene.label_types[t].name,
               count_of(scene.labels, LabelTypeId{static_cast<std::uint32_t>(t)}),
               scene.label_types[t].requirement());
  fmt::print("\n  {:<16} {:<12} {:>8} {:>10} {:>8}\n", "transceiver type", "emission", "units", "flux W",
             "cost");
  for (std::size_t t = 0; t < scene.transceiver_types.size(); ++t)
    fmt::print("  {:<16} {:<12} {:>8} {:>10.4g} {:>8g}\n", scene.transceiver_types[t].name,
               type_name(scene.transceiver_types[t].emission),
               count_of(scene.transceivers, TransceiverTypeId{static_cast<std::uint32_t>(t)}),
               power(scene.transceiver_types[t].emission), scene.transceiver_types[t].cost);
  for (const std::string& warning : scene.warnings) fmt::print("\nwarning: {}\n", warning);
}

int run_inspect(const Options& options) {
  keep_input(options.plan, options.store);
  const LoadedStore store = load_store(options.store);
  if (!options.plan.empty()) write_file(options.plan, floor_plan_svg(store.scene));
  if (options.common.json) {
    print_json(as_json(store));
  } else if (!options.common.quiet) {
    print(store);
    if (!options.plan.empty()) fmt::print("\nfloor plan: {}\n", options.plan.string());
  }
  return done;
}

}  // namespace

void add_inspect(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("inspect", "Check a store file; show dimensions, counts, areas, flux and the plan");
  auto options = std::make_shared<Options>();
  verb->add_option("STORE", options->store, "Store file")->required()->check(a_path());
  verb->add_option("-o,--output", options->plan, "Write the floor plan as SVG to this file")->check(a_path());
  add_common_options(*verb, options->common);
  verb->footer("Examples:\n  shelfbeam inspect store.json\n  shelfbeam inspect store.json -o plan.svg");
  verb->callback([options, &chosen] { chosen = [options] { return run_inspect(*options); }; });
}

}  // namespace shelfbeam::app
