#include "serve/planning/plan_run.hpp"

#include <cmath>
#include <exception>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"

#include "jobs/event.hpp"
#include "jobs/plan_folder.hpp"

namespace shelfbeam::serve {

void PlanRun::fail(const std::exception& error) {
  state = RunState::failed;
  result = Json::parse(jobs::line_of(jobs::error_of(error)));
}

Json to_json(const PlanRun& run) {
  return {{"id", run.id},
          {"folder", run.folder},
          {"plan", run.plan},
          {"begun", run.begun},
          {"ended", run.ended},
          {"state", to_text(run.state)},
          {"shop", run.shop},
          {"written", run.written},
          {"continued", run.is_continued},
          {"entered", run.is_entered},
          {"cancelled", run.is_cancelled},
          {"first", run.first},
          {"result", run.result}};
}

PlanRun run_of(const Json& json) {
  PlanRun run;
  run.id = json.at("id");
  run.folder = json.at("folder");
  const std::filesystem::path folder = run.folder;
  if (run.folder.empty() || folder != folder.filename() || run.folder == "." || run.folder == "..")
    throw InputError("plans.json", "names a folder outside the project");
  run.plan = json.at("plan");
  run.begun = json.at("begun");
  run.ended = json.at("ended");
  run.state = from_text<RunState>(json.at("state").get<std::string>()).value_or(RunState::failed);
  run.shop = json.at("shop");
  run.written = json.at("written");
  run.is_continued = json.at("continued");
  run.is_entered = json.at("entered");
  run.is_cancelled = json.value("cancelled", false);
  run.first = json.at("first");
  run.result = json.at("result");
  return run;
}

void RunProgress::take_bounds(double new_incumbent, double new_bound, bool is_maximum) {
  constexpr double rounding = 1e-9;
  const double sign = is_maximum ? -1 : 1;
  // Where prices are minimised, they and then the numbers of units are reported.
  const bool is_count = std::abs(new_incumbent - static_cast<double>(selected.size())) < rounding;
  const bool is_other = std::exchange(counts_units, is_count) != is_count;
  const bool stays =
      bound && !is_other && sign * (*bound - new_bound) > 0 && sign * (new_incumbent - *bound) >= -rounding;
  incumbent = new_incumbent;
  if (!stays) bound = new_bound;
}

Json placement_in(const std::filesystem::path& folder) {
  constexpr std::uint64_t max_bytes = 512 << 20;
  // Objects keep the order of their keys, so that many names would take quadratic time.
  const auto is_kept = [](int depth, Json::parse_event_t event, const Json& value) {
    return depth != 1 || event != Json::parse_event_t::key || value != "label_names";
  };
  return Json::parse(read_file(folder / jobs::placement_name, max_bytes), is_kept);
}

Json result_in(const std::filesystem::path& folder) {
  try {
    const Json json = placement_in(folder);
    const auto certificate = json.find("certificate"), states = json.find("states");
    Json bound = json.at("count_lower_bound");
    if (certificate != json.end()) bound = certificate->at("count_lower_bound");
    if (states != json.end()) bound = states->at("lower_bound");
    const bool has_price = json.contains("price");
    return {{"event", "result"},
            {"complete", json.value("complete", true)},
            {"answer", ""},
            {"labels", json.at("labels")},
            {"units", json.at("count")},
            {"lower_bound", std::move(bound)},
            {"price", has_price ? json["price"].at("new") : Json()},
            {"currency", has_price ? json["price"].at("currency") : Json()},
            {"selected", json.at("selected")}};
  } catch (const std::exception&) {  // of somebody else, or being written
    return nullptr;
  }
}

std::string shop_hash(const Json& store) {
  Json shop = store;
  shop.erase("confirmed");
  if (const auto units = shop.find("transceivers"); units != shop.end() && units->is_object())
    units->erase("selected");
  return content_hash(shop.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace shelfbeam::serve
