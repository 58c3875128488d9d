#include "shelfbeam/report/messages/difference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/availability.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string units_clause(const Words& words, const PlanDifference& difference) {
  const auto& [before, after] = difference.figures;
  if (!before.has_selection && !after.has_selection) return words.say("difference.units.no_selection");
  if (!before.has_selection) return words.say_count("difference.units.first_selection", after.units);
  if (!after.has_selection) return words.say_count("difference.units.lost_selection", before.units);
  if (after.units < before.units)
    return words.say_count("difference.units.fewer", before.units - after.units, words.grouped(after.units),
                           words.grouped(before.units));
  if (after.units > before.units)
    return words.say_count("difference.units.more", after.units - before.units, words.grouped(after.units),
                           words.grouped(before.units));
  const std::size_t other = difference.count(UnitChange::added) + difference.count(UnitChange::changed);
  if (other == 0) return words.say_count("difference.units.same", after.units);
  return other == after.units
             ? words.say_count("difference.units.elsewhere", after.units)
             : words.say("difference.units.some_elsewhere", words.grouped(after.units), words.grouped(other));
}

std::string price_clause(const Words& words, const PlanDifference& difference) {
  const auto& [before, after] = difference.figures;
  if (!before.price || !after.price || before.price->currency != after.price->currency ||
      before.price->to_spend == after.price->to_spend)
    return {};
  return words.say("difference.price", money(words, after.price->to_spend, after.price),
                   money(words, before.price->to_spend, before.price));
}

std::string labels_clause(const Words& words, const PlanDifference& difference) {
  const auto count = [&](LabelChange change) { return difference.count(change); };
  const std::size_t stay = count(LabelChange::stays_reached), gained = count(LabelChange::gained),
                    lost = count(LabelChange::lost), missed = count(LabelChange::stays_missed),
                    common = stay + gained + lost + missed;
  std::string clause;
  const auto add = [&](std::string text) { clause += (clause.empty() ? "" : ", ") + std::move(text); };
  if (common > 0)
    add(stay == common ? words.say_count("difference.labels.all", stay)
                       : words.say_count("difference.labels.some", common, words.grouped(stay)));
  if (gained > 0) add(words.say("difference.labels.gained", words.grouped(gained)));
  if (lost > 0) add(words.say("difference.labels.lost", words.grouped(lost)));
  if (missed > 0) add(words.say("difference.labels.missed", words.grouped(missed)));
  if (const std::size_t added = count(LabelChange::added); added > 0) {
    const auto reached =
        std::count_if(difference.labels.begin(), difference.labels.end(),
                      [](const ComparedLabel& label) { return !label.before && label.after->reached; });
    add(static_cast<std::size_t>(reached) == added
            ? words.say_count("difference.labels.new_reached", added)
            : words.say_count("difference.labels.new_some", added,
                              words.grouped(static_cast<std::uint64_t>(reached))));
  }
  if (const std::size_t removed = count(LabelChange::removed); removed > 0)
    add(words.say_count("difference.labels.gone", removed));
  return clause;
}

std::string certificate_text(const Words& words, const PlanFigures& figures) {
  std::string state = words.say(fmt::format("difference.certificate.{}", to_text(figures.certificate)),
                                words.grouped(figures.certified), words.grouped(figures.labels));
  if (figures.certificate == CertificateState::none) return state;
  if (figures.worst_availability && figures.certificate == CertificateState::open)
    return words.say("difference.certificate.open_states");
  return words.say("difference.certificate.with", state, words.confidence_text(figures.confidence));
}

std::string bound_text(const Words& words, const PlanFigures& figures, const Placement& placement) {
  const ValueBounds& bounds = figures.bounds;
  const bool is_certified = bounds.certified > 0;
  const double bound = is_certified ? bounds.certified : bounds.simulated;
  if (!(bound > 0) || !std::isfinite(bound)) return words.say("difference.bound.none");
  const bool is_price = placement.problem.combination == Combination::spend;
  const std::string value = !minimises_cost(placement.problem)
                                ? words.plain_down(bound)
                                : at_least(words, bound, is_price ? placement.price : std::nullopt);
  const bool is_enough = is_certified ? figures.certificate == CertificateState::certified
                                      : figures.has_selection && figures.reached == figures.labels;
  const bool is_minimum = is_enough && bounds.is_minimum(bound);
  if (is_certified)
    return words.say(is_minimum ? "difference.bound.certified_minimum" : "difference.bound.certified", value);
  return words.say(is_minimum ? "difference.bound.simulated_minimum" : "difference.bound.simulated", value);
}

