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

std::vector<Finding> findings_of(const Json& list) {
  std::vector<Finding> findings;
  for (const Json& json : list) {
    Finding& one = findings.emplace_back();
    if (json.is_string()) {
      one = {FindingCode::other, {}, {}, json};
      continue;
    }
    // Later versions may have further codes.
    one.code = finding_code(json.at("code").get<std::string>()).value_or(FindingCode::other);
    one.path = json.at("path");
    for (const Json& value : json.at("values"))
      one.values.push_back(value.is_string() ? FindingValue(value.get<std::string>())
                                             : FindingValue(value.get<double>()));
    one.sentence = json.at("sentence");
  }
  return findings;
}

std::vector<Finding> read_findings(const JsonCursor& list) {
  try {
    list.size();  // of a list
    return findings_of(list.value());
  } catch (const Json::exception&) {
    list.fail("has a warning without code, path, values or sentence", "restore the file");
  }
}

}  // namespace shelfbeam
