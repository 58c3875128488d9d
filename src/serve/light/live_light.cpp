#include "serve/light/live_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <sys/stat.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/plan/store/given_units.hpp"
#include "shelfbeam/report/viewer/page_data.hpp"
#include "shelfbeam/scene/build/nearest_mount.hpp"
#include "shelfbeam/scene/light_keys.hpp"

#include "jobs/preview/light_frame.hpp"
#include "jobs/preview/preview_job.hpp"
#include "serve/live/unit_edits.hpp"

namespace shelfbeam::serve {

namespace {

namespace fs = std::filesystem;
using jobs::LightStage;

constexpr auto quiet = std::chrono::milliseconds(300);
constexpr auto sweep_interval = std::chrono::seconds(1);
constexpr std::size_t most_bytes = std::size_t{32} << 20;  // of columns that are kept, for undo
constexpr std::size_t most_at_once = 4;                    // units that are previewed between two requests
constexpr int most_tries = 3;                              // of fine columns, to see how long they take

http::Message requirements_of(const Scene& scene, std::uint64_t generation) {
  std::vector<float> requirements;
  for (const Label& label : scene.labels)
    requirements.push_back(static_cast<float>(scene.requirement_of(label)));
  PageData page;
  page.add("requirement", requirements);
  return http::Message::binary(
      page.binary(nlohmann::ordered_json{{"event", "requirements"}, {"generation", generation}}.dump()));
}

PointedAt pointed_at(const LiveLight::Json& request) {
  const auto& at = request.at("at");
  PointedAt point{{at.at(0).get<double>(), at.at(1).get<double>()}, {}};
  if (at.size() > 2) point.z = at.at(2).get<double>();
  return point;
}

struct Mounted {
  Transceiver unit;
  MountPlace place;
};

// The unit of a request `mount` or `drag`, where it would be mounted.
Mounted mounted(const LiveLight::Json& request, const Draft& draft) {
  Mounted result;
  const PointedAt at = pointed_at(request);
  if (request.contains("unit") && !request["unit"].is_null()) {
    result.unit = unit_numbered(draft, request["unit"].get<std::size_t>());
    change_unit(request, draft, result.unit);
    result.place = moved_mount(draft.store, draft.scene, result.unit, at);
  } else {
    result.place = nearest_mount(draft.store, draft.scene, at, request.value("reach", 0.0));
    result.unit.axis = result.place.axis;
    change_unit(request, draft, result.unit);
    result.place.axis = result.unit.axis;
  }
  result.unit.position = result.place.position;
  result.unit.axis = result.place.axis;
  return result;
}

void add_place(LiveLight::Json& json, const Mounted& mounted) {
  const auto& [unit, place] = mounted;
  json["position"] = {unit.position.x, unit.position.y, unit.position.z};
  json["axis"] = {unit.axis.x, unit.axis.y, unit.axis.z};
  json["roll_deg"] = unit.roll_deg;
  json["on"] = to_text(place.on);
  json["name"] = place.name;
}

}  // namespace

LiveLight::LiveLight(fs::path folder, bool is_on, std::string program)
    : folder_(std::move(folder)),
      keep_(folder_ / ".shelfbeam"),
      is_on_(is_on),
      child_(std::move(program)),
      plan_(folder_) {}

void LiveLight::change(const std::string& text, std::uint64_t revision, const Draft& draft,
                       bool changes_light, Clock::time_point now) {
  text_ = text;
  revision_ = revision;
  message_.clear();
  const std::vector<std::string> before = keys();
  list_units(draft);
  has_labels_ = !draft.scene.labels.empty();
  if (changes_light) {
    ++generation_;
    columns_.clear();
    light_.forget();
    fine_tries_ = 0;
    fine_ms_ = HUGE_VAL;
    child_.stop();
    operator_ = nullptr;
    requirements_ = requirements_of(draft.scene, generation_);
    news_.push_back(requirements_);
  }
  if (changes_light || before != keys()) {
    undecided_ = progress_ = nullptr;
    phase_ = has_labels_ ? "waiting" : "none";
    // Work on an operator goes on: it serves any units.
    if (!child_.is_running() || operator_ == "fine") {
      child_.stop();
      start_at_ = is_on_ && has_labels_ ? std::optional(now + quiet) : std::nullopt;
    }
  }
  baseline_ = plan_.json(draft.scene);
}

void LiveLight::list_units(const Draft& draft) {
  units_.clear();
  const auto& all = draft.scene.transceivers;
  std::vector<Transceiver> chosen;
  for (const std::uint32_t j : chosen_units(draft.scene)) {
    units_.push_back({j, all[j].id, {}});
    chosen.push_back(all[j]);
  }
  const std::vector<std::uint64_t> keys = light_keys_of(draft.scene, chosen);
  for (std::size_t k = 0; k < units_.size(); ++k) units_[k].key = jobs::unit_key(keys[k]);
}

std::vector<std::string> LiveLight::keys() const {
  std::vector<std::string> list;
  for (const Unit& unit : units_) list.push_back(unit.key);
  return list;
}

void LiveLight::preview_new_units(const Draft& draft) {
  const LoadedLight::Ready* const best = light_.best();
  if (best == nullptr || !holds_.empty()) return;
  std::size_t count = 0;
  for (const Unit& unit : units_) {
    if (columns_.contains(unit.key) || ++count > most_at_once) continue;
    const Preview column = best->light.column(draft.scene.transceivers[unit.index]);
    keep(unit.key, http::Message::binary(jobs::column_frame({{"event", "column"},
                                                             {"generation", generation_},
                                                             {"unit", unit.key},
                                                             {"stage", to_text(best->stage)},
                                                             {"batches", 0}},
                                                            column)));
  }
}

void LiveLight::keep(const std::string& key, http::Message message) {
  if (columns_.size() * message.bytes->size() >= most_bytes && !columns_.contains(key))
    std::erase_if(columns_, [&](const auto& column) {
      return std::none_of(units_.begin(), units_.end(),
                          [&](const Unit& unit) { return unit.key == column.first; });
    });
  news_.push_back(message);
  columns_.insert_or_assign(key, std::move(message));
}

LoadedLight::Source LiveLight::source(LightStage stage) const {
  return {.name = "store.json",
          .text = text_,
          .folder = folder_,
          .file = keep_ / (stage == LightStage::coarse ? jobs::coarse_operator_name : jobs::operator_name),
          .stage = stage};
}

void LiveLight::start() {
  ::mkdir(keep_.c_str(), S_IRWXU);
  jobs::LightJob job{.generation = generation_, .text = text_, .folder = folder_, .keep = keep_};
  for (const Unit& unit : units_)
    if (const auto found = columns_.find(unit.key); found != columns_.end())
      job.known.push_back(*found->second.bytes);
  child_.start(job);
  started_ = keys();
  is_paused_ = false;
  phase_ = "preparing";
}

void LiveLight::take(std::string frame) {
  const Json about = jobs::about_of(frame);
  if (about.at("event") == "column") {
    if (about.at("generation") == generation_)
      keep(about.at("unit").get<std::string>(), http::Message::binary(std::move(frame)));
    return;
  }
  const Json& kind = about.at("operator");
  if (kind != operator_ && !kind.is_null()) {
    light_.load(source(LightStage::coarse));  // also beside the fine one: drags may need it
    if (kind == "fine") light_.load(source(LightStage::fine));
  }
  operator_ = kind;
  progress_ = about.at("progress");
  if (started_ != keys()) return;  // it is about other units
  phase_ = about.at("phase").get<std::string>();
  undecided_ = about.at("undecided");
}

std::vector<http::Message> LiveLight::poll(const Draft& draft, Clock::time_point now) {
  if (now - looked_ >= sweep_interval) {
    looked_ = now;
    plan_.look();
    baseline_ = plan_.json(draft.scene);
  }
  if (holds_.empty()) light_.poll();
  if (resume_at_ && now >= *resume_at_ && holds_.empty()) {
    resume_at_.reset();
    is_paused_ = false;
    child_.resume();
  }
  if (start_at_ && now >= *start_at_ && holds_.empty() && !is_paused_) {
    start_at_.reset();
    start();
  }
  std::string failure;
  for (std::string& frame : child_.poll(failure)) take(std::move(frame));
  if (!failure.empty()) {
    phase_ = "failed";
    message_ = failure;
    progress_ = nullptr;
  }
  // The units may have changed while the operator was made; the process may have ended by then.
  const bool is_free = !child_.is_running() || operator_ == "fine";
  if (is_on_ && has_labels_ && is_free && !start_at_ && started_ != keys()) {
    child_.stop();
    start_at_ = now;
  }
  return messages(draft);
}

std::vector<http::Message> LiveLight::messages(const Draft& draft) {
  preview_new_units(draft);
  Json now = state();
  std::vector<http::Message> list;
  if (now != told_) {
    told_ = std::move(now);
    list.push_back(http::Message::text(told_.dump(-1, ' ', false, Json::error_handler_t::replace)));
  }
  list.insert(list.end(), news_.begin(), news_.end());
  news_.clear();
  return list;
}

LiveLight::Json LiveLight::state() const {
  Json units = Json::array();
  for (const Unit& unit : units_)
    units.push_back({{"index", unit.index}, {"id", unit.id}, {"key", unit.key}});
  const bool is_none = !has_labels_ || (units_.empty() && phase_ == "done");
  Json json{{"event", "light"},
            {"generation", generation_},
            {"revision", revision_},
            {"units", std::move(units)},
            {"phase", !is_on_   ? "off"
                      : is_none ? "none"
                                : phase_},
            {"operator", light_.best() == nullptr ? Json() : Json(to_text(light_.best()->stage))},
            {"undecided", undecided_},
            {"progress", progress_},
            {"baseline", baseline_}};
  if (!message_.empty()) json["message"] = message_;
  return json;
}

std::vector<http::Message> LiveLight::everything() const {
  std::vector<http::Message> list;
  list.push_back(http::Message::text(state().dump(-1, ' ', false, Json::error_handler_t::replace)));
  if (requirements_.bytes) list.push_back(requirements_);
  // Also those of units that an undo may bring back.
  for (const auto& [key, column] : columns_) list.push_back(column);
  return list;
}

void LiveLight::hold(http::TabId tab) {
  holds_.insert(tab);
  resume_at_.reset();
  is_paused_ = true;
  child_.pause();
  fine_tries_ = std::min(fine_tries_, most_tries - 1);
}

void LiveLight::release(http::TabId tab, Clock::time_point now) {
  if (holds_.erase(tab) > 0 && holds_.empty()) resume_at_ = now + quiet;
}

LiveLight::Json LiveLight::mount(const Json& request, const Draft& draft) {
  Json place;
  add_place(place, mounted(request, draft));
  return {{"mount", std::move(place)}};
}

http::Message LiveLight::drag(const Json& request, const Draft& draft) {
  constexpr double most_ms = 35;  // so that labels follow the pointer
  const bool is_slow = fine_tries_ >= most_tries && fine_ms_ > most_ms;
  const LoadedLight::Ready* const light = is_slow ? light_.fastest() : light_.best();
  if (light == nullptr && !light_.failure().empty())
    throw InputError("drag", "needs the light of the shop, which cannot be read", light_.failure());
  if (light == nullptr)
    throw InputError("drag", "needs the light of the shop, which is not computed yet", "wait a moment");
  const Mounted moved = mounted(request, draft);
  const auto begin = Clock::now();
  const Preview column = light->light.column(moved.unit);
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  if (light->stage == LightStage::fine) {
    ++fine_tries_;
    fine_ms_ = std::min(fine_ms_, ms);
  }
  Json about{{"event", "drag"}, {"id", request.at("id")}, {"generation", generation_}};
  add_place(about, moved);
  about["stage"] = to_text(light->stage);
  about["column_ms"] = ms;
  return http::Message::binary(jobs::column_frame(about, column));
}

}  // namespace shelfbeam::serve
