#include "shelfbeam/plan/io/plan_file.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/io/placement_json.hpp"
#include "shelfbeam/plan/io/availability_json.hpp"
#include "shelfbeam/plan/io/end_reason_json.hpp"
#include "shelfbeam/plan/io/sensitivity_json.hpp"

namespace shelfbeam {

namespace {

using detail::Json;
using detail::position;
using detail::Positions;
using detail::positions;

Json ids_of(const Certificate& certificate, Verdict verdict, const SignalTable& table) {
  Json list = Json::array();
  for (std::size_t i = 0; i < certificate.labels.size(); ++i)
    if (certificate.labels[i].verdict == verdict) list.push_back(table.labels[i].id);
  return list;
}

Json to_json(const Certificate& certificate, const SignalTable& table) {
  return {{"confidence", certificate.confidence},
          {"covers", "sampling error"},
          {"assumes", "materials, stock and mounting as in the store file"},
          {"reached", certificate.none_verified() ? Json() : Json(certificate.count(Verdict::reached))},
          {"missed", ids_of(certificate, Verdict::missed, table)},
          {"undecided", ids_of(certificate, Verdict::undecided, table)},
          {"not_verified_yet", ids_of(certificate, Verdict::unverified, table)},
          {"count_lower_bound", certificate.count_lower_bound},
          {"cost_lower_bound", certificate.cost_lower_bound},
          {"bound_labels", certificate.bound_labels},
          {"rounds", certificate.rounds},
          {"open", detail::to_json(certificate.open)}};
}

// Reads verdicts only: verification.csv contains signals and limits.
Certificate read_certificate(const JsonCursor& cursor, const SignalTable& table) {
  cursor.expect_keys({"confidence", "covers", "assumes", "reached", "missed", "undecided", "not_verified_yet",
                      "count_lower_bound", "cost_lower_bound", "bound_labels", "rounds", "seconds", "open"});
  Certificate certificate;
  certificate.confidence = cursor["confidence"].positive();
  certificate.labels.resize(table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    certificate.labels[i].requirement = table.labels[i].requirement;
    certificate.labels[i].verdict = Verdict::reached;
  }
  const Positions known = positions(table.labels);
  // Plans of version 0.2.0 and earlier call labels without samples undecided.
  for (const auto& [key, verdict] :
       {std::pair("missed", Verdict::missed), std::pair("undecided", Verdict::undecided),
        std::pair("not_verified_yet", Verdict::unverified)})
    if (const auto list = verdict == Verdict::unverified ? cursor.find(key) : cursor[key])
      for (const JsonCursor& element : list->elements())
        certificate.labels[position(element, known, "label")].verdict = verdict;
  const auto count = [&](const char* key) {
    return static_cast<std::uint32_t>(cursor[key].integer(0, std::numeric_limits<std::uint32_t>::max()));
  };
  certificate.count_lower_bound = count("count_lower_bound");
  // Plans of version 0.2.0 and earlier have no bound on the cost.
  if (const auto cost = cursor.find("cost_lower_bound")) certificate.cost_lower_bound = cost->non_negative();
  certificate.bound_labels = count("bound_labels");
  certificate.rounds = count("rounds");
  certificate.open = detail::read_end_reason(cursor["open"]);
  const JsonCursor stated = cursor["reached"];
  if (!stated.is_null() && stated.number() != static_cast<double>(certificate.count(Verdict::reached)))
    stated.fail("is not the number of labels that none of the lists names", "correct one of them");
  return certificate;
}

}  // namespace

std::string plan_json(const CertifiedPlan& plan, const SignalTable& table) {
  Json file = detail::placement_object(plan.placement, table, plan.curve);
  if (plan.certificate && !plan.certificate->none_verified()) file["verification"] = "certificate";
  if (plan.certificate) file["certificate"] = to_json(*plan.certificate, table);
  if (plan.availability) {
    if (plan.availability->has_answer()) file["verification"] = "states";
    file["states"] = detail::availability_object(*plan.availability, table);
  }
  if (!plan.alternatives.empty())
    file["alternatives"] = detail::alternatives_object(plan.alternatives, table);
  if (plan.sensitivity) file["sensitivity"] = detail::sensitivity_object(*plan.sensitivity, table);
  if (!plan.warnings.empty()) file["warnings"] = plan.warnings;
  return detail::file_text(file);
}

std::string certificate_json(const Certificate& certificate, const SignalTable& table) {
  return detail::file_text(to_json(certificate, table));
}

CertifiedPlan read_plan(const std::filesystem::path& path, const SignalTable& table) {
  const JsonCursor file = JsonCursor::parse_file(path);
  CertifiedPlan plan;
  plan.placement = detail::read_placement(file, table);
  plan.curve = detail::read_curve(file, table);
  if (const auto found = file.find("certificate")) plan.certificate = read_certificate(*found, table);
  if (const auto found = file.find("states")) plan.availability = detail::read_availability(*found, table);
  if (const auto found = file.find("alternatives"))
    plan.alternatives = detail::read_alternatives(*found, table);
  if (const auto found = file.find("sensitivity")) plan.sensitivity = detail::read_sensitivity(*found, table);
  // Plans of version 0.2.0 and earlier have no warnings.
  if (const auto found = file.find("warnings"))
    for (const JsonCursor& warning : found->elements()) plan.warnings.push_back(warning.text());
  return plan;
}

std::string availability_text(const Availability& availability, const SignalTable& table) {
  return detail::availability_object(availability, table).dump(2) + '\n';
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
