#include "shelfbeam/plan/io/sensitivity_json.hpp"

#include <limits>

namespace shelfbeam::detail {

namespace {

constexpr auto most_integer = std::numeric_limits<std::int64_t>::max();

void add(Json& object, const LeastMargin& least, const SignalTable& table) {
  object["smallest_margin"] = number(least.ratio);
  object["standard_error"] = least.standard_error;
  object["label"] = least.label < table.rows() ? Json(table.labels[least.label].id) : Json(nullptr);
}

Json ids(const std::vector<std::uint32_t>& labels, const SignalTable& table) {
  Json list = Json::array();
  for (const std::uint32_t i : labels) list.push_back(table.labels[i].id);
  return list;
}

Json to_json(const ReflectanceEnd& end, const SignalTable& table) {
  Json object = Json::object();
  add(object, end.least, table);
  object["missed"] = ids(end.missed, table);
  object["undecided"] = ids(end.undecided, table);
  return object;
}

Json to_json(const ReflectanceStep& step, const SignalTable& table) {
  Json object = Json::object();
  add(object, step.least, table);
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

class Reader {
 public:
  explicit Reader(const SignalTable& table) : labels_(positions(table.labels)) {}

  LeastMargin least(const JsonCursor& object) const {
    const JsonCursor label = object["label"];
    return {number_or_infinity(object["smallest_margin"]), object["standard_error"].non_negative(),
            label.is_null() ? 0 : position(label, labels_, "label")};
  }
  ReflectanceEnd end(const JsonCursor& object) const {
    object.expect_keys({"smallest_margin", "standard_error", "label", "missed", "undecided"});
    return {least(object), labels(object["missed"]), labels(object["undecided"])};
  }
  ReflectanceStep step(const JsonCursor& object) const {
    object.expect_keys({"smallest_margin", "standard_error", "label", "change", "change_standard_error",
                        "mean_change", "labels_short"});
    return {least(object), object["change"].number(), object["change_standard_error"].non_negative(),
            object["mean_change"].number(),
            static_cast<std::size_t>(object["labels_short"].integer(0, most_integer))};
  }
  MaterialSensitivity material(const JsonCursor& object) const {
    object.expect_keys({"name", "reflectance", "range", "assumed", "low", "high"});
    const std::vector<double> range = object["range"].numbers(2);
    return {object["name"].text(),
            object["reflectance"].number(0, 1),
            range[0],
            range[1],
            object["assumed"].boolean(),
            step(object["low"]),
            step(object["high"])};
  }

 private:
  std::vector<std::uint32_t> labels(const JsonCursor& list) const {
    std::vector<std::uint32_t> result;
    for (const JsonCursor& element : list.elements()) result.push_back(position(element, labels_, "label"));
    return result;
  }

  Positions labels_;
};

}  // namespace

Json to_json(const Sensitivity& sensitivity, const SignalTable& table) {
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
          {"batches", sensitivity.batches},
          {"seconds", sensitivity.seconds}};
}

Sensitivity read_sensitivity(const JsonCursor& cursor, const SignalTable& table) {
  cursor.expect_keys({"confidence", "holds", "assumed_error", "as_given", "low", "high", "materials", "kept",
                      "watched", "batches", "seconds"});
  const Reader reader(table);
  Sensitivity sensitivity;
  sensitivity.confidence = cursor["confidence"].positive();
  sensitivity.assumed_error = cursor["assumed_error"].non_negative();
  cursor["as_given"].expect_keys({"smallest_margin", "standard_error", "label"});
  sensitivity.as_given = reader.least(cursor["as_given"]);
  sensitivity.low = reader.end(cursor["low"]);
  sensitivity.high = reader.end(cursor["high"]);
  for (const JsonCursor& element : cursor["materials"].elements())
    sensitivity.materials.push_back(reader.material(element));
  for (const JsonCursor& element : cursor["kept"].elements()) sensitivity.kept.push_back(element.text());
  sensitivity.watched = static_cast<std::size_t>(cursor["watched"].integer(0, most_integer));
  sensitivity.batches =
      static_cast<std::uint32_t>(cursor["batches"].integer(0, std::numeric_limits<std::uint32_t>::max()));
  sensitivity.seconds = cursor["seconds"].non_negative();
  if (const JsonCursor stated = cursor["holds"]; stated.text() != name_of(sensitivity.holds()))
    stated.fail("does not agree with the labels that 'low' lists", "correct one of them");
  return sensitivity;
}

}  // namespace shelfbeam::detail
