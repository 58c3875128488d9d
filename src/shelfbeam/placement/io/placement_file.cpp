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
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/answer/weak_spots.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/io/placement_json.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam {

namespace {

using detail::first_ids;
using detail::Ids;
using detail::Json;
using detail::number;
using detail::Record;
using detail::TableIds;

constexpr std::int64_t max_units = std::numeric_limits<std::uint32_t>::max();

// A lower bound on a count, as an integer without ".0".
Json whole_bound(double value) {
  constexpr double rounding = 1e-6;
  return std::isfinite(value) ? Json(static_cast<std::uint64_t>(std::max(0.0, std::ceil(value - rounding))))
                              : Json(nullptr);
}

// Units that were given may share a mounting point.
Selection read_selected(const JsonCursor& cursor, const Ids& ids, const SignalTable& table, bool is_given) {
  std::vector<bool> seen(table.columns(), false);
  for (const JsonCursor& element : cursor.elements()) {
    const std::uint32_t j = ids.position(element);
    if (seen[j]) element.fail(fmt::format("is a duplicate {}", in_quotes(element.text())), "remove it");
    seen[j] = true;
  }
  if (const auto crowded = shared_mounts(table, seen); !crowded.empty() && !is_given) {
    std::vector<std::string> options;
    for (const ColumnId j : table.mounts[crowded.front()])
      if (seen[j]) options.push_back(in_quotes(table.transceivers[j].id));
    cursor.fail(fmt::format("has {}, which are options of one mounting point", fmt::join(options, " and ")),
                "keep one of them");
  }
  return numbers_where<ColumnId>(seen);
}

// Format 1 has one text: "greedy", "search with highs 1.10.0", or name and version of a MIP back end.
SolvedBy read_solver(const JsonCursor& file) {
  const JsonCursor solver = file["solver"];
  if (const auto backend = file.find("backend"))
    return {solver.choice<Method>(), backend->is_null() ? std::nullopt : std::optional(backend->text())};
  const std::string text = solver.text();
  constexpr std::string_view helped = "search with ";
  if (text.empty()) return {};
  if (text.starts_with(helped)) return {Method::search, text.substr(helped.size())};
  const auto method = from_text<Method>(text);
  return method ? SolvedBy{*method} : SolvedBy{Method::mip, text};
}

// Share of the labels that at least two selected units reach alone: "Redundant" of the paper's Table 3.1.
double redundant_share(const Placement& placement, const SignalTable& table) {
  if (table.rows() == 0) return 0;
  const Check check = check_selection(table, placement.problem, placement.selected);
  const auto redundant = std::ranges::count_if(check.serving, [](std::uint32_t units) { return units >= 2; });
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

Json critical(const Placement& placement, const TableIds& ids) {
  const SignalTable& table = ids.table;
  Json result = Json::array();
  for (const Critical& one : critical_units(table, placement.problem, placement.selected))
    result.push_back({{"unit", ids.transceivers[one.unit]},
                      {"count", one.labels.size()},
                      {"labels", first_ids(one.labels, ids.labels)}});
  return result;
}

double total_weight(const SignalTable& table) {
  const detail::LabelWeights weights(table);
  return weights.in_table(weights.total());
}

// Throws InputError where the file states other numbers.
void expect_numbers(const JsonCursor& file, const Placement& placement, const SignalTable& table) {
  if (const auto found = file.find("labels"); found && found->number() != static_cast<double>(table.rows()))
    found->fail(fmt::format("is {}, but the matrix has {} labels", found->number(), table.rows()),
                "use the matrix that this placement was computed from");
  if (const JsonCursor stated = file["count"]; stated.number() != static_cast<double>(placement.count()))
    stated.fail(fmt::format("is {}, but {} transceivers are selected", stated.number(), placement.count()),
                "correct one of them");
}

}  // namespace

namespace detail {

JsonCursor parse_placement(const std::filesystem::path& path) {
  JsonCursor file = JsonCursor::parse_file(path);
  if (const auto format = file["format"].integer(0, max_versions); format != oldest_format)
    expect_format_version(file.where(), format, format_version);
  return file;
}

void describe(Record& record, Price& price) {
  record.custom(
      "currency", [&] { return price.currency.empty() ? Json(nullptr) : Json(price.currency); },
      [&](const JsonCursor& json) {
        if (!json.is_null()) price.currency = json.text();
      });
  record.non_negative("total", price.total);
  record.non_negative("new", price.to_spend);
}

void describe(Record& record, Unreachable& one) {
  record.id("label", one.label, record.ids().labels);
  record.positive("requirement", one.requirement);
  record.non_negative("most", one.max_signal);
}

void describe(Record& record, PartialReach& partial) {
  record.name("goal", partial.goal);
  record.non_negative("value", partial.value);
  record.count("reached", partial.reached);
  record.count("reached_upper_bound", partial.max_reached);
}

void describe(Record& record, Placement& placement) {
  const TableIds& ids = record.ids();
  const SignalTable& table = ids.table;
  PlacementProblem& problem = placement.problem;
  record.note("format", [] { return format_version; });
  record.name("model", problem.model);
  record.name("objective", problem.objective);
  record.later().name("combination", problem.combination);
  record.later().positive("share", problem.share);
  record.later().boolean("survives_failure", problem.redundant);
  record.later().custom(
      "min_spacing", [&] { return placement.min_spacing > 0 ? Json(placement.min_spacing) : Json(nullptr); },
      [&](const JsonCursor& json) {
        if (!json.is_null()) placement.min_spacing = json.positive();
      });
  record.later().count("forbidden_pairs", placement.forbidden_pairs,
                       std::numeric_limits<std::int64_t>::max());
  record.optional("partial", placement.partial);
  record.note("labels", [&] { return table.rows(); });
  record.custom(
      "selected", [&] { return ids.transceivers.list(placement.selected); },
      [&](const JsonCursor& json) {
        const bool is_given = placement.partial && placement.partial->goal == ReachGoal::given;
        placement.selected = read_selected(json, ids.transceivers, table, is_given);
      });
  record.note("count", [&] { return placement.count(); });
  if (record.file() != nullptr) expect_numbers(*record.file(), placement, table);
  record.number("count_lower_bound", placement.count_lower_bound, whole_bound);
  record.number("objective_value", placement.objective_value);
  record.number("lower_bound", placement.lower_bound);
  record.note("gap", [&] { return number(placement.gap()); });
  record.later().name("bound_proof", placement.bound_proof);
  record.later().boolean("ties_settled", placement.ties_settled);
  record.later().boolean("unit_costs", placement.unit_costs);
  record.note("redundant_share", [&] { return redundant_share(placement, table); });
  record.name("status", placement.status);
  record.custom(
      "solver", [&] { return to_text(placement.solver.method); },
      [&](const JsonCursor&) { placement.solver = read_solver(*record.file()); });
  record.note("backend", [&] { return backend_of(placement.solver); });
  record.list("unreachable", placement.unreachable);
  record.note("scenarios", [&] { return scenarios(placement, table); });
  record.note("verification", [] { return "not verified yet"; });
  record.note("critical", [&] { return critical(placement, ids); });
  if (record.has("price", placement.price.has_value())) record.nullable("price", placement.price);
  record.ignore({"curve", "curve_complete", "certificate", "alternatives", "sensitivity", "states",
                 "warnings", "label_names", "values", "example", "seed", "complete", "files", "total_weight",
                 "steps", "seconds"});
}

void describe(Record& record, CoverageCurve& curve) {
  const SignalTable& table = record.ids().table;
  const auto labels = static_cast<std::int64_t>(table.rows());
  const auto describe_point = [&](Record& part, CurvePoint& point) {
    const std::size_t before = curve.points.empty() ? 0 : curve.points.back().units;
    part.count("units", point.units, max_units, static_cast<std::int64_t>(before) + 1);
    part.count("at_least", point.at_least, labels);
    part.count("at_most", point.at_most, labels, static_cast<std::int64_t>(point.at_least));
    if (!part.has("weight_at_least", point.weight.has_value())) return;
    if (!point.weight) point.weight.emplace();
    part.non_negative("weight_at_least", point.weight->at_least);
    part.non_negative("weight_at_most", point.weight->at_most);
  };
  if (!record.has("curve", !curve.points.empty())) return;
  record.list("curve", curve.points, describe_point);
  record.boolean("curve_complete", curve.is_complete);
  if (record.has("total_weight", !curve.points.empty() && curve.points.front().weight))
    record.note("total_weight", [&] { return total_weight(table); });
}

}  // namespace detail

std::string placement_json(const Placement& placement, const SignalTable& table, const CoverageCurve& curve) {
  CoverageCurve points = curve;
  const auto with_curve = [&](Record& record, Placement& value) {
    detail::describe(record, value);
    detail::describe(record, points);
  };
  return detail::file_text(Record::write(placement, {table}, with_curve));
}

std::string steps_json(std::span<const SearchStep> steps) {
  std::string text;
  for (const SearchStep& step : steps)
    text += (text.empty() ? "\n    " : ",\n    ") + Json({{"name", step.name},
                                                          {"seconds", step.seconds},
                                                          {"value_before", number(step.value_before)},
                                                          {"value", number(step.value)},
                                                          {"bound_before", number(step.bound_before)},
                                                          {"bound", number(step.bound)}})
                                                        .dump();
  return text.empty() ? "[]" : fmt::format("[{}\n  ]", text);
}

Placement read_placement(const std::filesystem::path& path, const SignalTable& table) {
  return Record::read<Placement>(detail::parse_placement(path), {table});
}

Selection read_selection(const std::filesystem::path& path, const SignalTable& table) {
  const TableIds ids{table};
  return read_selected(detail::parse_placement(path)["selected"], ids.transceivers, table, false);
}

}  // namespace shelfbeam
