#include "shelfbeam/base/fields/finding_json.hpp"

#include <variant>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const auto& [code, path, values, sentence] : findings) {
    Json& one = list.emplace_back(Json{{"code", name_of(code)}, {"path", path}, {"values", Json::array()}});
    for (const FindingValue& value : values)
      std::visit([&](const auto& plain) { one["values"].push_back(plain); }, value);
    one["sentence"] = sentence;
  }
  return list;
}

std::vector<Finding> read_findings(const JsonCursor& list) {
  std::vector<Finding> findings;
  for (const JsonCursor& json : list.elements()) {
    if (json.is_string()) {
      findings.push_back({FindingCode::other, {}, {}, json.text()});
      continue;
    }
    json.expect_keys({"code", "path", "values", "sentence"});
    Finding& one = findings.emplace_back();
    // Later versions may have further codes.
    one.code = finding_code(json["code"].text()).value_or(FindingCode::other);
    one.path = json["path"].text();
    for (const JsonCursor& value : json["values"].elements())
      one.values.push_back(value.is_string() ? FindingValue(value.text()) : FindingValue(value.number()));
    one.sentence = json["sentence"].text();
  }
  return findings;
}

}  // namespace shelfbeam
