#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/material/material_fields.hpp"
#include "shelfbeam/scene/mesh/read_cache.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/completed_fixture.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"
#include "shelfbeam/scene/store/value_marks.hpp"

namespace shelfbeam {

namespace {

void read_materials(const JsonCursor& section, ReadCache* cache, Store& store, Problems& problems) {
  const StoreNames names(store, &problems);
  read_named(section, store.materials, problems, [&](const JsonCursor& json, NamedMaterial& named) {
    problems.collect([&] {
      NamedMaterial given{named.name, material_of_type(json["type"]), {}};
      const auto part = [&](Fields& f) { describe(given, f, store.wavelength_nm); };
      const auto rules = [&](FieldReader& reader) {
        check(given.material, json, {store.wavelength_nm, given.reflectance_range}, reader);
      };
      if (!read_object(json, names, problems, part, rules)) return;
      const auto make = [&] { return make_or_fail(json, [&] { return prepared(given.material); }); };
      named.material =
          cache == nullptr
              ? make()
              : cache->material(fmt::format("{} {}", store.wavelength_nm, json.value().dump()), make);
      named.reflectance_range = given.reflectance_range;
    });
  });
}

// The lengths of a file are in the unit that it names.
JsonCursor in_its_unit(const JsonCursor& file) {
  const auto units = file.find("units");
  return file.with_unit(units ? units->choice<LengthUnit>() : LengthUnit::m);
}

// Files with parts that several stores share.
std::vector<JsonCursor> read_catalogues(const JsonCursor& root, const StoreFolder& folder) {
  std::vector<JsonCursor> files;
  constexpr std::size_t max_files = 100;
  if (const auto names = root.find("catalogues")) {
    if (names->size() > max_files)
      names->fail(fmt::format("has {} files", names->size()),
                  fmt::format("at most {} are allowed", max_files));
    for (const JsonCursor& name : names->elements()) {
      const InputFile file = folder.find(name);
      files.push_back(
          in_its_unit(JsonCursor::parse(file.read(), file.name(), folder.memory() / names->size())));
      expect_catalogue(files.back());
    }
  }
  return files;
}

bool has_ignored(const nlohmann::ordered_json& json) {
  if (!json.is_structured()) return false;
  return (json.is_object() && json.contains("ignore")) || std::any_of(json.begin(), json.end(), has_ignored);
}

// The keys "ignore", which the reader then need not know: a list of codes of warnings.
void take_ignored(nlohmann::ordered_json& json, const std::string& path, const JsonCursor& root, Store& store,
                  Problems& problems) {
  if (json.is_object())
    if (const auto found = json.find("ignore"); found != json.end() && found->is_array()) {
      for (const auto& code : *found)
        problems.collect([&] {
          const auto warning = code.is_string() ? warning_of(code.get<std::string>()) : std::nullopt;
          if (!warning)
            throw JsonError(fmt::format("{}: {}", root.file(), path.empty() ? "ignore" : path + ".ignore"),
                            path, fmt::format("has the unknown code {}", code.dump()),
                            code.is_string() ? suggest(code.get<std::string>(), warning_names())
                                             : "give the codes of warnings, in quotes",
                            FindingCode::unknown_name, {code.dump()});
          store.ignored.emplace(path, *warning);
        });
      json.erase(found);
    }
  if (!json.is_structured()) return;
  for (auto& [key, value] : json.items())
    if (value.is_structured())
      take_ignored(value,
                   json.is_array() ? fmt::format("{}[{}]", path, key)
                                   : fmt::format("{}{}{}", path, path.empty() ? "" : ".", key),
                   root, store, problems);
}

class StoreReader {
 public:
  StoreReader(Store& store, const StoreFolder& folder, Problems& problems)
      : store_(store), folder_(folder), problems_(problems) {}

