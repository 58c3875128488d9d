#include "serve/live/shop.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <iterator>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/viewer/page_data.hpp"
#include "shelfbeam/report/viewer/page_scene.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/fixture/fixture.hpp"

#include "serve/live/dissolve.hpp"
#include "serve/live/named_files.hpp"
#include "serve/live/place.hpp"
#include "serve/live/vanished.hpp"

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

// The server's own limits: other work has a process of its own.
constexpr std::size_t max_memory = std::size_t{1} << 28;
constexpr std::uint64_t max_file = 100'000'000;
constexpr std::size_t max_fixtures = 15'000, max_parts = 20'000;

struct Resolved {
  Draft draft;
  std::vector<Part> parts;
};

Resolved unresolved(const std::string& name, const std::string& sentence) {
  Resolved shop;
  shop.draft.store.file = name;
  shop.draft.problems = {{FindingCode::invalid, "", {}, sentence}};
  return shop;
}

// No exception leaves the pages with another text than the project.
// `before`: the parts of the document before, which are shown of elements that have problems now.
Resolved resolve(const JsonCursor& document, const std::filesystem::path& folder, const StoreLimits& limits,
                 const std::vector<Part>& before, const Json& json_before) {
  const std::string& name = document.file();
  try {
    Resolved shop{read_draft(document, folder, SceneDetail::outlines, limits), {}};
    shop.parts = parts_of(shop.draft, document.value());
    if (shop.parts.size() <= max_parts) {
      auto vanished = vanished_parts(shop.parts, before, json_before, shop.draft, document.value());
      std::ranges::move(vanished, std::back_inserter(shop.parts));
      return shop;
    }
    return unresolved(name, fmt::format("{}: has {} parts with outlines; the planner shows at most {}", name,
                                        grouped(shop.parts.size()), grouped(max_parts)));
  } catch (const InputError& error) {
    return unresolved(name, error.what());
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    return unresolved(name, fmt::format("{}: cannot be shown ({})", name, printable(error.what())));
  }
}

// Keys of a store on which no light of its units depends.
constexpr auto without_light =
    std::to_array<std::string_view>({"name", "language", "currency", "source", "confirmed", "assumed",
                                     "drawing", "variation", "ignore", "transceivers"});

bool changes_light(const Json& before, const Json& after) {
  const auto has_other = [](const Json& one, const Json& other) {
    for (const auto& [key, value] : one.items())
      if (std::ranges::find(without_light, key) == without_light.end())
        if (const auto found = other.find(key); found == other.end() || *found != value) return true;
    return false;
  };
  return has_other(before, after) || has_other(after, before);
}

// The types of a draft may be missing.
template <class Device, class Type>
Json device_json(const Device& device, const std::vector<Type>& types, const std::string& where,
                 const std::string& file) {
  const std::string type = device.type.value < types.size() ? types[device.type.value].name : "";
  const std::string entry = entry_of(where, file);
  const Vec3& p = device.position;
  return {{"id", device.id},
          {"type", type},
          {"position", {p.x, p.y, p.z}},
          {"path", entry.empty() ? Json() : Json(entry)},
          {"source", where}};
}

Json units_json(const FixtureKeys& keys) {
  Json units = Json::object();
  for (const auto& [key, unit] : keys.units) units[key] = to_text(unit);
  return units;
}

}  // namespace

Shop::Shop(std::filesystem::path file, const CancelToken* cancel)
    : file_(std::move(file)),
      cancel_(cancel),
      cache_(make_read_cache()),
      document_(JsonCursor::parse("{}", file_.filename().string())) {}

StoreLimits Shop::limits() const {
  return {.memory = max_memory,
          .file_size = max_file,
          .cancel = cancel_,
          .cache = cache_.get(),
          .allow_links = false,
          .fixtures = max_fixtures,
          .outside_remedy = "move it there"};
}

