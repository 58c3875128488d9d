#include "serve/live/unit_edits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/length_unit.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/read_values.hpp"

#include "serve/live/place.hpp"

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char *list_key = "list", *pinned = "pinned", *selected = "selected", *installed = "installed",
                     *excluded = "excluded";

struct Mark {
  const char *action, *list, *state;
};
constexpr auto marks = std::to_array<Mark>({{"switch", selected, "selected"},
                                            {"pin", pinned, "pinned"},
                                            {"exclude", excluded, "excluded"},
                                            {"install", installed, "installed"}});

constexpr double least_power = 1e-3, most_power = 1e3;  // times the usual one, as in stores

[[noreturn]] void refuse(const std::string& id, const std::string& why, const std::string& remedy) {
  throw InputError(id.empty() ? "unit" : in_quotes(id), why, remedy);
}

// A number without digits that no person gives.
double tidy(double value, double per_unit) {
  const double rounded = std::round(value * per_unit) / per_unit;
  return rounded == 0 ? 0 : rounded;  // not -0
}

Vec3 vector_of(const Json& json, const char* key) {
  const Json& list = json.at(key);
  if (!list.is_array() || list.size() != 3) throw InputError(key, "is not a list of three numbers");
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

// The key "transceivers", and the operations that change it.
class UnitLists {
 public:
  explicit UnitLists(const Json& store) : section_(store.value("transceivers", Json::object())) {
    if (!store.contains("transceivers")) ops.push_back({"/transceivers", {}, Json::object()});
    if (!section_.is_object()) section_ = Json::object();
  }

  // Whether a list names a unit, and not only by a pattern.
  bool names(const char* key, const std::string& id) const { return position(key, id).has_value(); }

  void add(const char* key, const std::string& id) {
    if (!names(key, id)) append(key, id);
  }
  void remove(const char* key, const std::string& id) {
    const auto at = position(key, id);
    if (!at) return;
    Json& list = section_[key];
    ops.push_back({fmt::format("/transceivers/{}/{}", key, *at), list[*at], {}});
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(*at));
  }
  // Only a pattern can still match it then.
  void remove(const char* key, const std::string& id, const char* state) {
    remove(key, id);
    for (const Json& pattern : section_.value(key, Json::array()))
      if (pattern.is_string() && matches_glob(id, pattern.get_ref<const std::string&>()))
        refuse(id, fmt::format("is {} by the pattern {}", state, in_quotes(pattern.get<std::string>())),
               fmt::format("change transceivers.{}", key));
  }

  void append(const char* key, Json value) {
    Json& list = section_[key];
    if (list.is_null()) {
      list = Json::array({value});
      ops.push_back({fmt::format("/transceivers/{}", key), {}, list});
      return;
    }
    if (!list.is_array())
      throw InputError("transceivers.list", "is a file, to which the planner adds no units",
                       "list the units in the store file, or move the file to 'grids' or 'areas'");
    ops.push_back({fmt::format("/transceivers/{}/{}", key, list.size()), {}, value});
    list.push_back(std::move(value));
  }
  void replace(std::size_t entry, Json value) {
    Json& old = section_[list_key][entry];
    if (value == old) return;
    ops.push_back({fmt::format("/transceivers/{}/{}", list_key, entry), old, value});
    old = std::move(value);
  }
  void erase_later(std::size_t entry) { erased_.insert(entry); }
  // From the last one, so that the numbers of the others stay.
  void erase() {
    Json& list = section_[list_key];
    for (auto entry = erased_.rbegin(); entry != erased_.rend(); ++entry) {
      ops.push_back({fmt::format("/transceivers/{}/{}", list_key, *entry), list[*entry], {}});
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(*entry));
    }
  }
  const Json& entry(std::size_t k) const { return section_.at(list_key).at(k); }

  std::vector<EditOp> ops;

 private:
  std::optional<std::size_t> position(const char* key, const std::string& id) const {
    const auto list = section_.find(key);
    if (list == section_.end() || !list->is_array()) return {};
    const auto found = std::find(list->begin(), list->end(), id);
    if (found == list->end()) return {};
    return static_cast<std::size_t>(found - list->begin());
  }

  Json section_;
  std::set<std::size_t> erased_;
};

