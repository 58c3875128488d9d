#include "unit/scene/fields/schema_fields.hpp"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

namespace shelfbeam::test {

namespace {

using Json = nlohmann::ordered_json;

Json schema_of_kind(Scalar kind, const Field& field) {
  const auto reference = [](const char* name) { return Json{{"$ref", std::string("#/$defs/") + name}}; };
  const auto number = [&](double least, double most) {
    Json schema{{"type", "number"}};
    if (std::isfinite(std::max(least, field.least))) schema["minimum"] = std::max(least, field.least);
    if (std::isfinite(std::min(most, field.most))) schema["maximum"] = std::min(most, field.most);
    return schema;
  };
  const bool is_narrow = field.least > 1e-3 || std::isfinite(field.most);
  constexpr double longest = 1e6;  // 1 km in mm
  switch (kind) {
    case Scalar::length:
      return is_narrow ? number(1e-3, longest) : reference("length");
    case Scalar::distance: {
      Json schema = number(0, longest);
      schema["maximum"] = std::min(longest, 1000 * field.most);
      return schema;
    }
    case Scalar::extent:
      return reference("radius");
    case Scalar::coordinate:
      return reference("coordinate");
    case Scalar::degrees:
      return is_narrow ? number(-360, 360) : reference("angle_deg");
    case Scalar::share:
      return std::isfinite(field.least) || std::isfinite(field.most) ? number(0, 1) : reference("share");
    case Scalar::quantity:
      return reference("quantity");
    case Scalar::amount:
      return reference("amount");
    case Scalar::number:
      break;
  }
  return number(-HUGE_VAL, HUGE_VAL);
}

Json schema_of_name(NameList list) {
  if (list == NameList::material) return {{"$ref", "#/$defs/material_name"}};
  return {{"description", list == NameList::label_type ? "Name of one of 'label_types'."
                                                       : "Name of one of 'transceiver_types'."},
          {"type", "string"}};
}

}  // namespace

std::string plain(std::string_view markdown) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  std::string text = std::regex_replace(std::string(markdown), link, "$1");
  std::replace(text.begin(), text.end(), '`', '\'');
  return text;
}

std::string compact(const Json& json, std::size_t indent) {
  constexpr std::size_t width = 120;
  std::string line;
  if (!json.is_structured() || json.empty()) return json.dump();
  const bool is_object = json.is_object();
  line = is_object ? "{ " : "[";
  std::string lines = is_object ? "{" : "[";
  const std::string margin(indent + 2, ' ');
  const char* separator = "";
  for (const auto& [key, value] : json.items()) {
    const std::string name = is_object ? Json(key).dump() + ": " : "";
    line += (*separator != 0 ? ", " : "") + name + compact(value, width);
    lines += fmt::format("{}\n{}{}{}", separator, margin, name, compact(value, indent + 2));
    separator = ",";
  }
  line += is_object ? " }" : "]";
  if (indent >= width || indent + line.size() <= width) return line;
  return lines + "\n" + std::string(indent, ' ') + (is_object ? "}" : "]");
}

Json schema_of(const Fields::Part& part) {
  SchemaFields first(true);
  part(first);
  if (!first.has_forms()) return first.object_schema();
  SchemaFields second(false);
  part(second);
  return {{"oneOf", {first.object_schema(), second.object_schema()}}};
}

Json SchemaFields::object_schema() const {
  Json schema{{"type", "object"}, {"additionalProperties", false}};
  if (!required_.empty()) schema["required"] = required_;
  if (!one_of_.empty()) schema["oneOf"] = one_of_;
  if (!any_of_.empty()) schema["anyOf"] = any_of_;
  schema["properties"] = properties_;
  return schema;
}

void SchemaFields::add(std::string_view key, Json schema, bool is_required) {
  properties_[std::string(key)] = std::move(schema);
  if (is_required) required_.push_back(key);
}

bool SchemaFields::describe(std::string_view key, Json schema, const Field& field, const Json& value) {
  Json whole = Json::object();
  if (!field.says.empty()) {
    whole["description"] = plain(field.says);
    schema.erase("description");
  }
  whole.update(schema);
  if (field.is_optional && field.otherwise.empty()) whole["default"] = value;
  if (!field.instead.empty()) {
    one_of_ = Json::array({{{"required", {key}}}, {{"required", {field.instead}}}});
    properties_[std::string(field.instead)] = {{"$ref", "#/$defs/" + std::string(field.instead)}};
  }
  add(key, std::move(whole), !field.is_optional && field.instead.empty());
  return false;
}

