#include "shelfbeam/scene/light_keys.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "shelfbeam/math/content_bytes.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"

namespace shelfbeam {

namespace {

template <class Described>
std::string text_of(Described value) {
  // The values refer to no list.
  const std::vector<NamedMaterial> materials;
  const std::vector<LabelType> label_types;
  const std::vector<TransceiverType> unit_types;
  return resolved(std::move(value), {materials, label_types, unit_types}).dump();
}

LabelType without_notes(LabelType type) {
  type.origin = {};
  type.order_number.clear();
  type.picture.clear();
  type.price.reset();
  return type;
}
TransceiverType without_notes(TransceiverType type) {
  type.origin = {};
  type.order_number.clear();
  type.fixing.clear();
  type.picture.clear();
  return type;
}

// The types without the values that do not affect light, so that any new value does.
std::string light_of(LabelType type) {
  const LabelType plain;
  type.threshold = plain.threshold;
  type.safety_factor = plain.safety_factor;
  type.link_cost = plain.link_cost;
  type.signal_cost = plain.signal_cost;
  type.availability = plain.availability;
  return text_of(without_notes(std::move(type)));
}
std::string light_of(TransceiverType type) {
  type.cost = TransceiverType{}.cost;
  return text_of(without_notes(std::move(type)));
}

template <class Type>
std::vector<std::string> lights_of(const std::vector<Type>& types) {
  std::vector<std::string> lights;
  lights.reserve(types.size());
  for (const Type& type : types) lights.push_back(light_of(type));
  return lights;
}

ContentBytes& add(ContentBytes& bytes, const Vec3& v) {
  return bytes.add(v.x).add(v.y).add(v.z);
}

std::uint64_t key_of(const std::string& type, const Vec3& position, const Vec3& direction, double factor = 1,
                     double roll_deg = 0) {
  ContentBytes bytes;
  bytes.add(type).add(factor).add(roll_deg);
  add(add(bytes, position), direction);
  return bytes.key();
}

std::string hash_of_surfaces(const Scene& scene) {
  ContentBytes bytes;
  bytes.add(scene.wavelength_nm);
  for (const Vec3& vertex : scene.mesh.vertices) add(bytes, vertex);
  for (const auto& [a, b, c] : scene.mesh.triangles) bytes.add(a).add(b).add(c);
  // Materials are numbered in the order of their first surfaces.
  std::vector<std::optional<std::uint32_t>> numbers(scene.materials.size());
  std::uint32_t count = 0;
  for (const MaterialId material : scene.mesh.materials) {
    auto& number = numbers[material.value];
    if (!number) {
      number = count++;
      bytes.add(text_of(NamedMaterial{{}, scene.materials[material.value].material, {}}));
    }
    bytes.add(*number);
  }
  // A material without a surface emits nothing.
  for (const EmittingSurface& surface : scene.emitting_surfaces)
    bytes.add(surface.id).add(numbers[surface.material.value].value_or(count)).add(surface.radiance);
  return bytes.hash();
}

}  // namespace

LightKeys light_keys(const Scene& scene) {
  LightKeys keys{hash_of_surfaces(scene), {}, light_keys_of(scene, scene.transceivers)};
  const std::vector<std::string> labels = lights_of(scene.label_types);
  for (const Label& label : scene.labels)
    keys.labels.push_back(key_of(labels[label.type.value], label.position, label.normal));
  return keys;
}

std::vector<std::uint64_t> light_keys_of(const Scene& scene, std::span<const Transceiver> units) {
  const std::vector<std::string> types = lights_of(scene.transceiver_types);
  std::vector<std::uint64_t> keys;
  for (const Transceiver& unit : units)
    keys.push_back(
        key_of(types[unit.type.value], unit.position, unit.axis, unit.relative_power, unit.roll_deg));
  return keys;
}

std::string scene_hash(const Scene& scene) {
  if (!scene.store_hash.empty()) return scene.store_hash;
  const LightKeys keys = light_keys(scene);
  ContentBytes bytes;
  bytes.add(keys.light_hash);
  for (const NamedMaterial& material : scene.materials) bytes.add(material.name).add(text_of(material));
  const auto add_types = [&](const auto& types) {
    for (const auto& type : types) bytes.add(type.name).add(text_of(without_notes(type)));
  };
  add_types(scene.label_types);
  add_types(scene.transceiver_types);
  for (std::size_t i = 0; i < scene.labels.size(); ++i)
    bytes.add(scene.labels[i].id)
        .add(scene.labels[i].type.value)
        .add(scene.labels[i].relative_sensitivity)
        .add(keys.labels[i]);
  for (std::size_t j = 0; j < scene.transceivers.size(); ++j)
    bytes.add(scene.transceivers[j].id)
        .add(scene.transceivers[j].type.value)
        .add(keys.transceivers[j])
        .add(scene.transceivers[j].installed)
        .add(scene.transceivers[j].pinned);
  return bytes.hash();
}

}  // namespace shelfbeam