// Ids that no unit of the draft has.
class FreeIds {
 public:
  explicit FreeIds(const Draft& draft) {
    for (const auto* units : {&draft.scene.transceivers, &draft.scene.excluded})
      for (const Transceiver& unit : *units) taken_.insert(unit.id);
  }

  std::string next() {
    std::string id;
    do {
      id = fmt::format("U{}", ++last_);
    } while (taken_.contains(id));
    return id;
  }

 private:
  std::set<std::string> taken_;
  int last_ = 0;
};

// A request for one unit.
class Action {
 public:
  Action(const Json& request, const Draft& draft, UnitLists& lists, FreeIds& free_ids)
      : request_(request),
        draft_(draft),
        lists_(lists),
        free_ids_(free_ids),
        factor_(to_metres(1, draft.store.unit)) {}

  // Returns the id of the unit afterwards.
  std::string apply(const std::string& name, bool is_one_of_many) {
    if (name == "place") {
      place();
    } else {
      find(is_one_of_many);
      if (name == "change")
        change();
      else if (name == "remove")
        remove();
      else
        mark(name, request_.at("on").get<bool>());
    }
    return id_;
  }

 private:
  // The id of a request that is not one of many is that of the message.
  void find(bool is_one_of_many) {
    index_ = request_.at("index").get<std::size_t>();
    unit_ = unit_numbered(draft_, index_);
    id_ = unit_.id;
    if (is_one_of_many && request_.value("id", id_) != id_)
      refuse(request_["id"].get<std::string>(), "has another number by now, because the shop has changed",
             "try again");
    const std::size_t candidates = draft_.scene.transceivers.size();
    is_excluded_ = index_ >= candidates;
    const auto& where =
        is_excluded_ ? draft_.sources.excluded[index_ - candidates] : draft_.sources.transceivers[index_];
    constexpr std::string_view list = "/transceivers/list/";
    const std::string pointer = entry_of(where, draft_.store.file);
    if (pointer.starts_with(list)) entry_ = to_whole_number(pointer.substr(list.size()), UINT32_MAX);
  }

  void place() {
    unit_.position = vector_of(request_, "position");
    expect_outside_keep_out();
    change_unit(request_, draft_, unit_);
    id_ = free_ids_.next();
    lists_.append(list_key, json_of_unit(Json::object()));
    const std::string as = request_.value("as", pinned);
    if (as != pinned && as != installed) throw InputError("as", "is neither pinned nor installed");
    lists_.add(as.c_str(), id_);
  }

  void change() {
    const std::string old = id_;
    change_unit(request_, draft_, unit_);
    if (request_.contains("position")) {
      unit_.position = vector_of(request_, "position");
      expect_outside_keep_out();
    }
    if (entry_) {
      lists_.replace(*entry_, json_of_unit(lists_.entry(*entry_)));
    } else {
      id_ = free_ids_.next();
      lists_.append(list_key, json_of_unit(Json::object()));
      remove_from_lists(old);
    }
    if (is_excluded_ && entry_) lists_.remove(excluded, id_, "excluded");
    lists_.add(unit_.installed ? installed : pinned, id_);
  }

  void remove() {
    remove_from_lists(id_);
    if (entry_) lists_.erase_later(*entry_);
  }

  // A candidate that a pattern keeps on the plan, or from it, would stay so.
  void remove_from_lists(const std::string& id) {
    for (const Mark& m : marks)
      if (entry_)
        lists_.remove(m.list, id);
      else
        lists_.remove(m.list, id, m.state);
  }

  void expect_outside_keep_out() const {
    const auto& areas = draft_.store.keep_out;
    if (std::any_of(areas.begin(), areas.end(),
                    [&](const auto& area) { return area.value.contains(unit_.position); }))
      refuse(id_, "would be in a keep-out area, where no plan has units", "choose another place");
  }

