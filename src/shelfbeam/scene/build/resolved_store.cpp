#include <cstddef>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/material/material_json.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

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
  Json json{{"responsivity", with_type(type.responsivity)},
            {"size", type.size},
            {"threshold", type.threshold},
            {"safety_factor", type.safety_factor},
            {"link_cost", type.link_cost},
            {"signal_cost", type.signal_cost}};
  if (type.availability != LabelType{}.availability) json["availability"] = type.availability;
  return json;
}

Json resolved(const TransceiverType& type) {
  return {{"emission", with_type(type.emission)}, {"radius", type.radius}, {"cost", type.cost}};
}

// Hashes the bytes of the numbers, because conversion to text would be slow for a large mesh.
template <class T>
std::string hash_of(const std::vector<T>& numbers) {
  return content_hash({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

// Appends a list at this level of nesting as Json::dump(1) writes it. The list never exists as Json, which
// would take several times the memory of the scene.
template <class Items, class ToJson>
void append_list(std::string& text, std::size_t level, const Items& items, const CancelToken* cancel,
                 ToJson to_json) {
  const std::string line = "\n" + std::string(level + 1, ' ');
  const char* separator = "[";
  for (const auto& item : items) {
    expect_running(cancel);
    text += separator + line;
    for (const char c : to_json(item).dump(1)) {
      if (c == '\n')
        text += line;
      else
        text += c;
    }
    separator = ",";
  }
  text += items.empty() ? "[]" : line.substr(0, level + 1) + "]";
}

}  // namespace

std::string resolved_store_json(const Store& store, const Scene& scene) {
  Json json;
  json["format"] = store_format_version;
  json["name"] = store.name;
  json["wavelength_nm"] = store.wavelength_nm;
  if (!store.currency.empty()) json["currency"] = store.currency;
  if (store.room) json["room"] = resolved(*store.room, store.materials);
  for (const auto& [name, material, range] : store.materials) {
    Json& written = json["materials"][name] = resolved(material);
    if (range) written["reflectance_range"] = *range;
  }
  for (const LabelType& type : store.label_types) json["label_types"][type.name] = resolved(type);
  for (const TransceiverType& type : store.transceiver_types)
    json["transceiver_types"][type.name] = resolved(type);
  if (store.variation) json["variation"] = resolved(*store.variation, store);
  std::string text = json.dump(1);
  text.resize(text.size() - 2);  // without "\n}"
  text += ",\n \"fixtures\": ";
  append_list(text, 1, store.fixtures, store.cancel,
              [&](const auto& listed) { return resolved(listed.value, store.materials); });
  text += ",\n \"labels\": ";
  append_list(text, 1, scene.labels, store.cancel, [&](const Label& label) {
    Json one{{"id", label.id},
             {"position", array_of(label.position)},
             {"normal", array_of(label.normal)},
             {"type", scene.type_of(label).name}};
    if (label.relative_sensitivity != 1) one["relative_sensitivity"] = label.relative_sensitivity;
    return one;
  });
  text += ",\n \"transceivers\": {\n  \"list\": ";
  append_list(text, 2, scene.transceivers, store.cancel, [&](const Transceiver& unit) {
    Json one{{"id", unit.id},
             {"position", array_of(unit.position)},
             {"axis", array_of(unit.axis)},
             {"roll_deg", unit.roll_deg},
             {"type", scene.type_of(unit).name}};
    if (unit.relative_power != 1) one["relative_power"] = unit.relative_power;
    return one;
  });
  std::vector<std::string> installed;
  for (const Transceiver& unit : scene.transceivers)
    if (unit.installed) installed.push_back(unit.id);
  text += ",\n  \"installed\": ";
  append_list(text, 2, installed, store.cancel, [](const std::string& id) { return Json(id); });
  return text + "\n }\n}\n";
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
  for (const Label& label : scene.labels) {
    json["labels"].push_back({label.id, array_of(label.position), array_of(label.normal), label.type.value});
    if (label.relative_sensitivity != 1) json["labels"].back().push_back(label.relative_sensitivity);
  }
  for (const Transceiver& unit : scene.transceivers) {
    json["transceivers"].push_back({unit.id, array_of(unit.position), array_of(unit.axis), unit.roll_deg,
                                    unit.type.value, unit.installed});
    if (unit.relative_power != 1) json["transceivers"].back().push_back(unit.relative_power);
  }
  for (const EmittingSurface& surface : scene.emitting_surfaces)
    json["emitting_surfaces"].push_back({surface.id, surface.material.value, surface.radiance});
  return content_hash(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace shelfbeam
