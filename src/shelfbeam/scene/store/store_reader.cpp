#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/material/material_json.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

void read_materials(const JsonCursor& section, Store& store) {
  for (const auto& [name, json] : section.members()) {
    const Material material =
        make_or_fail(json, [&, &object = json] { return read_material(object, store.wavelength_nm); });
    store.materials.push_back({new_name(name, store.materials, json), material,
                               read_reflectance_range(json, material, store.wavelength_nm)});
  }
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
      const JsonCursor file = JsonCursor::parse_file(folder.find(name));
      const auto units = file.find("units");
      files.push_back(file.with_unit(units ? units->choice<LengthUnit>() : LengthUnit::m));
      files.back().expect_keys(
          {"$schema", "units", "presets", "materials", "label_types", "transceiver_types"});
    }
  }
  return files;
}

// The section of every catalogue and of the store file, which may omit it if a catalogue has it.
template <class Read>
void each_section(const std::vector<JsonCursor>& catalogues, const JsonCursor& root, const char* key,
                  Read read) {
  bool is_found = false;
  for (const JsonCursor& file : catalogues)
    if (const auto section = file.find(key)) {
      read(*section);
      is_found = true;
    }
  if (const auto section = root.find(key))
    read(*section);
  else if (!is_found)
    static_cast<void>(root[key]);  // throws
}

}  // namespace

Store parse_store(const std::string& text, const std::string& name, const std::filesystem::path& path,
                  const StoreLimits& trust) {
  const JsonCursor file = JsonCursor::parse(text, name);
  const auto units = file.find("units");
  const JsonCursor root = file.with_unit(units ? units->choice<LengthUnit>() : LengthUnit::m);
  if (const auto format = root.find("format"))
    expect_format_version(root.where(), format->integer(0, max_versions), store_format_version);
  root.expect_keys({"$schema", "format", "units", "currency", "name", "wavelength_nm", "catalogues",
                    "presets", "room", "materials", "label_types", "transceiver_types", "fixtures", "labels",
                    "planogram", "transceivers", "variation"});
  const StoreFolder folder(path, trust);
  Store store;
  store.file = name;
  store.unit = root.unit();
  store.memory = folder.memory();
  store.cancel = folder.cancel();
  if (const auto schema = root.find("$schema")) schema->text();
  if (const auto title = root.find("name")) {
    store.name = title->text();
    expect_printable(store.name, title->where());
  }
  if (const auto wavelength = root.find("wavelength_nm")) store.wavelength_nm = wavelength->number(100, 1e5);
  if (const auto currency = root.find("currency")) store.currency = read_currency(*currency);
  const std::vector<JsonCursor> catalogues = read_catalogues(root, folder);
  Presets presets;
  for (const JsonCursor& catalogue : catalogues)
    if (const auto section = catalogue.find("presets")) presets.add(*section);
  if (const auto section = root.find("presets")) presets.add(*section);
  presets.check();
  each_section(catalogues, root, "materials",
               [&](const JsonCursor& section) { read_materials(section, store); });
  each_section(catalogues, root, "transceiver_types",
               [&](const JsonCursor& section) { read_transceiver_types(section, folder, store); });
  each_section(catalogues, root, "label_types",
               [&](const JsonCursor& section) { read_label_types(section, store); });

  const StoreNames names(store);
  if (const auto room = root.find("room")) store.room = read_room(*room, names);
  Problems problems(name);
  if (const auto fixtures = root.find("fixtures"))
    read_fixtures(*fixtures, names, folder, presets, store, problems);
  problems.throw_first();
  if (const auto labels = root.find("labels")) read_labels(*labels, names, folder, store);
  if (const auto planogram = root.find("planogram")) read_planogram(*planogram, names, folder, store);
  read_transceivers(root["transceivers"], names, folder, store);
  if (const auto variation = root.find("variation"))
    store.variation = read_variation(*variation, names, store);
  return store;
}

Store read_store(const std::filesystem::path& path, const StoreLimits& trust) {
  return parse_store(read_file(path), path.string(), path.parent_path(), trust);
}

}  // namespace shelfbeam
