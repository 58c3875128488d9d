#include "shelfbeam/plan/io/sensitivity_json.hpp"

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "shelfbeam/placement/answer/names.hpp"

namespace shelfbeam::detail {

namespace {

constexpr auto max_integer = std::numeric_limits<std::int64_t>::max();

void add(Json& object, const MinMargin& least, const SignalTable& table) {
  object["smallest_margin"] = number(least.ratio);
  object["standard_error"] = least.standard_error;
  object["label"] = least.label < table.rows() ? Json(table.labels[least.label].id) : Json(nullptr);
}

Json to_json(const ReflectanceEnd& end, const SignalTable& table) {
  Json object = Json::object();
  add(object, end.min_margin, table);
  object["missed"] = ids_of(table.labels, end.missed);
  object["undecided"] = ids_of(table.labels, end.undecided);
  return object;
}

Json to_json(const ReflectanceStep& step, const SignalTable& table) {
  Json object = Json::object();
  add(object, step.min_margin, table);
  object["change"] = step.change;
  object["change_standard_error"] = step.change_error;
  object["mean_change"] = step.mean_change;
  object["labels_short"] = step.labels_short;
  return object;
}

Json to_json(const MaterialSensitivity& material, const SignalTable& table) {
  return {{"name", material.material},
          {"reflectance", material.reflectance},
          {"range", {material.lower, material.upper}},
          {"assumed", material.is_assumed},
          {"low", to_json(material.at_lower, table)},
          {"high", to_json(material.at_upper, table)}};
}

std::string_view name_of(Verdict holds) {
  return holds == Verdict::reached ? "yes" : holds == Verdict::missed ? "no" : "undecided";
}

MinMargin read_min_margin(const JsonCursor& object, const Positions& known) {
  const JsonCursor label = object["label"];
  return {number_or_infinity(object["smallest_margin"]), object["standard_error"].non_negative(),
          label.is_null() ? 0 : position(label, known, "label")};
}

ReflectanceEnd read_end(const JsonCursor& object, const Positions& known) {
  object.expect_keys({"smallest_margin", "standard_error", "label", "missed", "undecided"});
  const auto labels = [&](std::string_view key) {
    std::vector<std::uint32_t> result;
    for (const JsonCursor& element : object[key].elements())
      result.push_back(position(element, known, "label"));
    return result;
  };
  return {read_min_margin(object, known), labels("missed"), labels("undecided")};
}

ReflectanceStep read_step(const JsonCursor& object, const Positions& known) {
  object.expect_keys({"smallest_margin", "standard_error", "label", "change", "change_standard_error",
                      "mean_change", "labels_short"});
  return {read_min_margin(object, known), object["change"].number(),
          object["change_standard_error"].non_negative(), object["mean_change"].number(),
          static_cast<std::size_t>(object["labels_short"].integer(0, max_integer))};
}

MaterialSensitivity read_material(const JsonCursor& object, const Positions& known) {
  object.expect_keys({"name", "reflectance", "range", "assumed", "low", "high"});
  const std::vector<double> range = object["range"].numbers(2);
  return {object["name"].text(),
          object["reflectance"].number(0, 1),
          range[0],
          range[1],
          object["assumed"].boolean(),
          read_step(object["low"], known),
          read_step(object["high"], known)};
}

}  // namespace

Json sensitivity_object(const Sensitivity& sensitivity, const SignalTable& table) {
  Json as_given = Json::object();
  add(as_given, sensitivity.as_given, table);
  Json materials = Json::array();
  for (const MaterialSensitivity& material : sensitivity.materials)
    materials.push_back(to_json(material, table));
  return {{"confidence", sensitivity.confidence},
          {"holds", name_of(sensitivity.holds())},
          {"assumed_error", sensitivity.assumed_error},
          {"as_given", as_given},
          {"low", to_json(sensitivity.low, table)},
          {"high", to_json(sensitivity.high, table)},
          {"materials", materials},
          {"kept", sensitivity.kept},
          {"watched", sensitivity.watched},
          {"batches", sensitivity.batches}};
}

Sensitivity read_sensitivity(const JsonCursor& cursor, const SignalTable& table) {
  cursor.expect_keys({"confidence", "holds", "assumed_error", "as_given", "low", "high", "materials", "kept",
                      "watched", "batches", "seconds"});
  const Positions known = positions(table.labels);
  Sensitivity sensitivity;
  sensitivity.confidence = cursor["confidence"].positive();
  sensitivity.assumed_error = cursor["assumed_error"].non_negative();
  cursor["as_given"].expect_keys({"smallest_margin", "standard_error", "label"});
  sensitivity.as_given = read_min_margin(cursor["as_given"], known);
  sensitivity.low = read_end(cursor["low"], known);
  sensitivity.high = read_end(cursor["high"], known);
  for (const JsonCursor& element : cursor["materials"].elements())
    sensitivity.materials.push_back(read_material(element, known));
  for (const JsonCursor& element : cursor["kept"].elements()) sensitivity.kept.push_back(element.text());
  sensitivity.watched = static_cast<std::size_t>(cursor["watched"].integer(0, max_integer));
  sensitivity.batches =
      static_cast<std::uint32_t>(cursor["batches"].integer(0, std::numeric_limits<std::uint32_t>::max()));
  if (const JsonCursor stated = cursor["holds"]; stated.text() != name_of(sensitivity.holds()))
    stated.fail("does not match the labels that 'low' lists", "correct one of them");
  return sensitivity;
}

}  // namespace shelfbeam::detail
