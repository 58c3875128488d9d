#include <cstddef>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

template <class Described>
Json resolved(Described value, const StoreLists& lists) {
  Json json;
  FieldWriter writer(json, lists);
  if constexpr (requires { value.fields(writer); })
    value.fields(writer);
  else
    describe(value, writer);
  return json;
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
  const StoreLists lists{store.materials, store.label_types, store.transceiver_types};
  Json json;
  json["format"] = store_format_version;
  json["name"] = store.name;
  json["wavelength_nm"] = store.wavelength_nm;
  if (!store.currency.empty()) json["currency"] = store.currency;
  if (store.room) json["room"] = resolved(*store.room, lists);
  for (const NamedMaterial& one : store.materials) json["materials"][one.name] = resolved(one, lists);
  for (const LabelType& type : store.label_types) json["label_types"][type.name] = resolved(type, lists);
  for (const TransceiverType& type : store.transceiver_types)
    json["transceiver_types"][type.name] = resolved(type, lists);
  if (store.variation) json["variation"] = resolved(*store.variation, lists);
  std::string text = json.dump(1);
  text.resize(text.size() - 2);  // without "\n}"
  text += ",\n \"fixtures\": ";
  append_list(text, 1, store.fixtures, store.cancel,
              [&](const auto& listed) { return resolved(listed.value, lists); });
  text += ",\n \"labels\": ";
  append_list(text, 1, scene.labels, store.cancel,
              [&](const Label& label) { return resolved(label, lists); });
  text += ",\n \"transceivers\": {\n  \"list\": ";
  append_list(text, 2, scene.transceivers, store.cancel,
              [&](const Transceiver& unit) { return resolved(unit, lists); });
  std::vector<std::string> installed;
  for (const Transceiver& unit : scene.transceivers)
    if (unit.installed) installed.push_back(unit.id);
  text += ",\n  \"installed\": ";
  append_list(text, 2, installed, store.cancel, [](const std::string& id) { return Json(id); });
  return text + "\n }\n}\n";
}

}  // namespace shelfbeam
