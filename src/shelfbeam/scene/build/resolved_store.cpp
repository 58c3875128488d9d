#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"
#include "shelfbeam/scene/store/value_marks.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

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

// A key of "transceivers". The choice of units is the last one.
std::string key_of(std::string_view name) {
  return fmt::format(",\n  \"{}\": ", name);
}
constexpr auto end_of_store = "\n }\n}\n";

}  // namespace

std::string hash_of_resolved(std::string_view text) {
  // Lines and sections of the store, lines of its types, and a line of a label. Elsewhere, these levels of
  // nesting have no keys of these names. Types come before fixtures, and these before labels.
  constexpr std::string_view description = "\n   \"description\": ", fixtures = "\n \"fixtures\": ";
  constexpr std::string_view of_head[] = {
      "\n \"language\": ",       "\n \"source\": ",   "\n   \"name\": ",    "\n   \"source\": ",
      "\n   \"order_number\": ", "\n   \"fixing\": ", "\n   \"picture\": ", "\n   \"price\": "};
  constexpr std::string_view sections[] = {"\n \"confirmed\": ", "\n \"assumed\": "}, end = "\n },";
  std::string kept;
  std::size_t begin = 0;
  // Up to the end of the line that begins behind `from`.
  const auto leave_out = [&](std::size_t at, std::size_t from) {
    kept.append(text.substr(begin, at - begin));
    begin = std::min(text.find('\n', std::min(from, text.size()) + 1), text.size());
  };
  const std::size_t head = std::min(text.find(fixtures), text.size());
  for (std::size_t at = text.find('\n'); at < head; at = text.find('\n', at + 1)) {
    const auto starts = [line = text.substr(at)](std::string_view key) { return line.starts_with(key); };
    if (std::ranges::any_of(of_head, starts)) leave_out(at, at);
    if (std::ranges::any_of(sections, starts)) {
      leave_out(at, text.find(end, at));
      at = begin - 1;
    }
  }
  for (std::size_t at; (at = text.find(description, std::max(begin, head))) != std::string_view::npos;)
    leave_out(at, at);
  const std::size_t choice = text.rfind(key_of("selected"));
  if (begin == 0 && choice == std::string_view::npos) return content_hash(text);
  kept.append(text.substr(begin, choice - begin));  // all if there is none
  if (choice != std::string_view::npos) kept.append(end_of_store);
  return content_hash(kept);
}

std::string resolved_store_json(const Store& store, const Scene& scene) {
  const StoreLists lists{store.materials, store.label_types, store.transceiver_types};
  Json json;
  json["format"] = store_format_version;
  json["name"] = store.name;
  if (store.language != Language::english) json["language"] = to_text(store.language);
  if (store.source) json["source"] = to_text(*store.source);
  for (const ValueState state : {ValueState::confirmed, ValueState::assumed})
    if (Json section = marks_section(scene.values, state); !section.is_null())
      json[to_text(state)] = std::move(section);
  json["wavelength_nm"] = store.wavelength_nm;
  if (!scene.currency.empty()) json["currency"] = scene.currency;
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
  std::vector<Transceiver> all = scene.transceivers;
  all.insert(all.end(), scene.excluded.begin(), scene.excluded.end());
  append_list(text, 2, all, store.cancel, [&](const Transceiver& unit) { return resolved(unit, lists); });
  const auto append_ids = [&](std::string_view key, const std::vector<std::string>& ids) {
    text += key_of(key);
    append_list(text, 2, ids, store.cancel, [](const std::string& id) { return Json(id); });
  };
  const auto ids_of = [](const std::vector<Transceiver>& units, const auto& is_listed) {
    std::vector<std::string> ids;
    for (const Transceiver& unit : units)
      if (is_listed(unit)) ids.push_back(unit.id);
    return ids;
  };
  append_ids("installed", ids_of(scene.transceivers, [](const Transceiver& unit) { return unit.installed; }));
  const auto pinned = ids_of(scene.transceivers, [](const Transceiver& unit) { return unit.pinned; });
  if (!pinned.empty()) append_ids("pinned", pinned);
  if (!scene.excluded.empty())
    append_ids("excluded", ids_of(scene.excluded, [](const auto&) { return true; }));
  const auto selected = ids_of(scene.transceivers, [](const Transceiver& unit) { return unit.selected; });
  if (!selected.empty()) append_ids("selected", selected);
  return text.append(end_of_store);
}

}  // namespace shelfbeam
