#include "shelfbeam/scene/build/decisive_values.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json_parser.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/value_marks.hpp"

namespace shelfbeam {

namespace embedded {

extern const std::string_view starter_store, starter_catalogue;

}  // namespace embedded

std::string_view starter_store() {
  return embedded::starter_store;
}
std::string_view starter_catalogue() {
  return embedded::starter_catalogue;
}

namespace {

using Json = nlohmann::ordered_json;

// The value of a key, as text; of long tables, their hash.
template <class Described>
std::string value_of(Described described, const StoreLists& lists, const char* key) {
  constexpr std::size_t longest = 400;
  const Json json = resolved(std::move(described), lists);
  const Json value =
      key == std::string_view("height") && json.contains("size") ? json["size"][2] : json.value(key, Json());
  std::string text = value.dump();
  if (text.size() <= longest) return text;
  return Json{{"type", value["type"]}, {"content", content_hash(text)}}.dump();
}

template <class Type>
const Type* named(const std::vector<Type>& types, std::string_view name) {
  const auto found = std::ranges::find(types, name, &Type::name);
  return found == types.end() ? nullptr : &*found;
}

// The values of a store, without their states.
class ValuesOf {
 public:
  explicit ValuesOf(const Store& store)
      : store_(store), lists_{store.materials, store.label_types, store.transceiver_types} {}

  DecisiveValue of(ValueKind kind, const LabelType& type) const {
    if (kind == ValueKind::threshold)
      return {kind, type.name, {}, type.threshold, value_of(type, lists_, "threshold")};
    return {kind, type.name, {}, 0, value_of(type, lists_, "responsivity")};
  }
  DecisiveValue of(ValueKind kind, const TransceiverType& type) const {
    if (kind == ValueKind::power)
      return {kind, type.name, {}, power(type.emission), value_of(type, lists_, "emission")};
    return {kind, type.name, {}, type.cost, value_of(type, lists_, "cost")};
  }
  DecisiveValue of(const NamedMaterial& material) const {
    const double reflectance = given_reflectance(material.material).value_or(0);
    return {
        ValueKind::reflectance, material.name, {}, reflectance, value_of(material, lists_, "reflectance")};
  }
  DecisiveValue of_height() const {
    const CeilingHeight& height = store_.room->shape.height;
    return {ValueKind::height,
            {},
            {},
            height.points ? 0 : height.level,
            value_of(*store_.room, lists_, "height")};
  }
  // A material without its name.
  std::string whole(const NamedMaterial& material) const { return resolved(material, lists_).dump(); }

 private:
  const Store& store_;
  StoreLists lists_;
};

// The starter with the materials of its catalogue.
Store starter_with_materials() {
  Json store = parse_json(starter_store(), "store.json");
  const Json catalogue = parse_json(starter_catalogue(), "catalogue.json");
  store.erase("catalogues");
  store["materials"].update(catalogue["materials"]);
  return parse_store(store.dump(), "store.json", {});
}

const Store& starter() {
  static const Store store = starter_with_materials();
  return store;
}

class ValueStates {
 public:
  explicit ValueStates(const Store& store) : store_(store), values_(store), starter_(starter()) {}

