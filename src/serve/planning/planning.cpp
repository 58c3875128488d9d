#include "serve/planning/planning.hpp"

#include <algorithm>
#include <exception>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/messages/known_values.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "jobs/plan_folder.hpp"
#include "serve/file_document.hpp"
#include "serve/live/newest_plan.hpp"
#include "serve/planning/plan_states.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

// With its progress. Pages know units by their numbers.
Json for_page(const PlanRun& run, const Draft& draft) {
  Json json = to_json(run);
  if (!run.is_active()) return json;
  const RunProgress& now = run.progress;
  const std::unordered_set<std::string_view> ids(now.selected.begin(), now.selected.end());
  Json units = Json::array();
  if (!ids.empty())
    for (std::size_t j = 0; j < draft.scene.transceivers.size(); ++j)
      if (ids.contains(draft.scene.transceivers[j].id)) units.push_back(j);
  json["progress"] = {{"task", now.task},
                      {"detail", now.detail},
                      {"share", or_null(now.share)},
                      {"seconds_left", or_null(now.seconds_left)},
                      {"incumbent", or_null(now.incumbent)},
                      {"bound", or_null(now.bound)},
                      {"count", ids.size()},
                      {"units", std::move(units)}};
  return json;
}

}  // namespace

Planning::Planning(fs::path folder, std::string program)
    : folder_(std::move(folder)), runs_(folder_, std::move(program)) {}

const std::string& Planning::shop(const Json& store, std::uint64_t revision) {
  if (revision != revision_) {
    shop_ = shop_hash(store);
    revision_ = revision;
  }
  return shop_;
}

std::optional<Json> Planning::answer(const Request& request, const Json& store, const Draft& draft) {
  const std::string verb = request.text("do");
  if (verb == "plan") {
    if (draft.scene.labels.empty() || draft.scene.transceivers.empty())
      throw InputError("the shop", "has no labels or no candidates yet", "add them first");
    return Json{{"plan", runs_.add(request.json.value("plan", Json::object()), shop_hash(store))}};
  }
  if (verb == "plan_cancel") return runs_.cancel(request.number("plan")), Json::object();
  if (verb == "plan_forget") return runs_.forget(request.number("plan")), Json::object();
  if (verb == "plan_details") return details(runs_.at(request.number("plan")), draft);
  if (verb == "plan_states") {
    const PlanRun& run = runs_.at(request.number("plan"));
    return states_of_plan(folder_ / run.folder, placement_of(run), draft);
  }
  return {};
}

Json Planning::placement_of(const PlanRun& run) const {
  if (!is_plain_file(folder_ / run.folder / jobs::placement_name))
    throw InputError(run.folder, "has no plan", "start another plan");
  try {
    return placement_in(folder_ / run.folder);
  } catch (const Json::exception&) {
    throw InputError(run.folder, "has a placement.json that is not valid", "start another plan");
  }
}

namespace {

// How well the values of a plan are known, by its placement.json; empty for a file of another version.
std::string basis_in(const Json& placement) try {
  CertifiedPlan plan;
  for (const Json& value : placement.value("values", Json::array()))
    plan.values.push_back({from_text<ValueKind>(value.at("value").get<std::string>()).value(), value.at("of"),
                           from_text<ValueState>(value.at("state").get<std::string>()).value(),
                           value.at("amount")});
  plan.is_example = placement.value("example", false);
  bool is_certified = placement.at("count") != 0;
  if (const auto states = placement.find("states"); states != placement.end())
    is_certified = is_certified && states->at("certified") == true;
  else if (const auto found = placement.find("certificate"); found != placement.end())
    is_certified = is_certified && found->at("reached") == placement.at("labels");
  else
    is_certified = false;
  return basis_of(english(), plan, is_certified);
} catch (const std::exception&) {
  return {};
}

}  // namespace

// Its placement.json, and the numbers of the labels in its lists, as far as the shop has them now.
Json Planning::details(const PlanRun& run, const Draft& draft) const {
  Json plan = placement_of(run);
  for (const char* key : {"files", "sensitivity", "scenarios"}) plan.erase(key);
  const LabelNumbers numbers(draft);
  Json labels = Json::object();
  const auto ids_of = [](const Json& list) {
    Json ids = Json::array();
    for (const Json& one : list) ids.push_back(one.is_object() ? one.at("label") : one);
    return ids;
  };
  const auto add = [&](const Json& part, const char* key) {
    if (const auto found = part.find(key); found != part.end())
      labels[key] = numbers.with_ids(ids_of(*found));
  };
  add(plan, "unreachable");
  if (const auto found = plan.find("certificate"); found != plan.end())
    for (const char* key : {"missed", "undecided", "not_verified_yet"}) add(*found, key);
  if (const auto found = plan.find("states"); found != plan.end())
    for (const char* key : {"lost", "responsible"}) add(*found, key);
  std::string basis = basis_in(plan);
  return {{"details", std::move(plan)}, {"labels", std::move(labels)}, {"basis", std::move(basis)}};
}

