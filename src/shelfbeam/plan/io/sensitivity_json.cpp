#include "shelfbeam/plan/io/sensitivity_json.hpp"

#include <limits>
#include <string_view>

namespace shelfbeam::detail {

namespace {

constexpr auto max_integer = std::numeric_limits<std::int64_t>::max();

std::string_view name_of(Verdict holds) {
  return holds == Verdict::reached ? "yes" : holds == Verdict::missed ? "no" : "undecided";
}

}  // namespace

void describe(Record& record, MinMargin& least) {
  const Ids& labels = record.ids().labels;
  record.number("smallest_margin", least.ratio);
  record.non_negative("standard_error", least.standard_error);
  record.custom(
      "label", [&] { return least.label < labels.size() ? Json(labels[least.label]) : Json(nullptr); },
      [&](const JsonCursor& json) {
        if (!json.is_null()) least.label = labels.position(json);
      });
}

void describe(Record& record, ReflectanceEnd& end) {
  const Ids& labels = record.ids().labels;
  describe(record, end.min_margin);
  record.id_list("missed", end.missed, labels);
  record.id_list("undecided", end.undecided, labels);
}

void describe(Record& record, ReflectanceStep& step) {
  describe(record, step.min_margin);
  record.finite("change", step.change);
  record.non_negative("change_standard_error", step.change_error);
  record.finite("mean_change", step.mean_change);
  record.count("labels_short", step.labels_short, max_integer);
}

void describe(Record& record, MaterialSensitivity& one) {
  const auto read_range = [&](const JsonCursor& json) {
    const std::vector<double> range = json.numbers(2);
    one.lower = range[0];
    one.upper = range[1];
  };
  record.text("name", one.material);
  record.value("reflectance", one.reflectance, [](const JsonCursor& json) { return json.number(0, 1); });
  record.custom("range", [&] { return Json{one.lower, one.upper}; }, read_range);
  record.boolean("assumed", one.is_assumed);
  record.object("low", one.at_lower);
  record.object("high", one.at_upper);
}

void describe(Record& record, Sensitivity& sensitivity) {
  record.positive("confidence", sensitivity.confidence);
  record.note("holds", [&] { return name_of(sensitivity.holds()); });
  record.non_negative("assumed_error", sensitivity.assumed_error);
  record.object("as_given", sensitivity.as_given);
  record.object("low", sensitivity.low);
  record.object("high", sensitivity.high);
  record.list("materials", sensitivity.materials);
  record.texts("kept", sensitivity.kept);
  record.count("watched", sensitivity.watched, max_integer);
  record.count("batches", sensitivity.batches);
  record.ignore({"seconds"});
  if (record.file() == nullptr) return;
  if (const JsonCursor stated = (*record.file())["holds"]; stated.text() != name_of(sensitivity.holds()))
    stated.fail("does not match the labels that 'low' lists", "correct one of them");
}

}  // namespace shelfbeam::detail
