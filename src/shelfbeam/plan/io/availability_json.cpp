#include "shelfbeam/plan/io/availability_json.hpp"

#include <algorithm>
#include <limits>

#include "shelfbeam/plan/io/end_reason_json.hpp"

namespace shelfbeam::detail {

namespace {

/// An object with the values of labels that differ from `usual`.
template <class T, class Read>
void by_label(Record& record, std::string_view key, std::vector<T>& values, const T& usual,
              const Read& read_value) {
  const Ids& labels = record.ids().labels;
  const auto write = [&] {
    Json object = Json::object();
    for (std::uint32_t i = 0; i < values.size(); ++i)
      if (values[i] != usual) object[std::string(labels[i])] = values[i];
    return object;
  };
  record.custom(key, write, [&](const JsonCursor& json) {
    values.assign(labels.size(), usual);
    for (const auto& [id, value] : json.members()) values[labels.position(id, value)] = read_value(value);
  });
}

/// An outcome with the number of labels below these availabilities.
auto outcome_of(const std::vector<double>& required) {
  return [&](Record& record, StateOutcome& outcome) {
    record.count("units", outcome.units);
    record.count("states", outcome.states);
    record.note("labels_below", [&] { return outcome.below(required); });
    record.note("worst_availability", [&] { return outcome.worst(); });
    record.note("all_reached", [&] { return outcome.all_reached(); });
    record.note("mean_missed", [&] { return outcome.mean_missed(); });
    record.count("states_with_miss", outcome.states_with_miss);
    by_label(record, "missed", outcome.missed, 0U, [](const JsonCursor& json) {
      return static_cast<std::uint32_t>(json.integer(0, std::numeric_limits<std::uint32_t>::max()));
    });
  };
}

Json addition_json(const Availability& availability, const TableIds& ids) {
  if (!availability.addition) return nullptr;
  const auto& [id, position, without, added] = *availability.addition;
  const auto describe_outcome = outcome_of(availability.required);
  return {{"id", id},
          {"position", {position.x, position.y, position.z}},
          {"without", Record::write(without, ids, describe_outcome)},
          {"with", Record::write(added, ids, describe_outcome)}};
}

}  // namespace

void describe(Record& record, ShownState& state) {
  constexpr std::int64_t max_state = std::int64_t{1} << 53;  // exact in every reader of JSON
  record.count("state", state.number, max_state);
  record.id_list("missed", state.missed, record.ids().labels);
}

void describe(Record& record, CauseShare& cause) {
  record.non_negative("share", cause.share);
  record.non_negative("deviation", cause.deviation);
}

void describe(Record& record, LabelAtRisk& label) {
  const auto write = [&] {
    Json causes = Json::object();
    for (const CauseShare& one : label.causes) causes[one.cause] = Record::write(one, record.ids());
    return causes;
  };
  record.id("label", label.label, record.ids().labels);
  record.custom("causes", write, [&](const JsonCursor& json) {
    for (const auto& [name, value] : json.members()) {
      label.causes.push_back(Record::read<CauseShare>(value, record.ids()));
      label.causes.back().cause = name;
    }
  });
}

void describe(Record& record, CauseAlone& cause) {
  const Ids& labels = record.ids().labels;
  record.text("cause", cause.cause);
  record.count("states", cause.states);
  record.id_list("taken", cause.taken, labels);
  record.count("units", cause.units);
  record.number("lower_bound", cause.lower_bound);
  record.id_list("unreachable", cause.unreachable, labels);
}

void describe(Record& record, LostLabel& label) {
  record.id("label", label.label, record.ids().labels);
  record.texts("causes", label.causes);
}

void describe(Record& record, AssumedVariation& assumed) {
  if (record.has("stocking", assumed.stocking.has_value()))
    record.custom(
        "stocking", [&] { return *assumed.stocking; },
        [&](const JsonCursor& json) {
          const std::vector<double> ends = json.numbers(2);
          assumed.stocking = {ends[0], ends[1]};
        });
  if (record.has("open_doors", assumed.open_doors.has_value()))
    record.non_negative("open_doors",
                        assumed.open_doors ? *assumed.open_doors : assumed.open_doors.emplace());
}

void describe(Record& record, Availability& a) {
  const Ids &labels = record.ids().labels, &transceivers = record.ids().transceivers;
  const auto describe_outcome = outcome_of(a.required);
  double usual = a.required.empty() ? 1 : *std::min_element(a.required.begin(), a.required.end());
  const auto read_goal = [&](const JsonCursor& json) {
    if (!json.is_null()) a.goal.value = json.positive();
  };
  record.note("count", [&] { return a.nominal.states; });
  record.name("rule", a.goal.rule);
  record.custom("goal", [&] { return a.goal.value ? Json(*a.goal.value) : Json(nullptr); }, read_goal);
  record.positive("availability", usual);
  by_label(record, "other_availabilities", a.required, usual,
           [](const JsonCursor& json) { return json.positive(); });
  record.positive("confidence", a.confidence);
  record.note("covers", [] { return "states and sampling error"; });
  record.note("assumes", [&] {
    const bool as_given = std::find(a.without.begin(), a.without.end(), "reflectance") != a.without.end();
    return as_given ? "changes and reflectances as in the store file"
                    : "changes as in the store file, reflectances within their ranges";
  });
  record.boolean("certified", a.certified);
  record.note("labels_below",
              [&] { return a.has_answer() ? Json(a.answer().below(a.required)) : Json(nullptr); });
  record.note("sample_count", [&] { return a.sample.units > 0 ? Json(a.sample.units) : Json(nullptr); });
  record.number("sample_value", a.sample_value);
  record.number("sample_lower_bound", a.sample_lower_bound);
  record.id_list("sample_selected", a.sample_selected, transceivers);
  record.note("certified_count", [&] { return a.certified ? Json(a.answer().units) : Json(nullptr); });
  record.number("lower_bound", a.lower_bound);
  record.id_list("unreachable", a.unreachable, labels);
  record.object("nominal", a.nominal, describe_outcome);
  record.object("sample", a.sample, describe_outcome);
  record.list("examined", a.examined, describe_outcome);
  record.list("shown_states", a.shown);
  record.id_list("responsible", a.responsible, labels);
  record.list("at_risk", a.at_risk);
  record.later().count("nominal_bound", a.nominal_bound);
  record.later().list("alone", a.alone);
  record.later().count("missed_as_given", a.missed_as_given);
  record.later().list("lost", a.lost);
  record.later().texts("without", a.without);
  record.note("addition", [&] { return addition_json(a, record.ids()); });
  // Format 1 has sentences instead, which are omitted.
  const auto read_assumed = [&](const JsonCursor& json) {
    if (!json.is_array()) a.assumed = Record::read<AssumedVariation>(json, record.ids());
  };
  record.custom("assumed", [&] { return Record::write(a.assumed, record.ids()); }, read_assumed);
  describe_end(record, a.open);
  record.ignore({"seconds"});
  if (record.file() != nullptr && a.certified && !a.has_answer())
    (*record.file())["certified"].fail("is true, but no plan was examined", "correct one of them");
}

}  // namespace shelfbeam::detail
