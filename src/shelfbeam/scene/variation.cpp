#include "shelfbeam/scene/variation.hpp"

#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

Range read_share_range(const JsonCursor& json) {
  if (json.is_number()) {
    const double fixed = json.number(0, 1);
    return {fixed, fixed};
  }
  json.expect_keys({"uniform"});
  const JsonCursor ends = json["uniform"];
  ends.numbers(2);
  const Range range{ends.element(0).number(0, 1), ends.element(1).number(0, 1)};
  if (range.high < range.low) ends.fail("has its second number below its first", "swap them");
  return range;
}

bool describe_share_range(Fields& f, std::string_view key, Range& range, const Field& field) {
  return f.custom(key,
                  {[&](const JsonCursor& json) { range = read_share_range(json); },
                   [&] { return resolved(range); }, R"({"$ref": "#/$defs/share_range"})"},
                  field);
}

nlohmann::ordered_json resolved(const Range& range) {
  return {{"uniform", {range.low, range.high}}};
}

}  // namespace shelfbeam
