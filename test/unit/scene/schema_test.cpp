#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/scene/store/completed_fixture.hpp"

#include "support/process.hpp"
#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"

// The published schema and the reader must agree: on the sample with any of the changes of
// test/data/store_changes.jsonc, on the examples, and on their resolved stores.

namespace shelfbeam::test {
namespace {

const std::string photometry = SHELFBEAM_SOURCE_DIR "/data/photometry";

// A change of the sample, as for changed_store.
struct Change {
  std::string pointer, value;

  std::string text() const { return changed_store(pointer, value).dump(); }
};
std::ostream& operator<<(std::ostream& out, const Change& change) {
  return out << change.pointer << " = " << (change.value.empty() ? "(omitted)" : change.value);
}

const Json& store_changes() {
  static const Json all =
      Json::parse(read_file(SHELFBEAM_SOURCE_DIR "/test/data/store_changes.jsonc"), nullptr, true, true);
  return all;
}

std::vector<Change> changes(const std::string& verdict) {
  std::vector<Change> found;
  for (const auto& [pointer, values] : store_changes().at(verdict).items())
    for (const Json& value : values) found.push_back({pointer, value.dump()});
  for (const Json& pointer : store_changes().at(verdict + " without"))
    found.push_back({pointer.get<std::string>(), {}});
  return found;
}

std::string reader_verdict(const std::string& text) {
  try {
    make_scene(parse_store(text, "store.json", photometry));
    return "ok";
  } catch (const InputError& error) {
    return error.what();
  }
}

class Schema : public testing::Test {
 protected:
  // The verdict of the schema on each text: "ok", or "bad: " and the reason.
  std::vector<std::string> verdicts(const std::vector<std::string>& texts) {
    std::vector<std::string> command{"/usr/bin/python3",
                                     SHELFBEAM_SOURCE_DIR "/test/unit/scene/check_schema.py",
                                     SHELFBEAM_SOURCE_DIR "/data/store.schema.json"};
    for (std::size_t i = 0; i < texts.size(); ++i)
      command.push_back(folder.write(std::to_string(i) + ".json", texts[i]).string());
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 0);
    std::vector<std::string> lines;
    std::istringstream out(outcome.out);
    for (std::string line; std::getline(out, line);) lines.push_back(line);
    EXPECT_EQ(lines.size(), texts.size());
    lines.resize(texts.size());
    return lines;
  }
  std::vector<std::string> verdicts(const std::vector<Change>& changes) {
    std::vector<std::string> texts;
    texts.reserve(changes.size());
    for (const Change& change : changes) texts.push_back(change.text());
    return verdicts(texts);
  }
  TempFolder folder;
};

// "/fixtures/0/labels/type" -> "fixtures[0].labels", in the reader's spelling.
std::string parent_place(const std::string& pointer) {
  std::string place;
  std::istringstream parts(pointer.substr(1, std::max<std::size_t>(pointer.rfind('/'), 1) - 1));
  for (std::string part; std::getline(parts, part, '/');)
    place += part.find_first_not_of("0123456789") == std::string::npos ? "[" + part + "]"
                                                                       : (place.empty() ? "" : ".") + part;
  return place;
}

TEST_F(Schema, AcceptsWhatTheReaderAccepts) {
  ASSERT_EQ(reader_verdict(sample_store().dump()), "ok");
  const std::vector<Change> accepted = changes("accepted");
  EXPECT_GT(accepted.size(), 80u);
  const auto lines = verdicts(accepted);
  for (std::size_t i = 0; i < accepted.size(); ++i) {
    EXPECT_EQ(lines[i], "ok") << accepted[i];
    EXPECT_EQ(reader_verdict(accepted[i].text()), "ok") << accepted[i];
  }
}

TEST_F(Schema, RejectsWhatTheReaderRejects) {
  const std::vector<Change> rejected = changes("rejected");
  EXPECT_GT(rejected.size(), 240u);
  const auto lines = verdicts(rejected);
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    const Change& change = rejected[i];
    EXPECT_TRUE(lines[i].starts_with("bad: ")) << change;
    const std::string message = reader_verdict(change.text());
    EXPECT_TRUE(message.starts_with("store.json: " + parent_place(change.pointer))) << change << message;
    // Under another type, other keys are missing or superfluous. The same holds for a mesh with other
    // vertices or faces.
    const std::string key = change.pointer.substr(change.pointer.rfind('/') + 1);
    const bool shows_elsewhere = key == "type" || key == "vertices" || key == "faces" || key == "parts";
    if (!shows_elsewhere && key.find_first_of("0123456789\n") == std::string::npos) {
      EXPECT_NE(message.find(key), std::string::npos) << change << ": " << message;
    }
  }
}

