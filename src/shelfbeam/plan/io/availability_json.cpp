#include "shelfbeam/plan/io/availability_json.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "shelfbeam/plan/io/end_reason_json.hpp"

namespace shelfbeam::detail {

namespace {

constexpr auto max_count = std::numeric_limits<std::uint32_t>::max();

template <class Values, class Usual>
Json values_by_label(const Values& values, const Usual& usual, const SignalTable& table) {
  Json object = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != usual) object[table.labels[i].id] = values[i];
  return object;
}

Json to_json(const StateOutcome& outcome, const std::vector<double>& required, const SignalTable& table) {
  return {{"units", outcome.units},
          {"states", outcome.states},
          {"labels_below", outcome.below(required)},
          {"worst_availability", outcome.worst()},
          {"all_reached", outcome.all_reached()},
          {"mean_missed", outcome.mean_missed()},
          {"states_with_miss", outcome.states_with_miss},
          {"missed", values_by_label(outcome.missed, 0U, table)}};
}

Json to_json(const LabelAtRisk& label, const SignalTable& table) {
  Json causes = Json::object();
  for (const CauseShare& cause : label.causes)
    causes[cause.cause] = {{"share", cause.share}, {"deviation", cause.deviation}};
  return {{"label", table.labels[label.label].id}, {"causes", causes}};
}

Json to_json(const Addition& addition, const std::vector<double>& required, const SignalTable& table) {
  const auto& [x, y, z] = addition.position;
  return {{"id", addition.id},
          {"position", {x, y, z}},
          {"without", to_json(addition.without, required, table)},
          {"with", to_json(addition.added, required, table)}};
}

Json to_json(const AssumedVariation& assumed) {
  Json object = Json::object();
  if (assumed.stocking) object["stocking"] = *assumed.stocking;
  if (assumed.open_doors) object["open_doors"] = *assumed.open_doors;
  return object;
}

// Format 1 has sentences instead, which are omitted.
AssumedVariation read_assumed(const JsonCursor& json) {
  AssumedVariation assumed;
  if (json.is_array()) return assumed;
  json.expect_keys({"stocking", "open_doors"});
  if (const auto stocking = json.find("stocking")) {
    const std::vector<double> ends = stocking->numbers(2);
    assumed.stocking = {ends[0], ends[1]};
  }
  if (const auto doors = json.find("open_doors")) assumed.open_doors = doors->non_negative();
  return assumed;
}

class Reader {
 public:
  explicit Reader(const SignalTable& table) : rows_(table.rows()), known_(positions(table.labels)) {}

  template <class T, class Read>
  std::vector<T> by_label(const JsonCursor& object, T usual, const Read& read) const {
    std::vector<T> values(rows_, usual);
    for (const auto& [id, value] : object.members()) {
      const auto found = known_.find(id);
      if (found == known_.end())
        value.fail("names a label that the matrix does not have", "use the matrix of this placement");
      values[found->second] = read(value);
    }
    return values;
  }

  std::vector<std::uint32_t> labels(const JsonCursor& list) const {
    std::vector<std::uint32_t> labels;
    for (const JsonCursor& element : list.elements()) labels.push_back(position(element, known_, "label"));
    return labels;
  }

  StateOutcome outcome(const JsonCursor& object) const {
    object.expect_keys({"units", "states", "labels_below", "worst_availability", "all_reached", "mean_missed",
                        "states_with_miss", "missed"});
    const auto count = [](const JsonCursor& json) {
      return static_cast<std::uint32_t>(json.integer(0, max_count));
    };
    return {count(object["units"]), count(object["states"]), by_label(object["missed"], 0U, count),
            count(object["states_with_miss"])};
  }

  ShownState shown(const JsonCursor& object) const {
    object.expect_keys({"state", "missed"});
    constexpr std::int64_t max_state = std::int64_t{1} << 53;  // exact in every reader of JSON
    return {static_cast<std::uint64_t>(object["state"].integer(0, max_state)), labels(object["missed"])};
  }

  LabelAtRisk at_risk(const JsonCursor& object) const {
    object.expect_keys({"label", "causes"});
    LabelAtRisk label{position(object["label"], known_, "label"), {}};
    for (const auto& [cause, value] : object["causes"].members()) {
      value.expect_keys({"share", "deviation"});
      label.causes.push_back({cause, value["share"].non_negative(), value["deviation"].non_negative()});
    }
    return label;
  }

 private:
  std::size_t rows_;
  Positions known_;
};

}  // namespace

