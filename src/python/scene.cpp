#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json_parser.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/scene/glb/scene_glb.hpp"
#include "shelfbeam/scene/states/store_states.hpp"

#include "jobs/plan_job_json.hpp"
#include "jobs/steps/simulation_step.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/shop.hpp"
#include "python/work.hpp"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace shelfbeam::python {

namespace {

std::shared_ptr<Shop> shop_of(Store store, const CancelToken* cancel) {
  store.cancel = cancel;
  Scene scene = make_inspected_scene(store);
  store.cancel = nullptr;
  return std::make_shared<Shop>(Shop{std::move(store), std::move(scene)});
}

py::list list_of(const std::vector<Finding>& findings) {
  py::list list;
  for (const Finding& finding : findings)
    list.append(py::make_tuple(std::string(name_of(finding.code)), finding.path, finding.sentence));
  return list;
}

std::shared_ptr<Shop> parsed(const std::string& text, const std::string& name, const fs::path& folder,
                             bool allow_outside) {
  return watched(0, py::none(), [&](const RunControl& control) {
    const StoreLimits limits{.allow_outside = allow_outside, .cancel = control.cancel};
    return shop_of(parse_store(text, name, folder, limits), control.cancel);
  });
}

py::list problems_of(const std::string& text, const std::string& name, const fs::path& folder,
                     bool allow_outside) {
  const auto findings = watched(0, py::none(), [&](const RunControl& control) {
    Problems problems(name);
    problems.collect([&] {
      const StoreLimits limits{.allow_outside = allow_outside, .cancel = control.cancel};
      const Store store = parse_store(text, name, folder, limits, &problems);
      if (problems.all().empty()) make_scene(store);
    });
    return problems.all();
  });
  return list_of(findings);
}

std::shared_ptr<Shop> state_of(const Shop& shop, const std::string& options, std::uint64_t k) {
  const jobs::PlanJob job = jobs::parse_plan_job(options, "options");
  return watched(0, py::none(), [&](const RunControl& control) {
    Store store = shop.store;
    store.cancel = control.cancel;
    leave_out(store, job.without);
    Store state = jobs::store_in_state(store, shop.scene, job.plan.seed, k);
    Scene scene = make_scene(state);
    state.cancel = nullptr;
    return std::make_shared<Shop>(Shop{std::move(state), std::move(scene)});
  });
}

py::dict scene_labels(const Scene& scene) {
  py::list id, type, position, normal, requirement;
  for (const Label& label : scene.labels) {
    id.append(label.id);
    type.append(scene.type_of(label).name);
    position.append(numbers(label.position));
    normal.append(numbers(label.normal));
    requirement.append(scene.requirement_of(label));
  }
  return py::dict(py::arg("id") = id, py::arg("type") = type, py::arg("position") = position,
                  py::arg("normal") = normal, py::arg("requirement") = requirement);
}

py::dict scene_units(const Scene& scene) {
  py::list id, type, position, axis, cost, installed, pinned;
  for (const Transceiver& unit : scene.transceivers) {
    id.append(unit.id);
    type.append(scene.type_of(unit).name);
    position.append(numbers(unit.position));
    axis.append(numbers(unit.axis));
    cost.append(scene.type_of(unit).cost);
    installed.append(unit.installed);
    pinned.append(unit.pinned);
  }
  return py::dict(py::arg("id") = id, py::arg("type") = type, py::arg("position") = position,
                  py::arg("axis") = axis, py::arg("cost") = cost, py::arg("installed") = installed,
                  py::arg("pinned") = pinned);
}

py::list outlines_of(const Scene& scene) {
  py::list list;
  for (const FixtureOutline& fixture : scene.fixtures)
    list.append(py::make_tuple(fixture.id, corners(fixture.footprint), fixture.height));
  return list;
}

py::list materials_of(const Scene& scene) {
  py::list list;
  for (const NamedMaterial& material : scene.materials) list.append(material.name);
  return list;
}

}  // namespace

void bind_scene(py::module_& module) {
  py::class_<Shop, std::shared_ptr<Shop>>(module, "Scene", "A store, checked and frozen.")
      .def_static("parse", parsed)
      .def_property_readonly("name", [](const Shop& shop) { return shop.scene.name; })
      .def_property_readonly("hash", [](const Shop& shop) { return scene_hash(shop.scene); })
      .def_property_readonly("varies", [](const Shop& shop) { return shop.store.variation.has_value(); })
      .def_property_readonly("warnings", [](const Shop& shop) { return list_of(shop.scene.warnings); })
      .def("labels", [](const Shop& shop) { return scene_labels(shop.scene); })
      .def("units", [](const Shop& shop) { return scene_units(shop.scene); })
      .def("outlines", [](const Shop& shop) { return outlines_of(shop.scene); })
      .def("room_outline",
           [](const Shop& shop) {
             return shop.scene.room ? py::object(corners(shop.scene.room->outline)) : py::none();
           })
      .def_property_readonly("bounds",
                             [](const Shop& shop) {
                               return py::make_tuple(numbers(shop.scene.lower), numbers(shop.scene.upper));
                             })
      .def_property_readonly("materials", [](const Shop& shop) { return materials_of(shop.scene); })
      .def_property_readonly("vertices",
                             [](const py::object& self) {
                               static_assert(sizeof(Vec3) == 3 * sizeof(double));
                               const auto& vertices = self.cast<const Shop&>().scene.mesh.vertices;
                               return view_of(reinterpret_cast<const double*>(vertices.data()),
                                              {static_cast<py::ssize_t>(vertices.size()), 3}, self);
                             })
      .def_property_readonly("triangles",
                             [](const py::object& self) {
                               const auto& triangles = self.cast<const Shop&>().scene.mesh.triangles;
                               return view_of(reinterpret_cast<const std::uint32_t*>(triangles.data()),
                                              {static_cast<py::ssize_t>(triangles.size()), 3}, self);
                             })
      .def_property_readonly("triangle_materials",
                             [](const py::object& self) {
                               static_assert(sizeof(MaterialId) == sizeof(std::uint32_t));
                               const auto& materials = self.cast<const Shop&>().scene.mesh.materials;
                               return view_of(reinterpret_cast<const std::uint32_t*>(materials.data()),
                                              {static_cast<py::ssize_t>(materials.size())}, self);
                             })
      .def("resolved",
           [](const Shop& shop) {
             return watched(0, py::none(),
                            [&](const RunControl&) { return resolved_store_json(shop.store, shop.scene); });
           })
      .def("state", state_of)
      .def("svg",
           [](const Shop& shop, bool with_ids) {
             return watched(0, py::none(),
                            [&](const RunControl&) { return floor_plan_svg(shop.scene, with_ids); });
           })
      .def("glb", [](const Shop& shop) { return py::bytes(scene_glb(shop.scene)); });
  module.def("problems_of", problems_of);
  module.def("plain_json",
             [](const std::string& text, const std::string& name) { return parse_json(text, name).dump(); });
  module.def("write_text", [](const std::string& text, const fs::path& path) { write_file(path, text); });
}

}  // namespace shelfbeam::python
