#include "shelfbeam/base/file.hpp"

#include "support/testing.hpp"
#include "unit/scene/mesh_files.hpp"
#include "unit/scene/stores.hpp"

// Faults, each in a store that is valid without it, are rows of the tables in test/data/refused: the place of
// a change, a value, and parts of the message. Several changes are an object of their places and values.

namespace shelfbeam::test {
namespace {

Json base_store(const std::string& name) {
  if (name == "L-shaped room") return store_of_room(l_shaped_room("tile", "door"));
  if (name == "long room") return store_with(Json::array());
  if (name == "room with a zone") return zoned_store(Json::object());
  if (name == "new shop") return new_shop();
  if (name == "changing shop") return changing_shop();
  if (name == "sample in mm") return sample_in_mm();
  return name == "sample" ? sample_store() : mesh_store(name);
}

struct Project {
  Json store, files;

  // The value is merged with the one at the place: a pointer into the store, or one behind the name of a JSON
  // file. At the name alone, it is the new text of the file, or, behind a "+", more text.
  void change(const std::string& place, const Json& value) {
    const std::size_t end = std::min(place.find('/'), place.size());
    const Json::json_pointer pointer(place.substr(end));
    if (end == 0) {
      store[pointer].merge_patch(value);
    } else if (Json& file = files[place.substr(0, end)]; end < place.size()) {
      file[pointer].merge_patch(value);
    } else {
      const std::string text = value.get<std::string>();
      file = text.starts_with('+') ? file.get<std::string>() + text.substr(1) : text;
    }
  }
  Project changed(const Json& row) const {
    Project copy = *this;
    if (row[0].is_object())
      for (const auto& [place, value] : row[0].items()) copy.change(place, value);
    else
      copy.change(row[0].get<std::string>(), row[1]);
    return copy;
  }
  void read() const {
    const TempFolder folder;
    for (const auto& [name, file] : files.items())
      folder.write(name, file.is_string() ? file.get<std::string>() : file.dump());
    scene_of(store, folder.path());
  }
};

class Refused : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tables, Refused,
                         testing::Values("fixtures", "labels", "meshes", "room", "transceivers"),
                         [](const auto& table) { return std::string(table.param); });

TEST_P(Refused, NamesThePlaceOfTheFault) {
  const Json tables =
      Json::parse(read_file(fmt::format("{}/test/data/refused/{}.jsonc", SHELFBEAM_SOURCE_DIR, GetParam())),
                  nullptr, true, true);
  for (const auto& [name, table] : tables.items()) {
    SCOPED_TRACE(name);
    Project valid{base_store(table["base"]), table.value("files", Json::object())};
    valid.change("", table.value("store", Json::object()));
    EXPECT_NO_THROW(valid.read());
    for (const Json& row : table.value("accepted", Json::array()))
      EXPECT_NO_THROW(valid.changed(row).read()) << row;
    for (const Json& row : table["refused"]) {
      const std::string message = input_error([&] { valid.changed(row).read(); });
      for (std::size_t part = row[0].is_object() ? 1 : 2; part < row.size(); ++part)
        EXPECT_NE(message.find(row[part].get<std::string>()), std::string::npos) << row << '\n' << message;
    }
  }
}

}  // namespace
}  // namespace shelfbeam::test