ShopChanges Shop::update(const std::string& text, std::uint64_t revision) {
  JsonCursor document = JsonCursor::parse(text, document_.file());
  // Before they are read, so that later changes are seen.
  std::string files = state_of_named_files(document.value(), file_.parent_path());
  auto [draft, parts] = resolve(document, file_.parent_path(), limits(), parts_, json());
  DeviceArrays labels = labels_of(draft), units = units_of(draft);

  ShopChanges changes;
  Json set = Json::array(), remove = Json::array();
  std::map<std::string_view, const Json*> before;
  for (const Part& part : parts_) before.emplace(part.key, &part.json);
  for (const Part& part : parts) {
    const auto found = before.find(part.key);
    if (found == before.end() || *found->second != part.json) set.push_back(part.json);
    if (found != before.end()) before.erase(found);
  }
  for (const auto& [key, part] : before) remove.push_back(key);
  changes.parts = {{"set", std::move(set)}, {"remove", std::move(remove)}};
  changes.labels = devices_frame("labels", revision, labels_, labels);
  changes.units = devices_frame("units", revision, units_, units);

  // Another program may have changed a file that the store names.
  changes.changes_light = changes_light(json(), document.value()) || files_ != files;
  files_ = std::move(files);
  document_ = std::move(document);
  draft_ = std::move(draft);
  parts_ = std::move(parts);
  labels_ = std::move(labels);
  units_ = std::move(units);
  return changes;
}

Json Shop::parts() const {
  Json all = Json::array();
  for (const Part& part : parts_) all.push_back(part.json);
  return all;
}

Json Shop::problems() const {
  Json all = Json::array();
  for (const Finding& finding : draft_.problems) {
    all.push_back({{"code", name_of(finding.code)}, {"path", finding.path}, {"sentence", finding.sentence}});
    locate(all.back());
  }
  return all;
}

void Shop::locate(Json& finding) const {
  const auto path = finding["path"].get<std::string>();
  const std::string pointer = pointer_of(path, json());
  finding["pointer"] = pointer;
  if (path.find(" (copy ") == std::string::npos || pointer.empty()) return;
  const std::string copies = pointer.substr(1) + "#";
  for (const Part& part : parts_)
    if (part.key.starts_with(copies) && path.ends_with(copy_note(part.json["id"].get<std::string>())))
      finding["key"] = part.key;
}

Json Shop::names() const {
  const auto names = [](const auto& list) {
    Json all = Json::array();
    for (const auto& one : list) all.push_back(one.name);
    return all;
  };
  const Store& store = draft_.store;
  return {{"presets", store.presets},
          {"materials", names(store.materials)},
          {"label_types", names(store.label_types)},
          {"transceiver_types", names(store.transceiver_types)}};
}

std::string Shop::labels(std::uint64_t revision) const {
  return devices_frame("labels", revision, {}, labels_).value_or("");
}

std::string Shop::units(std::uint64_t revision) const {
  return devices_frame("units", revision, {}, units_).value_or("");
}

CompletedFixture Shop::completed(const std::string& pointer) const {
  constexpr std::string_view list = "/fixtures/";
  const std::string number = pointer.starts_with(list) ? pointer.substr(list.size()) : "";
  const auto index = to_whole_number(number, std::numeric_limits<std::uint32_t>::max());
  if (!index) throw InputError(pointer, "is no fixture", "choose an element of 'fixtures'");
  return completed_fixture(document_, file_.parent_path(), *index, limits());
}

std::vector<EditOp> Shop::dissolved(const std::string& pointer) const {
  const FixtureKeys whole = completed(pointer).whole;
  return serve::dissolved(pointer, json().at(Json::json_pointer(pointer)), whole, draft_);
}

