#include "shelfbeam/placement/io/placement_file.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/answer/weak_spots.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/io/placement_json.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam {

namespace {

using detail::first_ids;
using detail::Json;
using detail::number;
using detail::position;
using detail::Positions;
using detail::positions;

// All keys, those of a plan included.
const std::initializer_list<std::string_view> keys = {
    "format",          "model",           "objective", "combination", "share",          "survives_failure",
    "min_spacing",     "forbidden_pairs", "labels",    "selected",    "count",          "count_lower_bound",
    "objective_value", "lower_bound",     "gap",       "bound_proof", "ties_settled",   "unit_costs",
    "redundant_share", "status",          "solver",    "backend",     "unreachable",    "scenarios",
    "critical",        "verification",    "price",     "curve",       "curve_complete", "certificate",
    "alternatives",    "sensitivity",     "states",    "warnings",    "complete",       "files",
    "total_weight",    "seconds"};
constexpr std::int64_t max_units = std::numeric_limits<std::uint32_t>::max();

// A lower bound on a count, as an integer without ".0".
Json whole_bound(double value) {
  constexpr double rounding = 1e-6;
  return std::isfinite(value) ? Json(static_cast<std::uint64_t>(std::max(0.0, std::ceil(value - rounding))))
                              : Json(nullptr);
}

std::vector<std::uint32_t> read_selected(const JsonCursor& cursor, const SignalTable& table) {
  const Positions known = positions(table.transceivers);
  std::vector<std::uint32_t> selected;
  std::vector<bool> seen(table.columns(), false);
  for (const JsonCursor& element : cursor.elements()) {
    selected.push_back(position(element, known, "transceiver"));
    if (seen[selected.back()])
      element.fail(fmt::format("is a duplicate {}", in_quotes(element.text())), "remove it");
    seen[selected.back()] = true;
  }
  if (const auto crowded = shared_mounts(table, seen); !crowded.empty()) {
    std::vector<std::string> ids;
    for (const std::uint32_t j : table.mounts[crowded.front()])
      if (seen[j]) ids.push_back(in_quotes(table.transceivers[j].id));
    cursor.fail(fmt::format("has {}, which are options of one mounting point", fmt::join(ids, " and ")),
                "keep one of them");
  }
  std::sort(selected.begin(), selected.end());
  return selected;
}

// Format 1 has one text: "greedy", "search with highs 1.10.0", or name and version of a MIP back end.
SolvedBy read_solver(const JsonCursor& file) {
  const JsonCursor solver = file["solver"];
  if (const auto backend = file.find("backend"))
    return {solver.choice<Method>(), backend->is_null() ? "" : backend->text()};
  const std::string text = solver.text();
  constexpr std::string_view helped = "search with ";
  if (text.empty()) return {};
  if (text.starts_with(helped)) return {Method::search, text.substr(helped.size())};
  const auto method = from_text<Method>(text);
  return method ? SolvedBy{*method} : SolvedBy{Method::mip, text};
}

std::vector<Unreachable> read_unreachable(const JsonCursor& cursor, const SignalTable& table) {
  const Positions known = positions(table.labels);
  std::vector<Unreachable> result;
  for (const JsonCursor& element : cursor.elements()) {
    element.expect_keys({"label", "requirement", "most"});
    result.push_back({position(element["label"], known, "label"), element["requirement"].positive(),
                      element["most"].non_negative()});
  }
  return result;
}

// Share of the labels that at least two selected units reach alone: "Redundant" of the paper's Table 3.1.
double redundant_share(const Placement& placement, const SignalTable& table) {
  if (table.rows() == 0) return 0;
  const Check check = check_selection(table, placement.problem, placement.selected);
  const auto redundant = std::count_if(check.serving.begin(), check.serving.end(),
                                       [](std::uint32_t units) { return units >= 2; });
  return static_cast<double>(redundant) / static_cast<double>(table.rows());
}

Json scenarios(const Placement& placement, const SignalTable& table) {
  Json result = Json::array();
  for (const ScenarioMargin& margin : scenario_margins(table, placement)) {
    const SignalTable::Scenario& scenario = table.scenarios[margin.scenario];
    result.push_back({{"name", scenario.name},
                      {"labels", scenario.labels},
                      {"smallest_margin", number(margin.smallest_margin)},
                      {"label", scenario.labels > 0 ? Json(table.labels[margin.label].id) : Json(nullptr)}});
  }
  return result;
}

Json critical(const Placement& placement, const SignalTable& table) {
  Json result = Json::array();
  for (const Critical& one : critical_units(table, placement.problem, placement.selected))
    result.push_back({{"unit", table.transceivers[one.unit].id},
                      {"count", one.labels.size()},
                      {"labels", first_ids(one.labels, table)}});
  return result;
}

Json curve_points(const std::vector<CurvePoint>& points) {
  Json result = Json::array();
  for (const CurvePoint& point : points) {
    result.push_back({{"units", point.units}, {"at_least", point.at_least}, {"at_most", point.at_most}});
    if (!point.weight) continue;
    result.back()["weight_at_least"] = point.weight->at_least;
    result.back()["weight_at_most"] = point.weight->at_most;
  }
  return result;
}

double total_weight(const SignalTable& table) {
  const detail::LabelWeights weights(table);
  return weights.in_table(weights.total());
}

}  // namespace