bool SchemaFields::scalar(std::string_view key, Scalar kind, double& value, const Field& field) {
  return describe(key, schema_of_kind(kind, field), field, value);
}

bool SchemaFields::array(std::string_view key, Scalar kind, std::span<double> values, const Field& field) {
  if (kind == Scalar::coordinate)
    return describe(key, {{"$ref", values.size() == 2 ? "#/$defs/plan_point" : "#/$defs/point"}}, field);
  return describe(key,
                  {{"type", "array"},
                   {"items", schema_of_kind(kind, field)},
                   {"minItems", values.size()},
                   {"maxItems", values.size()}},
                  field, std::vector(values.begin(), values.end()));
}

bool SchemaFields::list(std::string_view key, Scalar kind, std::vector<double>& values, const Field& field) {
  Json schema{{"type", "array"}, {"items", schema_of_kind(kind, field)}};
  if (field.fewest > 0) schema["minItems"] = field.fewest;
  if (field.longest > 0) schema["maxItems"] = field.longest;
  return describe(key, std::move(schema), field, values);
}

bool SchemaFields::polygon(std::string_view key, Polygon&, const Field& field) {
  return describe(key, {{"$ref", "#/$defs/polygon"}}, field);
}

bool SchemaFields::integer(std::string_view key, std::int64_t& value, const Field& field) {
  return describe(key,
                  {{"type", "integer"},
                   {"minimum", static_cast<std::int64_t>(field.least)},
                   {"maximum", static_cast<std::int64_t>(field.most)}},
                  field, value);
}

bool SchemaFields::boolean(std::string_view key, bool& value, const Field& field) {
  return describe(key, {{"type", "boolean"}}, field, value);
}

bool SchemaFields::text(std::string_view key, std::string& value, const Field& field) {
  if (field.is_name) return describe(key, {{"$ref", "#/$defs/name"}}, field, value);
  Json schema{{"type", "string"}};
  if (field.fewest > 0) schema["minLength"] = field.fewest;
  return describe(key, std::move(schema), field, value);
}

bool SchemaFields::choices(std::string_view key, std::vector<std::string_view>& values,
                           std::span<const std::string_view> known, bool single, const Field& field) {
  const Json one{{"enum", known}};
  if (single) return describe(key, one, field, values.empty() ? Json() : Json(values.front()));
  return describe(key, {{"type", "array"}, {"items", one}, {"minItems", 1}, {"uniqueItems", true}}, field,
                  values);
}

bool SchemaFields::reference(std::string_view key, NameList list, std::uint32_t&, const Field& field) {
  return describe(key, schema_of_name(list), field);
}

bool SchemaFields::references(std::string_view key, NameList list,
                              std::vector<std::pair<std::string, std::uint32_t>>& values,
                              const Field& field) {
  if (field.one_for_all)
    return describe(key, {{"oneOf", {schema_of_name(list), schema_of([&](Fields& fields) {
                                       for (auto& [name, value] : values)
                                         fields.reference(name, list, value, {});
                                     })}}},
                    field);
  Json schema{{"type", "object"}};
  if (!field.pattern.empty()) schema["propertyNames"] = {{"pattern", field.pattern}};
  schema["additionalProperties"] = schema_of_name(list);
  return describe(key, std::move(schema), field);
}

bool SchemaFields::object(std::string_view key, const Part& part, const Field& field) {
  return describe(key, schema_of(part), field);
}

bool SchemaFields::objects(std::string_view key, std::size_t,
                           const std::function<void(Fields&, std::size_t)>& part, const Field& field) {
  Json schema{{"type", "array"}};
  if (field.fewest > 0) schema["minItems"] = field.fewest;
  if (field.longest > 0) schema["maxItems"] = field.longest;
  schema["items"] = schema_of([&](Fields& fields) { part(fields, 0); });
  return describe(key, std::move(schema), field);
}

bool SchemaFields::custom(std::string_view key, const CustomValue& value, const Field& field) {
  return describe(key, Json::parse(value.schema), field);
}

void SchemaFields::either(std::initializer_list<std::string_view>, bool, const Part& first,
                          const Part& second) {
  has_forms_ = true;
  (is_first_form_ ? first : second)(*this);
}

void SchemaFields::one_of(std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) one_of_.push_back({{"required", {key}}});
}

void SchemaFields::any_of(std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) any_of_.push_back({{"required", {key}}});
}

}  // namespace shelfbeam::test