std::string margin_text(const Words& words, const LabelState& label) {
  return words.decibels(margin_db(label.signal, label.requirement));
}

std::string goal_of(const Words& words, const Placement& placement) {
  if (!placement.partial) return words.say("difference.question.all");
  const auto& [goal, value, reached, max_reached] = *placement.partial;
  if (goal == ReachGoal::at_most)
    return words.say_count("difference.question.at_most", static_cast<std::uint64_t>(value));
  return goal == ReachGoal::share ? words.say("difference.question.part", words.percent(value))
                                  : words.say("difference.question.given");
}

std::string setting_text(const Words& words, QuestionKey key, const CertifiedPlan& plan) {
  const PlacementProblem& problem = plan.placement.problem;
  const auto none = [&] { return words.say("difference.question.none"); };
  switch (key) {
    case QuestionKey::model:
      return words.say(fmt::format("facts.placement.models.{}", to_text(problem.model)));
    case QuestionKey::survives_failure:
      return words.say(problem.redundant ? "difference.question.yes" : "difference.question.no");
    case QuestionKey::objective:
    case QuestionKey::combination:
      return objective_name(words, problem);
    case QuestionKey::share:
      return words.percent(problem.share, 0);
    case QuestionKey::min_spacing:
      return plan.placement.min_spacing > 0
                 ? words.say("drawing.metres", words.plain(plan.placement.min_spacing))
                 : none();
    case QuestionKey::forbidden_pairs:
      return words.grouped(plan.placement.forbidden_pairs);
    case QuestionKey::partial:
      return goal_of(words, plan.placement);
    case QuestionKey::confidence:
      return words.confidence_text(plan.availability ? plan.availability->confidence
                                                     : plan.certificate->confidence) +
             " %";
    case QuestionKey::availability_rule:
    case QuestionKey::availability_goal:
      return plan.availability ? goal_text(words, *plan.availability) : none();
  }
  return {};
}

void add_question(const Words& words, TextTable& table, const DifferenceInput& input) {
  std::set<std::vector<std::string>> said;  // two keys may share their text
  for (const QuestionKey key : input.difference.question) {
    std::vector<std::string> row{words.say(fmt::format("difference.question.key.{}", to_text(key))),
                                 setting_text(words, key, input.before.plan),
                                 setting_text(words, key, input.after.plan)};
    if (said.insert(row).second) table.push_back(std::move(row));
  }
}

std::vector<std::string> heading(const Words& words, const std::string& name) {
  return {name, words.say("difference.column.before"), words.say("difference.column.after")};
}

std::string unit_text(const Words& words, const TransceiverColumn& unit, bool has_axis, bool has_type) {
  std::string text = words.say("difference.unit.at", words.fixed(unit.position.x, 2),
                               words.fixed(unit.position.y, 2), words.fixed(unit.position.z, 2));
  if (has_axis)
    text += words.say("difference.unit.axis", words.fixed(unit.axis.x, 2), words.fixed(unit.axis.y, 2),
                      words.fixed(unit.axis.z, 2));
  return has_type ? text + words.say("difference.unit.type", unit.type) : text;
}

std::vector<std::string> label_row(const Words& words, const DifferenceInput& input,
                                   const ComparedLabel& label) {
  const auto text = [&](const std::optional<LabelState>& state) {
    return state ? margin_text(words, *state) : std::string("–");
  };
  return {label_name(input, label), text(label.before), text(label.after)};
}

double ratio_after(const ComparedLabel& label) {
  const LabelState& state = label.after ? *label.after : *label.before;
  return margin_db(state.signal, state.requirement);
}

TextTable label_table(const Words& words, const DifferenceInput& input,
                      std::vector<const ComparedLabel*> labels, std::size_t most) {
  std::stable_sort(labels.begin(), labels.end(),
                   [](const auto* a, const auto* b) { return ratio_after(*a) < ratio_after(*b); });
  TextTable table{heading(words, words.say("column.label"))};
  for (std::size_t k = 0; k < std::min(most, labels.size()); ++k)
    table.push_back(label_row(words, input, *labels[k]));
  return table;
}

