#include <cstdlib>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/material/material_fields.hpp"
#include "shelfbeam/scene/fixture/fixture.hpp"
#include "shelfbeam/scene/planogram/article_labels.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/drawing.hpp"

#include "support/testing.hpp"
#include "unit/scene/fields/schema_fields.hpp"
#include "unit/scene/fields/table_fields.hpp"

// The schema and the tables of the documentation are written from the descriptions of the stored values.
// SHELFBEAM_UPDATE_SNAPSHOTS=1 writes both files anew.

namespace shelfbeam::test {
namespace {

using Json = nlohmann::ordered_json;

const std::string schema_file = SHELFBEAM_SOURCE_DIR "/data/store.schema.json";
const std::string pages = SHELFBEAM_SOURCE_DIR "/docs/formats/store/";

void expect_file(const std::string& file, const std::string& text) {
  if (std::getenv("SHELFBEAM_UPDATE_SNAPSHOTS") != nullptr) write_file(file, text);
  EXPECT_EQ(text, read_file(file)) << "SHELFBEAM_UPDATE_SNAPSHOTS=1 writes the new text";
}

template <class Described>
Fields::Part fields_of(const Described& value) {
  return [value](Fields& fields) {
    Described empty = value;
    if constexpr (requires { empty.fields(fields); })
      empty.fields(fields);
    else
      describe(empty, fields);
  };
}

// With the keys of all fixtures.
Json fixture_schema(const Fixture& type) {
  Json schema = schema_of(fields_of(type));
  const auto complete = [&](Json& form) {
    Json properties{{"type", {{"const", type_name(type)}}}, {"id", {{"$ref", "#/$defs/name"}}}};
    properties.update(form["properties"]);
    properties["repeat"] = {{"$ref", "#/$defs/repeat"}};
    form["properties"] = properties;
    Json required{"type", "id"};
    for (const Json& key : form["required"]) required.push_back(key);
    form["required"] = required;
  };
  if (schema.contains("oneOf") && !schema.contains("properties"))
    for (Json& form : schema["oneOf"]) complete(form);
  else
    complete(schema);
  Json described{{"description", description(type)}};
  described.update(schema);
  return described;
}

// Every object of the store may have the key "ignore".
void add_ignore(Json& schema) {
  if (schema.is_object() && schema.contains("properties") && schema.contains("additionalProperties") &&
      schema["additionalProperties"] == false)
    schema["properties"]["ignore"] = {{"$ref", "#/$defs/ignore"}};
  if (!schema.is_structured()) return;
  for (Json& part : schema) add_ignore(part);
}

TEST(Description, SchemaIsUpToDate) {
  Json schema = Json::parse(read_file(schema_file));
  Json types = Json::array(), alternatives = Json::array();
  for (const Fixture& type : fixture_types()) {
    const std::string name(type_name(type));
    types.push_back(name);
    alternatives.push_back({{"$ref", "#/$defs/" + name}});
    schema["$defs"][name] = fixture_schema(type);
  }
  const auto set = [&](const char* name, auto value) { schema["$defs"][name] = schema_of(fields_of(value)); };
  Json room{{"description",
             "Walls, floor and ceiling: a box from the origin ('size'), or any outline with a height. "
             "Optional if a "
             "mesh provides them."}};
  room.update(schema_of(fields_of(Room{})));
  for (Json& form : room["oneOf"])
    for (const char* list : {"zones", "inner_walls", "openings"}) {
      schema["$defs"][list] = form["properties"][list];
      form["properties"][list] = {{"$ref", std::string("#/$defs/") + list}};
    }
  schema["$defs"]["room"] = room;
  // The rules that tie keys together are written by hand.
  Json& material = schema["$defs"]["material"];
  material["properties"]["type"]["enum"] = Json::array();
  for (std::size_t k = 0; k < material_types().size(); ++k) {
    Json form = schema_of(fields_of(NamedMaterial{"", material_types()[k], {}}));
    material["properties"]["type"]["enum"].push_back(type_name(material_types()[k]));
    Json& written = material["oneOf"][k];
    for (const char* rule : {"allOf", "if", "else", "dependentRequired"})
      if (written.contains(rule)) form[rule] = written[rule];
    written = form;
  }
  set("label_type", LabelType{});
  set("transceiver_type", TransceiverType{});
  for (const auto& [type, key] : {std::pair{"label_type", "threshold"}, {"transceiver_type", "emission"}}) {
    Json& form = schema["$defs"][type];
    form["anyOf"] = {{{"required", form["required"]}}, {{"required", {"product"}}}};
    EXPECT_EQ(form["required"], Json::array({key}));
    form.erase("required");
  }
  set("planogram", ArticleLabels{});
  set("label", Label{});
  set("transceiver", Transceiver{});
  set("grid", TransceiverGrid{});
  set("mount_area", MountArea{});
  set("mount_rail", MountRail{});
  set("mount_faces", MountFaces{});
  set("keep_out", KeepOut{});
  set("measuring_plane", MeasuringPlane{});
  set("variation", StoreVariation{});
  set("drawing", Drawing{});
  schema["$defs"]["csv_file"]["properties"]["encoding"]["enum"] = all_names<Encoding>();
  schema["$defs"]["ignore"]["items"] = {{"enum", warning_names()}};
  schema["$defs"]["fixture_key"] = {{"enum", all_fixture_keys()}};
  schema["$defs"]["whole_fixture"] = {
      {"required", {"type", "id"}}, {"properties", {{"type", {{"enum", types}}}}}, {"oneOf", alternatives}};
  add_ignore(schema);
  expect_file(schema_file, compact(schema) + "\n");
}

// Replaces the rows of the first table below a heading.
void replace_table(std::string& page, const std::string& heading, const Fields::Part& part) {
  TableFields table;
  part(table);
  const std::size_t section = page.find(heading + "\n");
  ASSERT_NE(section, std::string::npos) << heading;
  const std::string line = "| --- | --- | --- | --- |\n";
  const std::size_t begin = page.find(line, section) + line.size();
  ASSERT_GT(begin, line.size());
  ASSERT_LT(begin, page.find("\n#", section + 1)) << "the section " << heading << " has no table";
  page.replace(begin, page.find("\n\n", begin) + 1 - begin, table.rows);
}

TEST(Description, TablesAreUpToDate) {
  struct Table {
    std::string page, heading;
    Fields::Part part;
  };
  std::vector<Table> tables{
      {"room", "# Room", fields_of(Room{})},
      {"room", "## Ceilings", [](Fields& fields) { Room{}.zone_fields(fields, 0); }},
      {"room", "## Inner walls", [](Fields& fields) { Room{}.inner_wall_fields(fields, 0); }},
      {"room", "### Openings",
       [](Fields& fields) {
         Room with_wall;
         with_wall.shape.inner_walls.emplace_back();
         with_wall.inner_walls.emplace_back();
         with_wall.opening_fields(fields, 0, 0);
       }},
      {"room", "## Openings in outer walls", [](Fields& fields) { Room{}.outer_opening_fields(fields, 0); }},
      {"room", "### Rows with piers",
       [](Fields& fields) {
         OpeningRow row;
         describe_repeat(row, fields);
       }},
      {"label_types", "# Label types", fields_of(LabelType{})},
      {"transceiver_types", "# Transceiver types", fields_of(TransceiverType{})},
      {"labels", "## Labels of a fixture", [](Fields& fields) { FixtureLabels{}.fields(fields, true); }},
      {"labels", "## Labels of articles", fields_of(ArticleLabels{})},
      {"labels", "### Mounting of labels of articles", fields_of(StyledFixtures{})},
      {"labels", "### Files of planogram programs", fields_of(SegmentPlace{})},
      {"labels", "## Other labels", fields_of(Label{})},
      {"labels", "## Measuring planes", fields_of(MeasuringPlane{})},
      {"transceivers", "## Grids", fields_of(TransceiverGrid{})},
      {"transceivers", "## Areas", fields_of(MountArea{})},
      {"transceivers", "## Rails", fields_of(MountRail{})},
      {"transceivers", "## Fixtures and walls", fields_of(MountFaces{})},
      {"transceivers", "## List", fields_of(Transceiver{})},
      {"transceivers", "## Areas without candidates", fields_of(KeepOut{})},
      {"variation", "# Variation: a changing shop", fields_of(StoreVariation{})},
      {"drawing", "# Drawing", fields_of(Drawing{})},
      {"drawing", "## Lines of known length", fields_of(ScaleLine{})}};
  for (const Fixture& type : fixture_types()) {
    std::string name(type_name(type));
    name.front() = static_cast<char>(name.front() - 'a' + 'A');
    tables.push_back({"fixtures", "## " + name, fields_of(type)});
  }
  for (const Material& type : material_types())
    tables.push_back(
        {"materials", fmt::format("### `{}`", type_name(type)), fields_of(NamedMaterial{"", type, {}})});
  std::map<std::string, std::string> texts;
  for (const auto& [page, heading, part] : tables) {
    const std::string file = pages + page + ".md";
    const auto [text, is_new] = texts.try_emplace(file);
    if (is_new) text->second = read_file(file);
    replace_table(text->second, heading, part);
  }
  for (const auto& [file, text] : texts) expect_file(file, text);
}

}  // namespace
}  // namespace shelfbeam::test