  DecisiveValue threshold(const LabelType& type) const {
    DecisiveValue value = in_state(values_.of(ValueKind::threshold, type), &type.origin, [&] {
      return starter_.of(ValueKind::threshold, starter().label_types.front()).value;
    });
    // A threshold by distance is as well known as the power of the unit there.
    if (const TransceiverType* unit = named(store_.transceiver_types, type.range_of))
      value.state = std::min(value.state, power(*unit).state);
    return value;
  }
  DecisiveValue responsivity(const LabelType& type) const {
    return in_state(values_.of(ValueKind::responsivity, type), &type.origin, [&] {
      return starter_.of(ValueKind::responsivity, starter().label_types.front()).value;
    });
  }
  DecisiveValue power(const TransceiverType& type) const {
    return in_state(values_.of(ValueKind::power, type), &type.origin,
                    [&] { return starter_.of(ValueKind::power, starter().transceiver_types.front()).value; });
  }
  DecisiveValue price(const TransceiverType& type) const {
    return in_state(values_.of(ValueKind::price, type), &type.origin, [] { return std::string(); });
  }
  DecisiveValue reflectance(const NamedMaterial& material) const {
    DecisiveValue value = values_.of(material);
    return in_state(value, nullptr, [&] {
      const auto& known = starter().materials;
      const NamedMaterial* same = named(known, material.name);
      if (same != nullptr && same_value(starter_.of(*same).value, value.value)) return value.value;
      // A copy under another name.
      const std::string whole = values_.whole(material);
      const auto is_copy = [&](const NamedMaterial& one) { return starter_.whole(one) == whole; };
      return std::ranges::any_of(known, is_copy) ? value.value : std::string();
    });
  }
  DecisiveValue height() const {
    return in_state(values_.of_height(), nullptr, [&] { return starter_.of_height().value; });
  }

 private:
  template <class StarterValue>
  DecisiveValue in_state(DecisiveValue value, const TypeOrigin* origin,
                         const StarterValue& starter_value) const {
    value.state = state_of(value, origin, starter_value);
    return value;
  }

  template <class StarterValue>
  ValueState state_of(const DecisiveValue& value, const TypeOrigin* origin,
                      const StarterValue& starter_value) const {
    std::optional<ValueState> marked;
    for (const DecisiveValue& mark : store_.marks)
      if (mark.is(value) && same_value(mark.value, value.value))
        marked = std::max(mark.state, marked.value_or(mark.state));
    if (marked) return *marked;
    const auto is_known = [](ValueSource source) {
      return source == ValueSource::datasheet || source == ValueSource::measured;
    };
    // A source does not speak for defaults.
    if (origin != nullptr && origin->source && std::ranges::count(origin->sourced, value.kind) > 0)
      return is_known(*origin->source) ? ValueState::given : ValueState::assumed;
    if (store_.source && !is_known(*store_.source)) return ValueState::assumed;
    const std::string usual = starter_value();
    return !usual.empty() && same_value(usual, value.value) ? ValueState::assumed : ValueState::given;
  }

  const Store& store_;
  ValuesOf values_, starter_;
};

// For each type, whether a device has it.
template <class Devices>
std::vector<bool> used_types(const Devices& devices, std::size_t count) {
  std::vector<bool> used(count, false);
  for (const auto& device : devices)
    if (device.type.value < count) used[device.type.value] = true;
  return used;
}

}  // namespace

std::vector<DecisiveValue> decisive_values(const Store& store, const Scene& scene) {
  constexpr double main_share = 0.05;
  const ValueStates states(store);
  std::vector<DecisiveValue> values;
  const std::vector<bool> labels = used_types(scene.labels, scene.label_types.size());
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (!labels[k]) continue;
    values.push_back(states.threshold(scene.label_types[k]));
    values.push_back(states.responsivity(scene.label_types[k]));
  }
  const std::vector<bool> units = used_types(scene.transceivers, scene.transceiver_types.size());
  // As for the sums of prices (has_prices).
  const bool has_prices = !scene.currency.empty() ||
                          std::ranges::any_of(scene.transceiver_types, [](const TransceiverType& type) {
                            return type.has_cost && type.cost != 1;
                          });
  for (std::size_t k = 0; k < units.size(); ++k) {
    if (!units[k]) continue;
    const TransceiverType& type = scene.transceiver_types[k];
    values.push_back(states.power(type));
    if (type.has_cost && has_prices) values.push_back(states.price(type));
  }
  if (store.room) values.push_back(states.height());
  const std::vector<double>& areas = scene.areas;
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  for (const auto k : ordered_by<std::uint32_t>(areas.size(), [&](std::uint32_t m) { return -areas[m]; }))
    if (areas[k] >= main_share * whole && given_reflectance(scene.materials[k].material))
      values.push_back(states.reflectance(scene.materials[k]));
  std::ranges::stable_sort(values, {}, &DecisiveValue::kind);
  return values;
}

}  // namespace shelfbeam
