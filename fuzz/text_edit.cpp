#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/json_parser.hpp"

#include "reader.hpp"
#include "serve/text/edit.hpp"

namespace shelfbeam::fuzz {

namespace {

using serve::EditOp, serve::Json;

// Behind the text follow the operations.
constexpr std::string_view divider = "\n---\n";

std::vector<EditOp> ops_of(const Json& list) {
  std::vector<EditOp> ops;
  if (!list.is_array()) throw InputError("operations", "is not a list");
  for (const Json& entry : list) {
    if (!entry.is_object() || !entry.contains("path") || !entry["path"].is_string())
      throw InputError("operations", "has an entry without a path");
    EditOp& op = ops.emplace_back();
    op.path = entry["path"].get<std::string>();
    if (entry.contains("before")) op.before = entry["before"];
    if (entry.contains("after")) op.after = entry["after"];
  }
  return ops;
}

// What an operation does to the value, by the library of JSON.
Json patched(const Json& value, const EditOp& op) {
  Json patch{{"path", op.path}, {"op", op.before ? op.after ? "replace" : "remove" : "add"}};
  if (op.after) patch["value"] = *op.after;
  return value.patch(Json::array({patch}));
}

// Gives the operation the old value that it finds, as a changed one would nearly always be refused.
void correct(EditOp& op, const Json& value) {
  if (!op.before) return;
  try {
    op.before = value.at(Json::json_pointer(op.path));
  } catch (const Json::exception&) {  // no pointer, or no such place
  }
}

void fuzz_text_edit(std::string_view bytes) {
  const std::size_t end = bytes.rfind(divider);
  if (end == std::string_view::npos) throw InputError("operations", "are missing");
  const std::string_view text = bytes.substr(0, end);
  Json value = parse_json(text, "text");
  std::string edited_text(text);
  std::vector<EditOp> accepted;
  for (EditOp& op : ops_of(parse_json(bytes.substr(end + divider.size()), "operations"))) {
    correct(op, value);
    try {
      edited_text = serve::edited(edited_text, {op}).text;
    } catch (const serve::EditConflict&) {
      continue;
    }
    value = patched(value, op);
    accepted.push_back(op);
  }
  const serve::EditedText at_once = serve::edited(text, accepted);
  for (const std::string& result : {edited_text, at_once.text})
    if (!serve::same_value(parse_json(result, "result"), value))
      throw std::logic_error("edits lead to another value: " + result);
  if (serve::spliced(at_once.text, inverse(at_once.splices)) != text)
    throw std::logic_error("an edit cannot be undone: " + at_once.text);
}

std::vector<std::string> text_edit_seeds() {
  const std::string end(divider);
  return {
      R"({ // store
  "name": "Kiosk", /* units: m */ "at": [1, 2.50, 3],
  // shelves
  "fixtures": [
    { "id": "A", "labels": {} }, // first
    // second
    { "id": "B", "at": [1e1, -0] }
  ],
})" + end +
          R"([{"path": "/at/1", "before": 2.5, "after": 2.75}, {"path": "/fixtures/1", "before": {"id": "B", "at": [10, 0]}},
 {"path": "/fixtures/1", "after": {"id": "C", "at": [[1, 2], [3, 4]]}}, {"path": "/fixtures/0/labels/type", "after": "l"}])",
      R"([[1, 2, 3], {"~/": null}, []])" + end +
          R"([{"path": "/0", "before": [1, 2, 3], "after": [0, 1, 3]}, {"path": "/1/~0~1", "before": null},
 {"path": "/2/0", "after": [{"a": 1}]}, {"path": "/3", "after": true}])",
      source_file("examples/thesis/store.json") + end +
          R"([{"path": "/units", "after": "m"}, {"path": "/name", "after": ""}])"};
}

}  // namespace

extern const Reader text_edit;
const Reader text_edit{"text_edit", fuzz_text_edit, text_edit_seeds};

}  // namespace shelfbeam::fuzz