  void read(const JsonCursor& file) {
    const JsonCursor root = in_its_unit(file);
    if (const auto format = root.find("format"))
      expect_format_version(root.where(), format->integer(0, max_versions), store_format_version);
    problems_.collect([&] {
      for (const JsonError& error : root.unknown_keys(keys)) problems_.keep(error);
    });
    store_.unit = root.unit();
    read_values(root);
    read_lists(root);
    const StoreNames names(store_, &problems_);
    section(root, "room", [&](const JsonCursor& json) {
      store_.room = read_room(json, names, problems_);
      if (!store_.room) problems_.mark("room");
    });
    if (!section(root, "fixtures", [&](const JsonCursor& json) {
          read_fixtures(json, names, folder_, presets_, store_, problems_);
        })) {
      problems_.mark("fixture");
      problems_.mark("some fixture");
    }
    section(root, "labels",
            [&](const JsonCursor& json) { read_labels(json, names, folder_, store_, problems_); });
    section(root, "measuring_planes",
            [&](const JsonCursor& json) { read_measuring_planes(json, names, store_, problems_); });
    section(root, "planogram",
            [&](const JsonCursor& json) { read_planogram(json, names, folder_, store_, problems_); });
    problems_.collect([&] { read_transceivers(root["transceivers"], names, folder_, store_, problems_); });
    section(root, "variation", [&](const JsonCursor& json) {
      store_.variation = read_variation(json, names, store_, problems_);
    });
    section(root, "drawing", [&](const JsonCursor& json) { expect_drawing(json, names, problems_); });
  }

 private:
  static constexpr auto keys = std::to_array<std::string_view>(
      {"$schema",           "format",    "units",     "currency",         "name",
       "language",          "source",    "confirmed", "assumed",          "wavelength_nm",
       "catalogues",        "presets",   "room",      "materials",        "label_types",
       "transceiver_types", "fixtures",  "labels",    "measuring_planes", "planogram",
       "transceivers",      "variation", "drawing"});

  // Returns whether the section is omitted or could be read as a whole.
  template <class Read>
  bool section(const JsonCursor& root, std::string_view key, Read read) {
    return problems_.collect([&] {
      if (const auto found = root.find(key)) read(*found);
    });
  }

  void read_values(const JsonCursor& root) {
    section(root, "$schema", [](const JsonCursor& json) { json.text(); });
    section(root, "name", [&](const JsonCursor& json) {
      store_.name = json.text();
      expect_printable(store_.name, json.where());
    });
    section(root, "language", [&](const JsonCursor& json) { store_.language = json.choice<Language>(); });
    section(root, "wavelength_nm",
            [&](const JsonCursor& json) { store_.wavelength_nm = json.number(100, 1e5); });
    section(root, "currency", [&](const JsonCursor& json) { store_.currency = read_currency(json); });
    section(root, "source", [&](const JsonCursor& json) { store_.source = json.choice<ValueSource>(); });
    for (const ValueState state : {ValueState::confirmed, ValueState::assumed})
      section(root, to_text(state), [&](const JsonCursor& json) {
        std::ranges::move(read_marks(json, state, problems_), std::back_inserter(store_.marks));
      });
  }

  void read_lists(const JsonCursor& root) {
    std::vector<JsonCursor> files;
    if (!problems_.collect([&] { files = read_catalogues(root, folder_); }))
      for (const char* list : {"preset", "material", "label type", "transceiver type"}) problems_.mark(list);
    files.push_back(root);
    for (const JsonCursor& file : files)
      if (!section(file, "presets", [&](const JsonCursor& json) { presets_.add(json, problems_); }))
        problems_.mark("preset");
    presets_.check(problems_);
    store_.presets = presets_.names();
    Products units("transceiver_types"), labels("label_types");
    for (const JsonCursor& file : std::span(files).first(files.size() - 1)) {
      units.add(file);
      labels.add(file);
    }
    each_section(files, "materials", "material", [&](const JsonCursor& json, bool is_shared) {
      read_materials(json, folder_.cache(), store_, problems_);
      if (is_shared) store_.shared.materials = store_.materials.size();
    });
    each_section(files, "transceiver_types", "transceiver type", [&](const JsonCursor& json, bool is_shared) {
      read_transceiver_types(json, folder_, units, store_, problems_);
      if (is_shared) store_.shared.transceiver_types = store_.transceiver_types.size();
    });
    each_section(files, "label_types", "label type", [&](const JsonCursor& json, bool is_shared) {
      read_label_types(json, folder_, labels, store_, problems_);
      if (is_shared) store_.shared.label_types = store_.label_types.size();
    });
  }

  // The section of every catalogue and of the store file, which comes last and may omit it if a catalogue has
  // it. `read` is told which it is.
  template <class Read>
  void each_section(const std::vector<JsonCursor>& files, const char* key, const char* list, Read read) {
    const bool is_found = std::any_of(files.begin(), files.end(),
                                      [&](const JsonCursor& file) { return file.find(key).has_value(); });
    for (const JsonCursor& file : files) {
      const bool is_shared = &file != &files.back();
      if (!section(file, key, [&](const JsonCursor& json) { read(json, is_shared); })) problems_.mark(list);
    }
    if (!is_found && !problems_.collect([&] { static_cast<void>(files.back()[key]); })) problems_.mark(list);
  }