Json detail::placement_object(const Placement& placement, const SignalTable& table,
                              const CoverageCurve& curve) {
  Json unreachable = Json::array();
  for (const Unreachable& label : placement.unreachable)
    unreachable.push_back({{"label", table.labels[label.label].id},
                           {"requirement", label.requirement},
                           {"most", label.max_signal}});
  const PlacementProblem& problem = placement.problem;
  Json file = {{"format", format_version},
               {"model", to_text(problem.model)},
               {"objective", to_text(problem.objective)},
               {"combination", to_text(problem.combination)},
               {"share", problem.share},
               {"survives_failure", problem.redundant},
               {"min_spacing", placement.min_spacing > 0 ? Json(placement.min_spacing) : Json(nullptr)},
               {"forbidden_pairs", placement.forbidden_pairs},
               {"labels", table.rows()},
               {"selected", ids_of(table.transceivers, placement.selected)},
               {"count", placement.count()},
               {"count_lower_bound", whole_bound(placement.count_lower_bound)},
               {"objective_value", number(placement.objective_value)},
               {"lower_bound", number(placement.lower_bound)},
               {"gap", number(placement.gap())},
               {"bound_proof", to_text(placement.bound_proof)},
               {"ties_settled", placement.ties_settled},
               {"unit_costs", placement.unit_costs},
               {"redundant_share", redundant_share(placement, table)},
               {"status", to_text(placement.status)},
               {"solver", to_text(placement.solver.method)},
               {"backend", backend_of(placement.solver)},
               {"unreachable", unreachable},
               {"scenarios", scenarios(placement, table)},
               {"verification", "not verified yet"},
               {"critical", critical(placement, table)}};
  if (placement.price) file["price"] = detail::price_object(placement.price);
  if (!curve.points.empty()) {
    file["curve"] = curve_points(curve.points);
    file["curve_complete"] = curve.is_complete;
    if (curve.points.front().weight) file["total_weight"] = total_weight(table);
  }
  return file;
}

std::string placement_json(const Placement& placement, const SignalTable& table, const CoverageCurve& curve) {
  return detail::file_text(detail::placement_object(placement, table, curve));
}

Json detail::backend_of(const SolvedBy& solver) {
  return solver.backend.empty() ? Json(nullptr) : Json(solver.backend);
}

Placement detail::read_placement(const JsonCursor& file, const SignalTable& table) {
  if (const auto format = file["format"].integer(0, max_versions); format != oldest_format)
    expect_format_version(file.where(), format, format_version);
  file.expect_keys(keys);
  Placement placement;
  placement.problem.model = file["model"].choice<CommunicationModel>();
  placement.problem.objective = file["objective"].choice<Objective>();
  if (const auto found = file.find("combination"))
    placement.problem.combination = found->choice<Combination>();
  if (const auto found = file.find("share")) placement.problem.share = found->positive();
  if (const auto found = file.find("survives_failure")) placement.problem.redundant = found->boolean();
  if (const auto found = file.find("min_spacing"); found && !found->is_null())
    placement.min_spacing = found->positive();
  if (const auto found = file.find("forbidden_pairs"))
    placement.forbidden_pairs =
        static_cast<std::size_t>(found->integer(0, std::numeric_limits<std::int64_t>::max()));
  if (const auto found = file.find("labels"); found && found->number() != static_cast<double>(table.rows()))
    found->fail(fmt::format("is {}, but the matrix has {} labels", found->number(), table.rows()),
                "use the matrix that this placement was computed from");
  placement.selected = read_selected(file["selected"], table);
  placement.count_lower_bound = number_or_infinity(file["count_lower_bound"]);
  placement.objective_value = number_or_infinity(file["objective_value"]);
  placement.lower_bound = number_or_infinity(file["lower_bound"]);
  if (const auto found = file.find("bound_proof")) placement.bound_proof = found->choice<BoundProof>();
  if (const auto found = file.find("ties_settled")) placement.ties_settled = found->boolean();
  if (const auto found = file.find("price")) placement.price = detail::read_price(*found);
  if (const auto found = file.find("unit_costs")) placement.unit_costs = found->boolean();
  placement.status = file["status"].choice<Status>();
  placement.solver = read_solver(file);
  placement.unreachable = read_unreachable(file["unreachable"], table);
  if (const JsonCursor stated = file["count"]; stated.number() != static_cast<double>(placement.count()))
    stated.fail(fmt::format("is {}, but {} transceivers are selected", stated.number(), placement.count()),
                "correct one of them");
  return placement;
}

Placement read_placement(const std::filesystem::path& path, const SignalTable& table) {
  return detail::read_placement(JsonCursor::parse_file(path), table);
}

CoverageCurve detail::read_curve(const JsonCursor& file, const SignalTable& table) {
  CoverageCurve curve;
  const auto points = file.find("curve");
  if (!points) return curve;
  const auto labels = static_cast<std::int64_t>(table.rows());
  for (const JsonCursor& element : points->elements()) {
    element.expect_keys({"units", "at_least", "at_most", "weight_at_least", "weight_at_most"});
    const std::int64_t at_least = element["at_least"].integer(0, labels);
    const std::int64_t before =
        curve.points.empty() ? 0 : static_cast<std::int64_t>(curve.points.back().units);
    curve.points.push_back({static_cast<std::size_t>(element["units"].integer(before + 1, max_units)),
                            static_cast<std::size_t>(at_least),
                            static_cast<std::size_t>(element["at_most"].integer(at_least, labels))});
    if (const auto weight = element.find("weight_at_least"))
      curve.points.back().weight = {weight->non_negative(), element["weight_at_most"].non_negative()};
  }
  curve.is_complete = file["curve_complete"].boolean();
  return curve;
}

}  // namespace shelfbeam
