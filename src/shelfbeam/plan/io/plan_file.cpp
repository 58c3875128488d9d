#include "shelfbeam/plan/io/plan_file.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/fields/finding_json.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/io/placement_json.hpp"
#include "shelfbeam/plan/io/alternatives_json.hpp"
#include "shelfbeam/plan/io/availability_json.hpp"
#include "shelfbeam/plan/io/end_reason_json.hpp"
#include "shelfbeam/plan/io/sensitivity_json.hpp"

namespace shelfbeam {

namespace detail {

// The file has verdicts only; verification.csv has signals and limits.
void describe(Record& record, Certificate& certificate) {
  const Ids& ids = record.ids().labels;
  auto& labels = certificate.labels;
  const auto list = [&](std::string_view key, Verdict verdict) {
    const auto write = [&] {
      std::vector<LabelId> positions;
      for (std::uint32_t i = 0; i < labels.size(); ++i)
        if (labels[i].verdict == verdict) positions.push_back(i);
      return ids.list(positions);
    };
    record.custom(key, write, [&](const JsonCursor& json) {
      for (const LabelId i : ids.positions<LabelId>(json)) labels[i].verdict = verdict;
    });
  };
  if (record.file() != nullptr) labels.assign(ids.size(), {.verdict = Verdict::reached});
  record.positive("confidence", certificate.confidence);
  record.note("covers", [] { return "sampling error"; });
  record.note("assumes", [] { return "materials, stock and mounting as in the store file"; });
  record.note("reached", [&] {
    return certificate.none_verified() ? Json() : Json(certificate.count(Verdict::reached));
  });
  // Plans of version 0.2.0 and earlier call labels without samples undecided, and have no bound on the cost.
  list("missed", Verdict::missed);
  list("undecided", Verdict::undecided);
  record.later();
  list("not_verified_yet", Verdict::unverified);
  record.count("count_lower_bound", certificate.count_lower_bound);
  record.later().non_negative("cost_lower_bound", certificate.cost_lower_bound);
  record.count("bound_labels", certificate.bound_labels);
  record.count("rounds", certificate.rounds);
  describe_end(record, certificate.open);
  record.ignore({"seconds"});
  if (record.file() == nullptr) return;
  const JsonCursor stated = (*record.file())["reached"];
  if (!stated.is_null() && stated.number() != static_cast<double>(certificate.count(Verdict::reached)))
    stated.fail("is not the number of labels that none of the lists names", "correct one of them");
}

void describe(Record& record, DecisiveValue& value) {
  record.name("value", value.kind);
  record.text("of", value.of);
  record.name("state", value.state);
  record.non_negative("amount", value.amount);
}

void describe(Record& record, CertifiedPlan& plan) {
  describe(record, plan.placement);
  if (record.has("seed", plan.seed.has_value()))
    record.custom(
        "seed", [&] { return Json(*plan.seed); },
        [&](const JsonCursor& json) { plan.seed = json.natural(); });
  describe(record, plan.curve);
  record.optional("certificate", plan.certificate);
  record.optional("states", plan.availability);
  if (record.has("alternatives", !plan.alternatives.empty()))
    record.object("alternatives", plan.alternatives);
  record.optional("sensitivity", plan.sensitivity);
  if (record.has("warnings", !plan.warnings.empty()))
    record.custom(
        "warnings", [&] { return to_json(plan.warnings); },
        [&](const JsonCursor& json) { plan.warnings = read_findings(json); });
  if (record.has("values", !plan.values.empty())) record.list("values", plan.values);
  if (record.has("example", plan.is_example)) record.boolean("example", plan.is_example);
}

}  // namespace detail

using detail::Record;

namespace {

using detail::Json;

/// The descriptions of the labels that a file names.
class NamesOfLabels {
 public:
  explicit NamesOfLabels(std::span<const Label> labels) {
    for (const Label& label : labels)
      if (!label.description.empty()) descriptions_.emplace(label.id, label.description);
  }

  /// The labels that are `not_verified_yet`, which may be all, are only listed.
  void add_from(const Json& value, bool names_labels = false) {
    if (value.is_object())
      for (const auto& [key, member] : value.items())
        add_from(member, std::find(keys.begin(), keys.end(), key) != keys.end());
    else if (value.is_array())
      for (const Json& member : value) add_from(member, names_labels);
    else if (names_labels && value.is_string())
      if (const auto found = descriptions_.find(value.get_ref<const std::string&>());
          found != descriptions_.end())
        names_.insert(*found);
  }
  const std::map<std::string, std::string>& names() const { return names_; }

 private:
  static constexpr std::array<std::string_view, 4> keys{"label", "labels", "missed", "undecided"};

  std::unordered_map<std::string, std::string> descriptions_;
  std::map<std::string, std::string> names_;
};

}  // namespace

std::string plan_json(const CertifiedPlan& plan, const SignalTable& table, std::span<const Label> labels,
                      bool has_values) {
  Json file = Record::write(plan, {table});
  if (!has_values)
    for (const char* key : {"values", "example"}) file.erase(key);
  if (plan.availability && plan.availability->has_answer())
    file["verification"] = "states";
  else if (plan.has_verdicts())
    file["verification"] = "certificate";
  NamesOfLabels of_labels(labels);
  of_labels.add_from(file);
  if (!of_labels.names().empty()) file["label_names"] = of_labels.names();
  return detail::file_text(file);
}

std::string with_values(const std::string& file, const CertifiedPlan& plan) {
  Json json = Json::parse(file);
  const SignalTable none;
  Json values = Json::array();
  for (const DecisiveValue& value : plan.values) values.push_back(Record::write(value, {none}));
  json["values"] = std::move(values);
  json.erase("example");
  if (plan.is_example) json["example"] = true;
  return detail::file_text(json);
}

std::string certificate_json(const Certificate& certificate, const SignalTable& table) {
  return detail::file_text(Record::write(certificate, {table}));
}

CertifiedPlan read_plan(const std::filesystem::path& path, const SignalTable& table) {
  auto plan = Record::read<CertifiedPlan>(detail::parse_placement(path), {table});
  if (plan.certificate)
    for (std::size_t i = 0; i < table.rows(); ++i)
      plan.certificate->labels[i].requirement = table.labels[i].requirement;
  return plan;
}

std::string availability_text(const Availability& availability, const SignalTable& table) {
  return Record::write(availability, {table}).dump(2) + '\n';
}

std::string availability_csv(const Availability& availability, const Scene& scene, bool safe) {
  std::string text = "id,required,states,missed,availability\n";
  const StateOutcome& outcome = availability.answer();
  for (std::size_t i = 0; i < scene.labels.size(); ++i)
    text += fmt::format("{},{},{},{},{}\n", csv_field(scene.labels[i].id, safe), availability.required[i],
                        outcome.states, outcome.missed[i], outcome.availability(i));
  return text;
}

std::string verification_csv(const Certificate& certificate, const Scene& scene, bool safe) {
  std::string text = "id,verdict,requirement,signal,standard_error,lower,upper,samples\n";
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    const LabelVerdict& label = certificate.labels[i];
    text += fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(scene.labels[i].id, safe),
                        to_text(label.verdict), label.requirement, label.signal, label.standard_error,
                        label.lower, label.upper, label.samples);
  }
  return text;
}

}  // namespace shelfbeam