  Store& store_;
  const StoreFolder& folder_;
  Problems& problems_;
  Presets presets_;
};

template <class Parse>
Store store_of(Parse parse, const std::string& name, const StoreFolder& folder, Problems* problems) {
  Problems own(name);
  Problems& all = problems != nullptr ? *problems : own;
  Store store;
  store.file = name;
  store.memory = folder.memory();
  store.cancel = folder.cancel();
  all.collect([&] {
    JsonCursor file = parse();
    if (has_ignored(file.value())) {
      nlohmann::ordered_json json = file.value();
      take_ignored(json, "", file, store, all);
      file = file.replaced(std::move(json));
    }
    StoreReader(store, folder, all).read(file);
  });
  if (problems == nullptr) own.throw_first();
  return store;
}

}  // namespace

Store parse_store(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                  const StoreLimits& trust, Problems* problems) {
  return store_of([&] { return JsonCursor::parse(text, name); }, name, StoreFolder(folder, trust), problems);
}

Store parse_store(const JsonCursor& document, const std::filesystem::path& folder, const StoreLimits& trust,
                  Problems* problems) {
  return store_of([&] { return document; }, document.file(), StoreFolder(folder, trust), problems);
}

namespace {

// Completes fixtures and presets of a store file.
class Completer {
 public:
  Completer(const JsonCursor& document, const std::filesystem::path& folder, const StoreLimits& limits)
      : root_(in_its_unit(document)), problems_(document.file()) {
    const StoreFolder files(folder, limits);
    for (const JsonCursor& file : read_catalogues(root_, files))
      if (const auto section = file.find("presets")) presets_.add(*section, problems_);
    if (const auto section = root_.find("presets")) presets_.add(*section, problems_);
    presets_.check(problems_);
    problems_.throw_first();
  }

  const JsonCursor& root() const { return root_; }
  std::vector<std::string> names() const { return presets_.names(); }

  FixtureKeys complete(const JsonCursor& fixture) {
    presets_.take(fixture);
    const JsonCursor whole = presets_.complete(fixture);
    FixtureKeys keys{whole.value(), {}};
    for (const auto& [key, value] : whole.members())
      if (value.unit() != root_.unit()) keys.units.emplace(key, value.unit());
    return keys;
  }

 private:
  JsonCursor root_;
  Problems problems_;
  Presets presets_;  // refers to the problems
};

}  // namespace

CompletedFixture completed_fixture(const JsonCursor& document, const std::filesystem::path& folder,
                                   std::size_t index, const StoreLimits& limits) {
  Completer completer(document, folder, limits);
  const JsonCursor fixtures = completer.root()["fixtures"];
  if (index >= fixtures.size()) fixtures.fail(fmt::format("has no element {}", index));
  const JsonCursor fixture = fixtures.element(index);
  const auto preset = fixture.find("preset");
  if (!preset) return {completer.complete(fixture), {nlohmann::ordered_json::object(), {}}};
  return {completer.complete(fixture), completer.complete(fixture.replaced({{"preset", preset->value()}}))};
}

std::map<std::string, FixtureKeys> completed_presets(const JsonCursor& document,
                                                     const std::filesystem::path& folder,
                                                     const StoreLimits& limits) {
  Completer completer(document, folder, limits);
  std::map<std::string, FixtureKeys> presets;
  for (const std::string& name : completer.names())
    presets.emplace(name, completer.complete(completer.root().replaced({{"preset", name}})));
  return presets;
}

void expect_catalogue(const JsonCursor& file) {
  file.expect_keys({"$schema", "units", "presets", "materials", "label_types", "transceiver_types"});
}

Store read_store(const std::filesystem::path& path, const StoreLimits& trust, Problems* problems) {
  const StoreFolder folder(path.parent_path(), trust);
  const InputFile file =
      trust.allow_links ? InputFile(path) : folder.find(path.filename(), path.string(), "file");
  return parse_store(file.read(std::min(max_text_file, trust.file_size)), path.string(), path.parent_path(),
                     trust, problems);
}

}  // namespace shelfbeam