Json availability_object(const Availability& availability, const SignalTable& table) {
  const std::vector<double>& required = availability.required;
  const double usual = required.empty() ? 1 : *std::min_element(required.begin(), required.end());
  const bool is_certified = availability.certified;
  Json examined = Json::array(), shown = Json::array(), at_risk = Json::array();
  for (const StateOutcome& outcome : availability.examined)
    examined.push_back(to_json(outcome, required, table));
  for (const ShownState& state : availability.shown)
    shown.push_back({{"state", state.number}, {"missed", ids_of(table.labels, state.missed)}});
  for (const LabelAtRisk& label : availability.at_risk) at_risk.push_back(to_json(label, table));
  Json object = {
      {"count", availability.nominal.states},
      {"rule", to_text(availability.goal.rule)},
      {"goal", availability.goal.value ? Json(*availability.goal.value) : Json(nullptr)},
      {"availability", usual},
      {"other_availabilities", values_by_label(required, usual, table)},
      {"confidence", availability.confidence},
      {"covers", "states and sampling error"},
      {"assumes", "changes as in the store file, reflectances within their ranges"},
      {"certified", is_certified},
      {"labels_below",
       availability.has_answer() ? Json(availability.answer().below(required)) : Json(nullptr)},
      {"sample_count", availability.sample.units > 0 ? Json(availability.sample.units) : Json(nullptr)},
      {"sample_value", number(availability.sample_value)},
      {"sample_lower_bound", number(availability.sample_lower_bound)},
      {"sample_selected", ids_of(table.transceivers, availability.sample_selected)},
      {"certified_count", is_certified ? Json(availability.answer().units) : Json(nullptr)},
      {"lower_bound", number(availability.lower_bound)},
      {"unreachable", ids_of(table.labels, availability.unreachable)},
      {"nominal", to_json(availability.nominal, required, table)},
      {"sample", to_json(availability.sample, required, table)},
      {"examined", std::move(examined)},
      {"shown_states", std::move(shown)},
      {"responsible", ids_of(table.labels, availability.responsible)},
      {"at_risk", std::move(at_risk)},
      {"addition", availability.addition ? to_json(*availability.addition, required, table) : Json(nullptr)},
      {"assumed", to_json(availability.assumed)},
      {"open", to_json(availability.open)}};
  return object;
}

Availability read_availability(const JsonCursor& object, const SignalTable& table) {
  object.expect_keys({"count",
                      "rule",
                      "goal",
                      "availability",
                      "other_availabilities",
                      "confidence",
                      "covers",
                      "assumes",
                      "certified",
                      "labels_below",
                      "sample_count",
                      "sample_value",
                      "sample_lower_bound",
                      "sample_selected",
                      "certified_count",
                      "lower_bound",
                      "unreachable",
                      "nominal",
                      "sample",
                      "examined",
                      "shown_states",
                      "responsible",
                      "at_risk",
                      "addition",
                      "assumed",
                      "seconds",
                      "open"});
  const Reader reader(table);
  Availability result;
  result.goal.rule = object["rule"].choice<AvailabilityRule>();
  if (const JsonCursor goal = object["goal"]; !goal.is_null()) result.goal.value = goal.positive();
  result.required = reader.by_label(object["other_availabilities"], object["availability"].positive(),
                                    [](const JsonCursor& json) { return json.positive(); });
  result.confidence = object["confidence"].positive();
  result.certified = object["certified"].boolean();
  result.sample_value = number_or_infinity(object["sample_value"]);
  result.sample_lower_bound = number_or_infinity(object["sample_lower_bound"]);
  const Positions columns = positions(table.transceivers);
  for (const JsonCursor& element : object["sample_selected"].elements())
    result.sample_selected.push_back(position(element, columns, "transceiver"));
  result.lower_bound = number_or_infinity(object["lower_bound"]);
  result.unreachable = reader.labels(object["unreachable"]);
  result.nominal = reader.outcome(object["nominal"]);
  result.sample = reader.outcome(object["sample"]);
  for (const JsonCursor& element : object["examined"].elements())
    result.examined.push_back(reader.outcome(element));
  for (const JsonCursor& element : object["shown_states"].elements())
    result.shown.push_back(reader.shown(element));
  result.responsible = reader.labels(object["responsible"]);
  for (const JsonCursor& element : object["at_risk"].elements())
    result.at_risk.push_back(reader.at_risk(element));
  result.assumed = read_assumed(object["assumed"]);
  result.open = read_end_reason(object["open"]);
  if (result.certified && !result.has_answer())
    object["certified"].fail("is true, but no plan was examined", "correct one of them");
  return result;
}

}  // namespace shelfbeam::detail