Planning::Selection Planning::selection(std::uint64_t id, const std::string& alternative, const Json& store,
                                        const Draft& draft) const {
  const PlanRun& run = runs_.at(id);
  const Json selected =
      alternative.empty() ? run.selected() : placement_of(run)["alternatives"][alternative]["selected"];
  if (selected.empty()) throw InputError("plan", "has chosen no units", "start another plan");
  std::unordered_map<std::string_view, const Transceiver*> units;
  for (const Transceiver& unit : draft.scene.transceivers) units.emplace(unit.id, &unit);
  Json chosen = Json::array();
  for (const Json& one : selected) {
    const auto found = units.find(one.get_ref<const std::string&>());
    if (found == units.end())
      throw InputError(run.folder,
                       fmt::format("has a unit {}, which the shop does not have any more",
                                   in_quotes(one.get<std::string>())),
                       "plan the shop again");
    if (!found->second->installed && !found->second->pinned) chosen.push_back(one);
  }
  Selection result{fmt::format("{}: {}", run.folder, counted(selected.size(), "unit")), {}};
  const auto transceivers = store.find("transceivers");
  EditOp op{"/transceivers/selected", {}, chosen};
  if (transceivers == store.end()) {
    op = {"/transceivers", {}, Json{{"selected", chosen}}};
  } else if (const auto old = transceivers->find("selected"); old != transceivers->end()) {
    op.before = *old;
  }
  result.ops.push_back(std::move(op));
  return result;
}

Json Planning::everything(const Json& store, const Draft& draft, std::uint64_t revision) {
  Json list = Json::array();
  for (const PlanRun& run : runs_.all()) list.push_back(for_page(run, draft));
  return {{"event", "plans"}, {"all", std::move(list)}, {"shop", shop(store, revision)}};
}

Planning::News Planning::poll(const Json& store, const Draft& draft, std::uint64_t revision) {
  News news;
  const std::vector<std::uint64_t> changed =
      runs_.poll([&]() -> const std::string& { return shop(store, revision); });
  news.is_previewing = std::any_of(runs_.all().begin(), runs_.all().end(),
                                   [](const PlanRun& run) { return run.state == RunState::previewing; });
  for (const std::uint64_t id : runs_.take_finished())
    if (runs_.at(id).shop == shop(store, revision)) news.to_enter.push_back(id);
  // A shop may be large, so that its hash is told a moment after a change.
  constexpr auto pause = std::chrono::seconds(1);
  const bool has_plans = !runs_.all().empty();
  if (has_plans && revision_ != revision && Clock::now() - hashed_ >= pause) {
    hashed_ = Clock::now();
    shop(store, revision);
  }
  const bool is_other_shop = has_plans && shop_ != told_shop_;
  if (!changed.empty() || is_other_shop) {
    Json event{{"event", "plans"}, {"set", Json::array()}, {"remove", Json::array()}};
    for (const std::uint64_t id : changed)
      if (const PlanRun* run = runs_.find(id))
        event["set"].push_back(for_page(*run, draft));
      else
        event["remove"].push_back(id);
    if (is_other_shop) event["shop"] = told_shop_ = shop_;
    news.event = std::move(event);
  }
  return news;
}

std::optional<http::Document> Planning::document(std::string_view name) const {
  constexpr std::string_view plans = "plans/";
  if (!name.starts_with(plans)) return {};
  name.remove_prefix(plans.size());
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos) return {};
  const std::string file(name.substr(slash + 1));
  const auto& names = jobs::plan_file_names;
  const auto run = std::find_if(runs_.all().begin(), runs_.all().end(), [&](const PlanRun& one) {
    return fmt::format("{}", one.id) == name.substr(0, slash);
  });
  std::error_code ignored;
  if (run == runs_.all().end() || file == jobs::signal_name ||
      std::find(names.begin(), names.end(), file) == names.end() ||
      fs::symlink_status(folder_ / run->folder, ignored).type() != fs::file_type::directory)
    return {};
  return document_of(folder_ / run->folder / file, file == jobs::report_name);
}

}  // namespace shelfbeam::serve
