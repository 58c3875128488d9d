#include "serve/planner.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/files/open_file.hpp"
#include "shelfbeam/base/provenance.hpp"

#include "serve/errands/errands.hpp"
#include "serve/events.hpp"
#include "serve/http/gate.hpp"
#include "serve/http/server.hpp"
#include "serve/light/live_light.hpp"
#include "serve/live/file_facts.hpp"
#include "serve/live/shop.hpp"
#include "serve/live/unit_edits.hpp"
#include "serve/live/values.hpp"
#include "serve/live/warning_finder.hpp"
#include "serve/planning/planning.hpp"
#include "serve/project/project.hpp"
#include "serve/project/project_file.hpp"
#include "serve/project/starter.hpp"
#include "serve/project/vendor_catalogue.hpp"
#include "serve/request.hpp"
#include "serve/text/edit.hpp"

namespace shelfbeam::embedded {

// The files of the page: name, media type, and the content in gzip format.
extern const std::span<const std::array<std::string_view, 3>> planner_files;

}  // namespace shelfbeam::embedded

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

using http::TabId;

constexpr auto tick = std::chrono::milliseconds(100);
constexpr auto look_interval = std::chrono::seconds(1);

// The folder, with a shop.
fs::path with_store(fs::path folder) {
  start_project(folder);
  return folder;
}

ProjectOptions project_options() {
  ProjectOptions options;
  options.check = [](const Json& store) {
    if (const auto format = store.find("format"); format != store.end() && format->is_number_integer())
      expect_format_version("store.json: format", format->get<std::int64_t>(), store_format_version);
  };
  return options;
}

}  // namespace

struct Planner::State {
  State(const std::function<fs::path()>& make_folder, http::Options options, const CancelToken& token,
        std::function<void(std::string_view)> log, bool has_light, const std::vector<fs::path>& catalogues)
      : cancel(token),
        server(with_page(std::move(options)), handlers(std::move(log))),
        folder(with_store(make_folder())),
        folder_name(fs::weakly_canonical(folder).filename().string()),
        project(folder, project_options()),
        shop((folder / "store.json").lexically_normal(), &token),
        warnings((folder / "store.json").lexically_normal()),
        light(folder, has_light),
        planning(folder),
        errands(folder) {
    for (const fs::path& catalogue : catalogues) add_catalogue(catalogue, folder, project);
    resolve();
    steps = project.steps();
    problems = shop.problems();
    names = shop.names();
    values = values_of(shop.draft());
    products = products_of(shop.draft());
  }

  static http::Options with_page(http::Options options) {
    for (const auto& [file, type, content] : embedded::planner_files)
      options.assets.emplace(file == "index.html" ? "" : file,
                             http::Asset(std::string(type), std::string(content)));
    options.tick = tick;
    options.limits.upload = max_file_bytes;
    // A new page is sent the columns of all units, of 9 bytes per label; all pages share the bytes.
    options.limits.queue = std::size_t{256} << 20;
    return options;
  }

  http::Handlers handlers(std::function<void(std::string_view)> log) {
    return {.opened = [this](TabId tab) { open(tab); },
            .text = [this](TabId tab, std::string_view text) { or_stop([&] { answer(tab, text); }); },
            .closed =
                [this](TabId tab) {
                  tabs.erase(tab);
                  light.release(tab, LiveLight::Clock::now());
                },
            .get = [this](std::string_view file) { return document(file); },
            .spool =
                [this] {
                  Descriptor file = open_unnamed(folder / ".shelfbeam");
                  if (!file.is_open()) cannot_write("the file", system_reason());
                  return file;
                },
            .put = [this](std::string_view file, std::string_view content) { return keep(file, content); },
            .tick = [this] { or_stop([&] { look(); }); },
            .failed = std::move(log)};
  }

  template <class Work>
  void or_stop(const Work& work) {
    try {
      work();
    } catch (const Interrupted&) {
      server.stop();
    }
  }

  void open(TabId tab) {
    tabs.insert(tab);
    Json json{{"event", "project"},
              {"tab", tab},
              {"name", name_of_shop(shop.json(), folder_name)},
              {"file", "store.json"},
              {"version", program_version()},
              {"unit", to_text(shop.draft().store.unit)},
              {"parts", shop.parts()}};
    json["problems"] = shop.problems();
    json["shared"] = shop.names();
    json["values"] = values_of(shop.draft());
    json["products"] = products_of(shop.draft());
    add_state(json, project, project.steps());
    server.send(tab, http::Message::text(with_document(json, shop.json())));
    if (shop.label_count() > 0) server.send(tab, http::Message::binary(shop.labels(project.revision())));
    if (shop.unit_count() > 0) server.send(tab, http::Message::binary(shop.units(project.revision())));
    for (const http::Message& message : light.everything()) server.send(tab, message);
    server.send(tab, http::Message::text(
                         text_of(planning.everything(shop.json(), shop.draft(), project.revision()))));
    if (found) server.send(tab, http::Message::text(text_of(warnings_json())));
  }

