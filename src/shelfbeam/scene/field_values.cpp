#include "shelfbeam/scene/field_values.hpp"

#include <variant>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

bool describe_direction(Fields& f, std::string_view key, Vec3& direction, const Field& field) {
  return f.custom(key,
                  {[&](const JsonCursor& json) { direction = read_direction(json); },
                   [&] { return array_of(direction); }, R"({"$ref": "#/$defs/direction"})"},
                  field);
}

bool describe_note(Fields& f, std::string_view key, std::string& text, std::string_view says) {
  return f.text(
      key, text,
      {.says = says, .is_name = true, .is_optional = true, .otherwise = "none", .is_written = !text.empty()});
}

bool describe_share_range(Fields& f, std::string_view key, Range& range, const Field& field) {
  return f.custom(key,
                  {[&](const JsonCursor& json) { range = read_share_range(json); },
                   [&] { return resolved(range); }, R"({"$ref": "#/$defs/share_range"})"},
                  field);
}

bool describe_plan_area(Fields& f, PlanArea& area, std::string_view says) {
  const CustomValue value{[&](const JsonCursor& json) {
                            if (json.is_string())
                              area = json.text();
                            else
                              area = read_polygon(json);
                          },
                          [&] {
                            const auto* name = std::get_if<std::string>(&area);
                            return name != nullptr ? nlohmann::ordered_json(*name)
                                                   : nlohmann::ordered_json(std::get<Polygon>(area));
                          },
                          R"({"$ref": "#/$defs/area"})"};
  return f.custom("area", value, {.says = says, .unit = "m"});
}

}  // namespace shelfbeam