  void mark(const std::string& name, bool is_on) {
    const auto found =
        std::find_if(marks.begin(), marks.end(), [&](const Mark& m) { return name == m.action; });
    if (found == marks.end()) throw InputError("action", "is unknown", "reload the page");
    const auto off = [&](const Mark& m) { lists_.remove(m.list, id_, m.state); };
    const auto& [to_select, to_pin, to_exclude, to_install] = marks;
    const bool excludes = found->list == excluded;
    if (is_on) {
      if (excludes) {
        for (const Mark& m : {to_select, to_pin, to_install}) off(m);
      } else {
        off(to_exclude);
      }
      lists_.add(found->list, id_);
      if (name == "install") off(to_pin);
      if (name == "pin") lists_.remove(installed, id_);
    } else {
      off(*found);
      // A unit that is switched off is not on the plan in any way.
      if (name == "switch")
        for (const Mark& m : {to_pin, to_install}) off(m);
    }
  }

  // Keys of a list entry; those that are there keep their order, and others that the planner does not know
  // stay.
  Json json_of_unit(Json entry) const {
    constexpr double finest = 1e-4, of_direction = 1e6, of_roll = 1e3;  // m; per unit
    const double of_length = std::pow(10, std::ceil(std::log10(factor_ / finest)));
    const Vec3& p = unit_.position;
    entry["id"] = id_;
    entry["type"] = draft_.scene.type_of(unit_).name;
    entry["position"] = Json::array();
    for (int a = 0; a < 3; ++a) entry["position"].push_back(tidy(p[a] / factor_, of_length));
    const auto set = [&](const char* key, const Json& value, const Json& usual) {
      if (value == usual)
        entry.erase(key);
      else
        entry[key] = value;
    };
    Json axis = Json::array();
    for (int a = 0; a < 3; ++a) axis.push_back(tidy(unit_.axis[a], of_direction));
    set("axis", axis, Json::array({0, 0, -1}));
    set("roll_deg", tidy(unit_.roll_deg, of_roll), 0);
    set("relative_power", unit_.relative_power, 1);
    return entry;
  }

  const Json& request_;
  const Draft& draft_;
  UnitLists& lists_;
  FreeIds& free_ids_;
  double factor_;  // m per unit of the file
  std::size_t index_ = 0;
  Transceiver unit_;
  std::string id_;
  bool is_excluded_ = false;
  std::optional<std::uint64_t> entry_;  // of the list
};

}  // namespace

UnitEdit unit_edit(const Json& request, const Json& store, const Draft& draft) {
  const auto name = request.at("action").get<std::string>();
  UnitLists lists(store);
  FreeIds free_ids(draft);
  UnitEdit edit;
  const auto apply = [&](const Json& one, bool is_one_of_many) {
    edit.ids.push_back(Action(one, draft, lists, free_ids).apply(name, is_one_of_many));
  };
  if (request.contains("each"))
    for (const Json& one : request["each"]) apply(one, true);
  else
    apply(request, false);
  lists.erase();
  edit.ops = std::move(lists.ops);
  return edit;
}

const Transceiver& unit_numbered(const Draft& draft, std::size_t index) {
  const std::size_t candidates = draft.scene.transceivers.size();
  if (index >= candidates + draft.scene.excluded.size())
    throw InputError("index", "is too large", "reload the page");
  return index < candidates ? draft.scene.transceivers[index] : draft.scene.excluded[index - candidates];
}

void change_unit(const Json& request, const Draft& draft, Transceiver& unit) {
  const auto& types = draft.scene.transceiver_types;
  if (request.contains("type")) {
    const auto name = request.at("type").get<std::string>();
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const TransceiverType& type) { return type.name == name; });
    if (found == types.end())
      throw InputError(in_quotes(name), "is no type of transceivers", "choose another type");
    unit.type = {static_cast<std::uint32_t>(found - types.begin())};
  }
  if (unit.type.value >= types.size())
    throw InputError("transceiver_types", "has no type", "define a type of transceivers first");
  if (request.contains("axis")) unit.axis = unit_direction(vector_of(request, "axis"), "axis");
  unit.roll_deg = request.value("roll_deg", unit.roll_deg);
  if (!(std::abs(unit.roll_deg) <= 360)) throw InputError("roll_deg", "is beyond 360 degrees");
  unit.relative_power = request.value("power", unit.relative_power);
  if (!(unit.relative_power >= least_power && unit.relative_power <= most_power))
    throw InputError("power", fmt::format("is not between {} and {}", least_power, most_power));
}

}  // namespace shelfbeam::serve