  Json warnings_json() const {
    Json list = *found;
    for (Json& one : list) shop.locate(one);
    return {{"event", "warnings"}, {"revision", project.revision()}, {"warnings", std::move(list)}};
  }

  void send_to_all(const http::Message& message) {
    for (const TabId tab : tabs) server.send(tab, message);
  }
  void send_to_all(const std::vector<http::Message>& messages) {
    for (const http::Message& message : messages) send_to_all(message);
  }

  void answer(TabId tab, std::string_view text) {
    Request request{tab, message_of(text)};
    if (!request.json.is_object() || !request.json.contains("id")) return;
    Json reply{{"id", request.json["id"]}};
    bool is_done = false;
    try {
      if (errands.begin(request, planning.runs())) {  // the answer comes later
        if (request.text("do") == "plan_report") planning.note_renewed(request.number("plan"));
        return;
      }
      if (request.text("do") == "drag") return server.send(tab, light.drag(request.json, shop.draft()));
      reply.update(result_of(request));
      is_done = true;
    } catch (const InputError& error) {
      reply["error"] = error_json(error);
      ops.reset();
    } catch (const Json::exception&) {  // a value of another kind
      reply["error"] = {{"message", "this planner does not know the request; reload the page"}};
      ops.reset();
    }
    // A refused edit may have found an outside change.
    tell_changes(is_done ? std::optional(std::move(request)) : std::nullopt);
    server.send(tab, http::Message::text(text_of(reply)));
  }

  Json result_of(const Request& request) {
    const std::string verb = request.text("do");
    if (verb == "details") return shop.details(request.text("path"));
    if (verb == "presets") return {{"presets", shop.presets()}};
    if (verb == "find") return {{"hits", shop.find(request.text("text"))}};
    if (verb == "device") return device(request);
    if (verb == "mount") return LiveLight::mount(request.json, shop.draft());
    if (verb == "hold") return light.hold(request.tab), Json::object();
    if (verb == "release") return light.release(request.tab, LiveLight::Clock::now()), Json::object();
    if (verb == "facts") return facts_of_file(folder, request.text("file"), shop.limits());
    if (auto result = planning.answer(request, shop.json(), shop.draft())) return std::move(*result);
    ops.reset();
    if (verb == "edit") {
      edit(request, request.ops());
    } else if (verb == "dissolve") {
      edit(request, shop.dissolved(request.text("path")));
    } else if (verb == "unit") {
      UnitEdit change = unit_edit(request.json, shop.json(), shop.draft());
      edit(request, std::move(change.ops));
      return {{"revision", project.revision()}, {"units", change.ids}};
    } else if (verb == "plan_enter") {
      enter(request.number("plan"), request.json.value("alternative", ""));
    } else if (verb == "undo") {
      project.undo();
    } else if (verb == "redo") {
      project.redo();
    } else if (verb == "go") {
      project.go(request.number("position"));
    } else if (verb == "restore") {
      project.restore_mine();
    } else {
      throw InputError("do", "is '" + verb + "', which this planner does not know", "reload the page");
    }
    return {{"revision", project.revision()}};
  }

  void edit(const Request& request, std::vector<EditOp> list) {
    if (project.edit(request.text("label"), list, request.json.value("join", false))) ops = std::move(list);
  }

  // Selects the units of a plan, or of one of its alternatives.
  void enter(std::uint64_t plan, const std::string& alternative = {}) {
    Planning::Selection selection = planning.selection(plan, alternative, shop.json(), shop.draft());
    if (project.edit(selection.label, selection.ops)) ops = std::move(selection.ops);
    planning.note_entered(plan);
  }

  Json device(const Request& request) const {
    const std::size_t index = request.number("index");
    const bool is_label = request.text("kind") == "label";
    if (index >= (is_label ? shop.label_count() : shop.unit_count()))
      throw InputError("index", "is too large", "reload the page");
    return {{"device", is_label ? shop.label(index) : shop.unit(index)}};
  }

  ShopChanges resolve() {
    ShopChanges changes = shop.update(project.text(), project.revision());
    revision = project.revision();
    light.change(project.text(), revision, shop.draft(), changes.changes_light, LiveLight::Clock::now());
    found.reset();
    warnings.restart(WarningFinder::Clock::now());
    return changes;
  }

