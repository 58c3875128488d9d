#include <cstddef>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/material/material_json.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

Json in_degrees(const std::vector<double>& angles) {
  Json result = Json::array();
  for (const double angle : angles) result.push_back(degrees_of(angle));
  return result;
}

// Types in the resolved store: without references, and identical to the bit when read back.

Json keys(const SinTwoTheta& e) {
  return {{"peak", e.peak}};
}
Json keys(const IsotropicHemisphere& e) {
  return {{"intensity", e.intensity}};
}
Json keys(const GeneralizedLambertian& e) {
  return {{"order", e.order}, {"flux", e.flux}};
}
Json keys(const EmissionTable& e) {
  const DirectionTable& table = e.intensity;
  Json json{{"theta_deg", in_degrees(table.theta())}};
  if (table.phi().size() == 1) {
    json["intensity"] = table.values();
    return json;
  }
  json["phi_deg"] = in_degrees(table.phi());
  json["intensity"] = Json::array();
  const auto width = static_cast<std::ptrdiff_t>(table.theta().size());
  for (auto row = table.values().begin(); row != table.values().end(); row += width)
    json["intensity"].push_back(std::vector<double>(row, row + width));
  return json;
}
Json keys(const CosineResponse&) {
  return Json::object();
}
Json keys(const CosinePowerResponse& r) {
  return {{"exponent", r.exponent}, {"cutoff_deg", degrees_of(r.cutoff)}};
}
Json keys(const ResponseTable& r) {
  return {{"theta_deg", in_degrees(r.response.theta())}, {"response", r.response.values()}};
}

template <class Variant>
Json with_type(const Variant& value) {
  Json json{{"type", type_name(value)}};
  json.update(std::visit([](const auto& one) { return keys(one); }, value));
  return json;
}

Json resolved(const LabelType& type) {
  return {{"responsivity", with_type(type.responsivity)},
          {"size", type.size},
          {"threshold", type.threshold},
          {"safety_factor", type.safety_factor},
          {"link_cost", type.link_cost},
          {"signal_cost", type.signal_cost}};
}

Json resolved(const TransceiverType& type) {
  return {{"emission", with_type(type.emission)}, {"radius", type.radius}, {"cost", type.cost}};
}

Json resolved(const Room& room, const std::vector<NamedMaterial>& materials) {
  const auto name = [&](std::size_t side) { return materials[room.materials[side].value].name; };
  return {{"size", array_of(room.size)},
          {"floor", name(4)},
          {"ceiling", name(5)},
          {"walls", {{"x0", name(0)}, {"x1", name(1)}, {"y0", name(2)}, {"y1", name(3)}}}};
}

// Hashes the bytes of the numbers, because conversion to text would be slow for a large mesh.
template <class T>
std::string hash_of(const std::vector<T>& numbers) {
  return content_hash({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

}  // namespace

std::string resolved_store_json(const Store& store, const Scene& scene) {
  Json json;
  json["format"] = store_format_version;
  json["name"] = store.name;
  json["wavelength_nm"] = store.wavelength_nm;
  if (store.room) json["room"] = resolved(*store.room, store.materials);
  for (const auto& [name, material, range] : store.materials) {
    Json& written = json["materials"][name] = resolved(material);
    if (range) written["reflectance_range"] = *range;
  }
  for (const LabelType& type : store.label_types) json["label_types"][type.name] = resolved(type);
  for (const TransceiverType& type : store.transceiver_types)
    json["transceiver_types"][type.name] = resolved(type);
  json["fixtures"] = Json::array();
  for (const auto& [fixture, where] : store.fixtures) {
    FixtureWriter writer{json["fixtures"].emplace_back(), store.materials};
    write(fixture, writer);
  }
  json["labels"] = Json::array();
  for (const Label& label : scene.labels)
    json["labels"].push_back({{"id", label.id},
                              {"position", array_of(label.position)},
                              {"normal", array_of(label.normal)},
                              {"type", scene.type_of(label).name}});
  json["transceivers"] = {{"list", Json::array()}, {"installed", Json::array()}};
  for (const Transceiver& unit : scene.transceivers) {
    json["transceivers"]["list"].push_back({{"id", unit.id},
                                            {"position", array_of(unit.position)},
                                            {"axis", array_of(unit.axis)},
                                            {"roll_deg", unit.roll_deg},
                                            {"type", scene.type_of(unit).name}});
    if (unit.installed) json["transceivers"]["installed"].push_back(unit.id);
  }
  return json.dump(1) + "\n";
}

std::string scene_hash(const Scene& scene) {
  if (!scene.store_hash.empty()) return scene.store_hash;
  Json json{{"wavelength_nm", scene.wavelength_nm},
            {"vertices", hash_of(scene.mesh.vertices)},
            {"triangles", hash_of(scene.mesh.triangles)},
            {"surfaces", hash_of(scene.mesh.materials)}};
  for (const NamedMaterial& one : scene.materials) json["materials"].push_back(resolved(one.material));
  for (const LabelType& type : scene.label_types) json["label_types"].push_back({type.name, resolved(type)});
  for (const TransceiverType& type : scene.transceiver_types)
    json["transceiver_types"].push_back({type.name, resolved(type)});
  for (const Label& label : scene.labels)
    json["labels"].push_back({label.id, array_of(label.position), array_of(label.normal), label.type.value});
  for (const Transceiver& unit : scene.transceivers)
    json["transceivers"].push_back({unit.id, array_of(unit.position), array_of(unit.axis), unit.roll_deg,
                                    unit.type.value, unit.installed});
  for (const EmittingSurface& surface : scene.emitting_surfaces)
    json["emitting_surfaces"].push_back({surface.id, surface.material.value, surface.radiance});
  return content_hash(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace shelfbeam