Json Shop::details(const std::string& pointer) const {
  const auto [whole, inherited] = completed(pointer);
  Json details{{"effective", whole.json},
               {"units", units_json(whole)},
               {"inherited", inherited.json},
               {"inherited_units", units_json(inherited)},
               {"resolved", nullptr}};
  const StoreLists lists{draft_.store.materials, draft_.store.label_types, draft_.store.transceiver_types};
  for (const auto& [fixture, where] : draft_.store.fixtures)
    if (entry_of(where, draft_.store.file) == pointer) {
      details["resolved"] = resolved(fixture, lists);
      break;
    }
  return details;
}

Json Shop::presets() const {
  Json presets = Json::object();
  for (const auto& [name, keys] : completed_presets(document_, file_.parent_path(), limits()))
    presets[name] = {{"effective", keys.json}, {"units", units_json(keys)}};
  return presets;
}

Json Shop::label(std::size_t index) const {
  const Label& label = draft_.scene.labels[index];
  Json json = device_json(label, draft_.scene.label_types, draft_.sources.labels[index], draft_.store.file);
  json["normal"] = {label.normal.x, label.normal.y, label.normal.z};
  json["description"] = label.description;
  const LabelPlace& place = label.place;
  if (place.is_known())
    json["place"] = {{"fixture", place.fixture.empty() ? Json() : Json(place.fixture)},
                     {"wall", place.wall ? Json(*place.wall) : Json()},
                     {"face", place.face ? Json(to_text(*place.face)) : Json()},
                     {"on_top", place.on_top},
                     {"board", place.board},
                     {"along", place.along}};
  return json;
}

Json Shop::unit(std::size_t index) const {
  const auto& [scene, sources] = std::tie(draft_.scene, draft_.sources);
  const std::size_t candidates = scene.transceivers.size();
  const Transceiver& unit = unit_at(index);
  return device_json(unit, scene.transceiver_types,
                     index < candidates ? sources.transceivers[index] : sources.excluded[index - candidates],
                     draft_.store.file);
}

const Transceiver& Shop::unit_at(std::size_t index) const {
  const std::size_t candidates = draft_.scene.transceivers.size();
  return index < candidates ? draft_.scene.transceivers[index] : draft_.scene.excluded[index - candidates];
}

Json Shop::find(const std::string& text) const {
  constexpr std::size_t most = 50;
  const std::string wanted = lower_case(text);
  Json hits = Json::array();
  const auto contains = [&](const std::string& name) {
    return lower_case(name).find(wanted) != std::string::npos;
  };
  const auto fits = [&](const std::string& id) { return hits.size() < most && contains(id); };
  for (const Part& part : parts_) {
    const auto id = part.json["id"].get<std::string>();
    if (id.empty() || !fits(id)) continue;
    hits.push_back({{"kind", part.json["kind"]},
                    {"id", id},
                    {"path", part.json["path"]},
                    {"key", part.key},
                    {"at", part.json["outline"][0]}});
  }
  const auto hit_of = [](const char* kind, const auto& device, std::size_t k) -> Json {
    return {{"kind", kind}, {"id", device.id}, {"index", k}, {"at", {device.position.x, device.position.y}}};
  };
  for (std::size_t k = 0; k < label_count() && hits.size() < most; ++k) {
    const Label& label = draft_.scene.labels[k];
    if (!contains(label.id) && !contains(label.description)) continue;
    hits.push_back(hit_of("label", label, k));
    if (!label.description.empty()) hits.back()["description"] = label.description;
  }
  for (std::size_t k = 0; k < unit_count() && hits.size() < most; ++k)
    if (fits(unit_at(k).id)) hits.push_back(hit_of("unit", unit_at(k), k));
  return hits;
}

std::string Shop::scene(std::uint64_t revision) const {
  const Draft whole = read_draft(document_, file_.parent_path(), SceneDetail::surfaces, limits());
  PageData page;
  Json about = add_scene(page, whole.scene, false);
  about["revision"] = revision;
  return page.binary(about.dump());
}

}  // namespace shelfbeam::serve