// A JSON text for readers.
std::string value_text(std::string_view json) {
  constexpr std::size_t longest = 60;
  if (json.size() >= 2 && json.front() == '"')
    return printable(shortened(json.substr(1, json.size() - 2), longest));
  std::string text;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const bool ends_number =
        k + 2 >= json.size() || json[k + 2] == ',' || json[k + 2] == ']' || json[k + 2] == '}';
    if (json.substr(k, 2) == ".0" && ends_number)
      ++k;
    else
      text += json[k] == ',' ? ", " : std::string(1, json[k]);
  }
  return printable(shortened(text, longest));
}

std::string values_text(const Words& words, const std::vector<ValueChange>& values) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, values.size()); ++k) {
    const auto& [key, before, after] = values[k];
    text += text.empty() ? "" : ", ";
    if (before.empty())
      text += words.say("difference.store.key_added", key, value_text(after));
    else if (after.empty())
      text += words.say("difference.store.key_removed", key, value_text(before));
    else
      text += words.say("difference.store.key_changed", key, value_text(after), value_text(before));
  }
  return values.size() > most ? words.say_count("difference.store.more_keys", values.size() - most, text)
                              : text;
}

std::string ids_text(const Words& words, const std::vector<const StoreChange*>& changes) {
  constexpr std::size_t most = 4;
  std::vector<std::string> ids;
  ids.reserve(changes.size());
  for (const StoreChange* change : changes) {
    const bool is_renamed =
        !change->before_id.empty() && !change->after_id.empty() && change->before_id != change->after_id;
    std::string id = is_renamed ? words.say("difference.store.renamed", change->after_id, change->before_id)
                                : change->id();
    ids.push_back(change->description.empty() ? id : words.say("label.named", change->description, id));
  }
  const std::vector<std::string> ranges = id_ranges(ids);
  std::string text;
  for (std::size_t k = 0; k < std::min(most, ranges.size()); ++k)
    text += (text.empty() ? "" : ", ") + printable(ranges[k]);
  return ranges.size() > most ? words.say("summary.and_others", text) : text;
}

// Of one part and one kind. Equal values are named once, and more than a few different ones not at all.
void add_lines(const Words& words, std::vector<std::string>& lines,
               const std::vector<const StoreChange*>& changes) {
  constexpr std::size_t most_values = 3;
  const StoreChange& first = *changes.front();
  std::vector<std::vector<const StoreChange*>> groups;
  for (const StoreChange* change : changes) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      return group.front()->values == change->values;
    });
    if (same != groups.end())
      same->push_back(change);
    else if (groups.size() <= most_values)
      groups.push_back({change});
  }
  if (groups.size() > most_values) groups = {changes};
  const bool has_values =
      groups.size() == 1 ? groups.front().front()->values == changes.back()->values : true;
  for (const auto& group : groups) {
    const std::string part = words.say(fmt::format("difference.store.part.{}", to_text(first.part)));
    const bool has_elements = !first.id().empty();
    std::string line = has_elements ? words.say(fmt::format("difference.store.kind.{}", to_text(first.kind)),
                                                part, words.grouped(group.size()), ids_text(words, group))
                                    : words.say("difference.store.whole", part);
    const std::string values = has_values ? values_text(words, group.front()->values) : "";
    if (has_elements) line += values.empty() ? "" : ": " + values;
    lines.push_back(has_elements ? line : line + values);
  }
}

}  // namespace

std::string difference_answer(const Words& words, const DifferenceInput& input) {
  const PlanDifference& difference = input.difference;
  if (difference.is_empty()) return words.say("difference.none");
  std::string answer = units_clause(words, difference);
  for (const std::string& clause : {price_clause(words, difference), labels_clause(words, difference)})
    if (!clause.empty()) answer += "; " + clause;
  return answer + ".";
}