  // Sends the changes since the last message. `request` or the end of a plan may have caused them.
  void tell_changes(const std::optional<Request>& request, std::optional<std::uint64_t> plan = {}) {
    if (revision == project.revision() && locked == project.locked()) return;
    // The operations describe the change only if nothing else has changed.
    const bool is_edit = ops && request && project.revision() == revision + 1;
    const ShopChanges changes = revision == project.revision() ? ShopChanges{} : resolve();
    locked = project.locked();
    Json json{{"event", "changed"}};
    if (request) json.update({{"tab", request->tab}, {"request", request->json["id"]}});
    if (plan) json["plan"] = *plan;
    if (is_edit) json["ops"] = json_of(*ops);
    json["unit"] = to_text(shop.draft().store.unit);
    json["parts"] =
        changes.parts.is_null() ? Json{{"set", Json::array()}, {"remove", Json::array()}} : changes.parts;
    const auto add_new = [&](const char* key, Json value, Json& sent) {
      if (value == sent) return;
      json[key] = value;
      sent = std::move(value);
    };
    add_new("problems", shop.problems(), problems);
    add_new("shared", shop.names(), names);
    add_new("values", values_of(shop.draft()), values);
    add_new("products", products_of(shop.draft()), products);
    std::vector<Step> all = project.steps();
    add_state(json, project, all,
              static_cast<std::size_t>(std::ranges::mismatch(steps, all).in1 - steps.begin()));
    steps = std::move(all);
    ops.reset();
    send_to_all(http::Message::text(is_edit ? text_of(json) : with_document(json, shop.json())));
    if (changes.labels) send_to_all(http::Message::binary(*changes.labels));
    if (changes.units) send_to_all(http::Message::binary(*changes.units));
    send_to_all(light.messages(shop.draft()));
  }

  http::Receipt keep(std::string_view file, std::string_view content) const {
    file.remove_prefix(http::file_names.size());
    try {
      return {true, text_of(keep_with_facts(folder, file, content, shop.limits()))};
    } catch (const InputError& error) {
      return {false, error.what()};
    }
  }

  std::optional<http::Document> document(std::string_view file) {
    if (file.starts_with(http::file_names)) {
      auto kept = stored_file(folder, file.substr(http::file_names.size()));
      if (!kept) return {};
      return http::Document{std::string(kept->type),
                            std::make_shared<const std::string>(std::move(kept->content))};
    }
    if (auto of_plan = planning.document(file)) return of_plan;
    if (auto of_errand = errands.document(file)) return of_errand;
    if (file != "scene") return {};
    if (!scene || scene_revision != project.revision()) {
      scene.reset();
      try {
        scene = std::make_shared<const std::string>(shop.scene(project.revision()));
      } catch (const InputError&) {  // too large to be shown
        return {};
      } catch (const Interrupted&) {
        return {};
      }
      scene_revision = project.revision();
    }
    return http::Document{"application/octet-stream", scene};
  }

  void follow_plans() {
    const Planning::News news = planning.poll(shop.json(), shop.draft(), project.revision());
    // Light waits for a first answer, which needs all processors for some seconds.
    constexpr TabId of_plans = 0;
    if (news.is_previewing && !is_previewing) light.hold(of_plans);
    if (!news.is_previewing && is_previewing) light.release(of_plans, LiveLight::Clock::now());
    is_previewing = news.is_previewing;
    if (news.event) send_to_all(http::Message::text(text_of(*news.event)));
    for (const std::uint64_t plan : news.to_enter) {
      try {
        enter(plan);
      } catch (const InputError&) {
        continue;  // the store is locked: pages offer it
      }
      tell_changes({}, plan);
    }
  }

  void look() {
    if (cancel.requested()) return server.stop();
    const auto now = WarningFinder::Clock::now();
    if (now - last_look >= look_interval) {
      last_look = now;
      project.check_outside();
      tell_changes({});
    }
    send_to_all(light.poll(shop.draft(), now));
    follow_plans();
    for (const LateReply& reply : errands.poll())
      server.send(reply.tab, http::Message::text(text_of(reply.message)));
    if (auto list = warnings.poll(now)) {
      // A store with problems cannot be inspected: the problems say why.
      found = shop.problems().empty() ? std::move(*list) : Json::array();
      send_to_all(http::Message::text(text_of(warnings_json())));
    }
  }

  const CancelToken& cancel;
  http::Server server;
  const fs::path folder;
  std::string folder_name;
  Project project;
  Shop shop;
  WarningFinder warnings;
  LiveLight light;
  Planning planning;
  Errands errands;
  std::set<TabId> tabs;
  std::uint64_t revision = 0;  // of the shop
  // As the pages know them.
  std::optional<std::string> locked;
  std::vector<Step> steps;
  Json problems, names, values, products;

  std::optional<std::vector<EditOp>> ops;  // of the edit that is being answered
  std::optional<Json> found;               // warnings about the present text
  WarningFinder::Clock::time_point last_look{};
  std::shared_ptr<const std::string> scene;  // with surfaces, of a revision
  std::uint64_t scene_revision = 0;
  bool is_previewing = false;
};

bool has_page() {
  return !embedded::planner_files.empty();
}

Planner::Planner(const std::function<fs::path()>& make_folder, http::Options options,
                 const CancelToken& cancel, std::function<void(std::string_view)> log, bool has_light,
                 const std::vector<fs::path>& catalogues)
    : state_(std::make_unique<State>(make_folder, std::move(options), cancel, std::move(log), has_light,
                                     catalogues)) {}

Planner::~Planner() = default;

std::vector<std::string> Planner::addresses() const {
  return state_->server.addresses();
}

void Planner::run() {
  state_->server.run();
}

}  // namespace shelfbeam::serve
