#include "unit/scene/fields/table_fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shelfbeam::test {

namespace {

std::string_view unit_of(Scalar kind) {
  switch (kind) {
    case Scalar::length:
    case Scalar::distance:
    case Scalar::extent:
    case Scalar::coordinate:
      return "m";
    case Scalar::degrees:
      return "degrees";
    case Scalar::share:
    case Scalar::quantity:
    case Scalar::amount:
    case Scalar::number:
      break;
  }
  return {};
}

template <class Value>
std::string code(const Value& value) {
  std::string text = nlohmann::json(value).dump();
  for (std::size_t at = 0; (at = text.find(',', at)) != std::string::npos; at += 2) text.insert(at + 1, " ");
  return "`" + text + "`";
}

}  // namespace

bool TableFields::add(std::string_view key, std::string_view unit, const std::string& value,
                      const Field& field) {
  if (rows.find(fmt::format("| `{}` |", key)) != std::string::npos) return false;  // in another form
  const std::string otherwise = !field.otherwise.empty() ? std::string(field.otherwise)
                                : !field.instead.empty() ? fmt::format("*required*, or `{}`", field.instead)
                                : field.is_optional      ? value
                                                         : "*required*";
  std::string limits;
  if (std::isfinite(field.least) && std::isfinite(field.most))
    limits = fmt::format("; {} to {}", field.least, field.most);
  else if (std::isfinite(field.least))
    limits = fmt::format("; at least {}", field.least);
  else if (std::isfinite(field.most))
    limits = fmt::format("; at most {}", field.most);
  rows += fmt::format(
      "| `{}` | {}| {} | {}{} |\n", key,
      field.unit.empty() ? (unit.empty() ? "" : fmt::format("{} ", unit)) : fmt::format("{} ", field.unit),
      otherwise, field.says, limits);
  return false;
}

void TableFields::key(std::string_view name, const Field& field) {
  add(name, "", "", field);
}

bool TableFields::scalar(std::string_view key, Scalar kind, double& value, const Field& field) {
  return add(key, unit_of(kind), fmt::format("{}", value), field);
}

bool TableFields::array(std::string_view key, Scalar kind, std::span<double> values, const Field& field) {
  return add(key, unit_of(kind), code(std::vector(values.begin(), values.end())), field);
}

bool TableFields::list(std::string_view key, Scalar kind, std::vector<double>& values, const Field& field) {
  return add(key, unit_of(kind), code(values), field);
}

bool TableFields::integer(std::string_view key, std::int64_t& value, const Field& field) {
  return add(key, "", fmt::format("{}", value), field);
}

bool TableFields::boolean(std::string_view key, bool& value, const Field& field) {
  return add(key, "", code(value), field);
}

bool TableFields::text(std::string_view key, std::string& value, const Field& field) {
  return add(key, "", code(value), field);
}

bool TableFields::choices(std::string_view key, std::vector<std::string_view>& values,
                          std::span<const std::string_view>, bool single, const Field& field) {
  return add(key, "", single && !values.empty() ? code(values.front()) : code(values), field);
}

}  // namespace shelfbeam::test