TextTable difference_figures(const Words& words, const DifferenceInput& input) {
  const PlanFigures &before = input.difference.figures.before, &after = input.difference.figures.after;
  TextTable table{heading(words, "")};
  const auto row = [&](const char* name, const auto& text) {
    table.push_back({words.say(fmt::format("difference.figure.{}", name)),
                     text(before, input.before.plan.placement), text(after, input.after.plan.placement)});
  };
  row("units", [&](const PlanFigures& figures, const auto&) {
    return figures.has_selection ? words.grouped(figures.units) : words.say("difference.figure.no_selection");
  });
  if (before.installed + after.installed > 0)
    row("installed",
        [&](const PlanFigures& figures, const auto&) { return words.grouped(figures.installed); });
  if (before.price || after.price)
    row("price", [&](const PlanFigures& figures, const auto&) {
      return figures.price ? money(words, figures.price->to_spend, figures.price)
                           : words.say("difference.figure.no_price");
    });
  row("labels", [&](const PlanFigures& figures, const auto&) {
    return words.say("facts.part", words.grouped(figures.reached), words.grouped(figures.labels));
  });
  if (before.worst_availability || after.worst_availability)
    row("availability", [&](const PlanFigures& figures, const auto&) {
      return figures.worst_availability ? words.percent(*figures.worst_availability) : std::string("–");
    });
  row("certificate",
      [&](const PlanFigures& figures, const auto&) { return certificate_text(words, figures); });
  row("bound", [&](const PlanFigures& figures, const Placement& placement) {
    return bound_text(words, figures, placement);
  });
  add_question(words, table, input);
  return table;
}

TextTable changed_units(const Words& words, const DifferenceInput& input) {
  TextTable table{heading(words, words.say("difference.column.unit"))};
  table.front().insert(table.front().begin(),
                       {words.say("difference.column.number"), words.say("difference.column.change")});
  for (const ComparedUnit& unit : input.difference.units) {
    if (unit.change == UnitChange::kept) continue;
    const TransceiverColumn* old = unit.before ? &input.before.transceivers[*unit.before] : nullptr;
    const TransceiverColumn* now = unit.after ? &input.after.transceivers[*unit.after] : nullptr;
    const bool has_axis = old && now && old->axis != now->axis,
               has_type = old && now && old->type != now->type;
    table.push_back({fmt::format("{}", table.size()),
                     words.say(fmt::format("difference.unit.{}", to_text(unit.change))),
                     (now ? now : old)->id, old ? unit_text(words, *old, has_axis, has_type) : "–",
                     now ? unit_text(words, *now, has_axis, has_type) : "–"});
  }
  return table;
}

std::string unit_counts(const Words& words, const PlanDifference& difference) {
  std::string text;
  for (const auto& [name, change] : names_of<UnitChange>)
    if (const std::size_t count = difference.count(change); count > 0)
      text += (text.empty() ? "" : ", ") +
              words.say(fmt::format("difference.unit.count.{}", name), words.grouped(count));
  return text;
}

const std::string& label_id(const DifferenceInput& input, const ComparedLabel& label) {
  return label.after ? input.after.labels[label.after->row].id : input.before.labels[label.before->row].id;
}

const std::string& label_name(const DifferenceInput& input, const ComparedLabel& label) {
  const ComparedPlan& plan = label.after ? input.after : input.before;
  const LabelId row = label.after ? label.after->row : label.before->row;
  return plan.label_names.empty() ? plan.labels[row].id : plan.label_names[row];
}

TextTable changed_labels(const Words& words, const DifferenceInput& input, LabelChange change,
                         std::size_t most) {
  std::vector<const ComparedLabel*> labels;
  for (const ComparedLabel& label : input.difference.labels)
    if (label.change() == change) labels.push_back(&label);
  return label_table(words, input, std::move(labels), most);
}

TextTable weakest_labels(const Words& words, const DifferenceInput& input) {
  const auto& [before, after] = input.difference.figures;
  const auto has = [](const std::vector<LabelId>& rows, const std::optional<LabelState>& label) {
    return label && std::find(rows.begin(), rows.end(), label->row) != rows.end();
  };
  std::vector<const ComparedLabel*> labels;
  for (const ComparedLabel& label : input.difference.labels)
    if (has(before.weakest, label.before) || has(after.weakest, label.after)) labels.push_back(&label);
  return label_table(words, input, std::move(labels), 2 * max_weakest);
}

std::string labels_heading(const Words& words, LabelChange change, std::size_t count, std::size_t most) {
  std::string heading = words.say_count(fmt::format("difference.label.{}", to_text(change)), count);
  return count > most ? words.say("difference.first_of", heading, most) : heading;
}

std::vector<std::string> store_lines(const Words& words, const PlanDifference& difference) {
  std::vector<std::string> lines;
  for (const auto& part : names_of<StorePart>)
    for (const auto& kind : names_of<StoreChangeKind>) {
      std::vector<const StoreChange*> changes;
      for (const StoreChange& change : difference.store)
        if (change.part == part.value && change.kind == kind.value) changes.push_back(&change);
      if (!changes.empty()) add_lines(words, lines, changes);
    }
  return lines;
}

}  // namespace shelfbeam