TEST_F(Schema, AndReaderRefuseInvalidJson) {
  std::vector<std::string> texts = {
      "",        "null",          "[]",          "{",         "{} {}",           "{'name': 'x'}",
      "{\"a\"}", "{\"name\": x}", "{\"a\": 1,}", "// only a", "{\"name\": \"x}", "\xff\xfe{}",
  };
  for (const std::string value : {"NaN", "Infinity", "-Infinity", "1e999", "0x10", "+1", "1.", "01"}) {
    std::string text = sample_store().dump();
    text.replace(text.find("950"), 3, value);
    texts.push_back(text);
  }
  const auto lines = verdicts(texts);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_TRUE(lines[i].starts_with("bad: ")) << texts[i];
    EXPECT_TRUE(reader_verdict(texts[i]).starts_with("store.json: ")) << reader_verdict(texts[i]);
  }
}

TEST_F(Schema, LeavesSomeErrorsToTheReader) {
  const Json& cases = store_changes().at("left to the reader");
  std::vector<Change> left;
  for (const Json& one : cases) left.push_back({one[0], one[1].is_null() ? "" : one[1].dump()});
  const auto lines = verdicts(left);
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(lines[i], "ok") << left[i];
    const std::string message = reader_verdict(left[i].text());
    EXPECT_TRUE(message.starts_with("store.json: ")) << message;
    for (std::size_t part = 2; part < cases[i].size(); ++part)
      EXPECT_NE(message.find(cases[i][part].get<std::string>()), std::string::npos) << left[i] << message;
  }
  // Python uses the last of two duplicate keys.
  std::string twice = sample_store().dump();
  twice.replace(twice.find("\"name\""), 6, "\"name\":\"first\",\"name\"");
  EXPECT_EQ(verdicts(std::vector<std::string>{twice})[0], "ok");
  EXPECT_TRUE(reader_verdict(twice).starts_with("store.json: name: ")) << reader_verdict(twice);
}

// A catalogue has no schema of its own: its parts are those of a store.
TEST_F(Schema, AcceptsTheCatalogue) {
  const auto parse = [](const char* file) {
    return Json::parse(read_file(std::string(SHELFBEAM_SOURCE_DIR) + file), nullptr, true, true);
  };
  Json store = parse("/data/starter.json");
  const Json catalogue = parse("/data/catalogue.json");
  store.erase("catalogues");
  store["presets"] = catalogue["presets"];
  store["materials"].update(catalogue["materials"]);
  store["fixtures"] = {{{"preset", ""}}};
  Json fixtures = Json::array();
  for (const auto& [name, keys] : catalogue["presets"].items()) {
    store["fixtures"][0]["preset"] = name;
    Json whole = completed_fixture(JsonCursor::parse(store.dump(), name), ".", 0).whole.json;
    whole.update({{"id", name}, {"at", {0, 0}}});
    if (whole["type"] == "box") whole["at"].push_back(0);
    fixtures.push_back(std::move(whole));
  }
  store["fixtures"] = fixtures;
  EXPECT_EQ(verdicts(std::vector<std::string>{store.dump()})[0], "ok");
  store["fixtures"].back()["height"] = -1;
  EXPECT_NE(verdicts(std::vector<std::string>{store.dump()})[0], "ok") << "negative control";
}

TEST_F(Schema, AcceptsExamplesAndResolvedStores) {
  const auto resolved = [](const Store& store) { return resolved_store_json(store, make_scene(store)); };
  std::vector<std::string> texts{resolved(read(sample_store()))};
  for (const auto& example : std::filesystem::directory_iterator(SHELFBEAM_SOURCE_DIR "/examples")) {
    const auto file = example.path() / "store.json";
    texts.push_back(read_file(file));
    // The thousands of labels of the largest take seconds.
    if (!example.path().filename().string().ends_with("ermarket"))
      texts.push_back(resolved(read_store(file)));
  }
  for (const std::string& line : verdicts(texts)) EXPECT_EQ(line, "ok");
}

}  // namespace
}  // namespace shelfbeam::test
