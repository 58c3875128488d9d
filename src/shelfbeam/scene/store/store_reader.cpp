
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/format_version.hpp"
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
    store.materials.push_back({check_name(name, json.where()), material,
                               read_reflectance_range(json, material, store.wavelength_nm)});
  }
}

}  // namespace

Store parse_store(const std::string& text, const std::string& name, const std::filesystem::path& path,
                  const StoreLimits& trust) {
  const JsonCursor file = JsonCursor::parse(text, name);
  const auto units = file.find("units");
  const JsonCursor root = file.with_unit(units ? units->choice<LengthUnit>() : LengthUnit::m);
  if (const auto format = root.find("format"))
    expect_format_version(root.where(), format->integer(0, max_versions), store_format_version);
  root.expect_keys({"$schema", "format", "units", "currency", "name", "wavelength_nm", "room", "materials",
                    "label_types", "transceiver_types", "fixtures", "labels", "transceivers"});
  const StoreFolder folder(path, trust);
  Store store;
  store.file = name;
  store.unit = root.unit();
  store.memory = folder.memory();
  if (const auto schema = root.find("$schema")) schema->text();
  if (const auto title = root.find("name")) {
    store.name = title->text();
    expect_printable(store.name, title->where());
  }
  if (const auto wavelength = root.find("wavelength_nm")) store.wavelength_nm = wavelength->number(100, 1e5);
  if (const auto currency = root.find("currency")) store.currency = read_currency(*currency);
  read_materials(root["materials"], store);
  read_transceiver_types(root["transceiver_types"], folder, store);
  read_label_types(root["label_types"], store);

  const StoreNames names(store);
  if (const auto room = root.find("room")) store.room = read_room(*room, names);
  if (const auto fixtures = root.find("fixtures"))
    for (const JsonCursor& cursor : fixtures->elements())
      store.fixtures.push_back({read_fixture(cursor, {names, folder}), cursor.where()});
  if (const auto labels = root.find("labels")) read_labels(*labels, names, folder, store);
  read_transceivers(root["transceivers"], names, folder, store);
  return store;
}

Store read_store(const std::filesystem::path& path, const StoreLimits& trust) {
  return parse_store(read_file(path), path.string(), path.parent_path(), trust);
}

}  // namespace shelfbeam
