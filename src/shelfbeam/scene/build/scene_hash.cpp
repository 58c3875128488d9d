#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/build/resolved_types.hpp"
#include "shelfbeam/scene/fixture/fixture_writer.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/material_json.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

// Of numbers side by side: as text a large mesh would take a while.
template <class T>
std::string hash_of(const std::vector<T>& numbers) {
  return content_hash({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

}  // namespace

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
