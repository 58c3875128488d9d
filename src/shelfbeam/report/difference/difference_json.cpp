#include "shelfbeam/report/difference/difference_json.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/report/data/outcome.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <class T>
Json if_given(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json vector_json(const Vec3& vector) {
  return {vector.x, vector.y, vector.z};
}

Json unit_json(const TransceiverColumn& unit) {
  return {{"id", unit.id},
          {"position", vector_json(unit.position)},
          {"axis", vector_json(unit.axis)},
          {"type", unit.type}};
}

Json units_json(const DifferenceInput& input) {
  Json units = {{"kept", Json::array()},
                {"changed", Json::array()},
                {"added", Json::array()},
                {"removed", Json::array()}};
  for (const ComparedUnit& unit : input.difference.units) {
    const auto old = [&] { return unit_json(input.before.transceivers[*unit.before]); };
    const auto now = [&] { return unit_json(input.after.transceivers[*unit.after]); };
    const bool is_pair = unit.before && unit.after;
    Json both;
    if (is_pair) both = {{"before", old()}, {"after", now()}};
    units[std::string(to_text(unit.change))].push_back(is_pair ? both : unit.after ? now() : old());
  }
  return units;
}

Json state_json(const std::optional<LabelState>& label) {
  if (!label) return nullptr;
  Json state = {{"reached", label->reached},
                {"margin_db", number(margin_db(label->signal, label->requirement))}};
  if (label->availability) state["availability"] = *label->availability;
  return state;
}

Json label_json(const DifferenceInput& input, const ComparedLabel& label) {
  const std::string& id = label_id(input, label);
  Json json = {{"id", id}};
  if (const std::string& name = label_name(input, label); name != id) json["name"] = name;
  if (label.before && label.after)
    if (const std::string& id_before = input.before.labels[label.before->row].id; id_before != id)
      json["id_before"] = id_before;
  json["before"] = state_json(label.before);
  json["after"] = state_json(label.after);
  return json;
}

Json labels_json(const DifferenceInput& input) {
  const PlanDifference& difference = input.difference;
  Json labels = {{"stays_reached", difference.count(LabelChange::stays_reached)}};
  for (const auto& [name, change] : names_of<LabelChange>) {
    if (change == LabelChange::stays_reached) continue;
    Json list = Json::array();
    for (const ComparedLabel& label : difference.labels)
      if (label.change() == change) list.push_back(label_json(input, label));
    labels[std::string(name)] = std::move(list);
  }
  return labels;
}

Json figures_json(const PlanFigures& figures, const ComparedPlan& plan) {
  Json weakest = Json::array();
  for (const LabelId row : figures.weakest)
    weakest.push_back({{"id", plan.labels[row].id},
                       {"margin_db", number(margin_db(plan.signals[row], plan.labels[row].requirement))}});
  return {{"has_selection", figures.has_selection},
          {"units", figures.units},
          {"installed", figures.installed},
          {"to_spend", figures.price ? Json(figures.price->to_spend) : Json(nullptr)},
          {"price", figures.price ? Json(figures.price->total) : Json(nullptr)},
          {"currency",
           figures.price && !figures.price->currency.empty() ? Json(figures.price->currency) : Json(nullptr)},
          {"labels", figures.labels},
          {"reached", figures.reached},
          {"worst_availability", if_given(figures.worst_availability)},
          {"certificate", to_text(figures.certificate)},
          {"confidence",
           figures.certificate == CertificateState::none ? Json(nullptr) : Json(figures.confidence)},
          {"certified", figures.certified},
          {"value", number(figures.bounds.value)},
          {"simulated_lower_bound", number(figures.bounds.simulated)},
          {"certified_lower_bound", number(figures.bounds.certified)},
          {"weakest", weakest}};
}

Json setting_json(QuestionKey key, const CertifiedPlan& plan) {
  const PlacementProblem& problem = plan.placement.problem;
  switch (key) {
    case QuestionKey::model:
      return to_text(problem.model);
    case QuestionKey::survives_failure:
      return problem.redundant;
    case QuestionKey::objective:
      return to_text(problem.objective);
    case QuestionKey::combination:
      return to_text(problem.combination);
    case QuestionKey::share:
      return problem.share;
    case QuestionKey::min_spacing:
      return plan.placement.min_spacing > 0 ? Json(plan.placement.min_spacing) : Json(nullptr);
    case QuestionKey::forbidden_pairs:
      return plan.placement.forbidden_pairs;
    case QuestionKey::partial:
      if (!plan.placement.partial) return nullptr;
      return {{"goal", to_text(plan.placement.partial->goal)}, {"value", plan.placement.partial->value}};
    case QuestionKey::confidence:
      return plan.availability ? plan.availability->confidence : plan.certificate->confidence;
    case QuestionKey::availability_rule:
      return plan.availability ? Json(to_text(plan.availability->goal.rule)) : Json(nullptr);
    case QuestionKey::availability_goal:
      return plan.availability ? if_given(plan.availability->goal.value) : Json(nullptr);
  }
  return nullptr;
}

Json question_json(const DifferenceInput& input) {
  Json question = Json::array();
  for (const QuestionKey key : input.difference.question)
    question.push_back({{"key", to_text(key)},
                        {"before", setting_json(key, input.before.plan)},
                        {"after", setting_json(key, input.after.plan)}});
  return question;
}

// Meshes and tables are omitted.
Json value_json(const std::string& text) {
  constexpr std::size_t longest = 2000;
  return text.empty() || text.size() > longest ? Json(nullptr) : Json::parse(text);
}

Json store_json(const std::vector<StoreChange>& store) {
  Json changes = Json::array();
  for (const StoreChange& change : store) {
    Json json = {{"part", to_text(change.part)}, {"change", to_text(change.kind)}};
    if (!change.id().empty()) json["id"] = change.id();
    if (!change.before_id.empty() && change.before_id != change.id()) json["id_before"] = change.before_id;
    if (!change.description.empty()) json["description"] = change.description;
    if (!change.values.empty()) json["values"] = Json::array();
    for (const auto& [key, before, after] : change.values)
      json["values"].push_back({{"key", key}, {"before", value_json(before)}, {"after", value_json(after)}});
    changes.push_back(std::move(json));
  }
  return changes;
}

}  // namespace

Json difference_json(const DifferenceInput& input) {
  const PlanDifference& difference = input.difference;
  return {{"differs", !difference.is_empty()},
          {"before", figures_json(difference.figures.before, input.before)},
          {"after", figures_json(difference.figures.after, input.after)},
          {"units", units_json(input)},
          {"labels", labels_json(input)},
          {"question", question_json(input)},
          {"store", store_json(difference.store)}};
}

}  // namespace shelfbeam
