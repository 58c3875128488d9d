#include "shelfbeam/plan/difference/store_changes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/plan/difference/matches.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

// Versions of the program may round the same store differently.
constexpr double number_rounding = 1e-9;

const std::string no_key;

bool is_equal(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    return std::abs(x - y) <= number_rounding * std::max({1.0, std::abs(x), std::abs(y)});
  }
  if (a.type() != b.type() || a.size() != b.size()) return false;
  if (a.is_array()) return std::equal(a.begin(), a.end(), b.begin(), is_equal);
  if (!a.is_object()) return a == b;
  return std::all_of(a.items().begin(), a.items().end(), [&](const auto& item) {
    const auto found = b.find(item.key());
    return found != b.end() && is_equal(item.value(), *found);
  });
}

bool has_ids(const Json& list) {
  return list.is_array() && !list.empty() && std::all_of(list.begin(), list.end(), [](const Json& element) {
           return element.is_object() && element.contains("id");
         });
}

std::string text_of(const Json* value) {
  return value == nullptr ? no_key : value->dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The members of an object, or the elements of a list by their ids.
std::map<std::string, const Json*> members_of(const Json& value) {
  std::map<std::string, const Json*> members;
  if (value.is_array())
    for (const Json& element : value) members.emplace(element["id"].get<std::string>(), &element);
  else
    for (const auto& [key, member] : value.items()) members.emplace(key, &member);
  return members;
}

void add_changes(std::vector<ValueChange>& changes, const std::string& path, const Json* before,
                 const Json* after) {
  if (before != nullptr && after != nullptr) {
    if (is_equal(*before, *after)) return;
    const bool are_lists = has_ids(*before) && has_ids(*after);
    if (are_lists || (before->is_object() && after->is_object())) {
      const auto old = members_of(*before), now = members_of(*after);
      const auto member_path = [&](const std::string& key) {
        return are_lists ? fmt::format("{}[{}]", path, key) : path.empty() ? key : path + "." + key;
      };
      for (const auto& [key, value] : old) {
        const auto found = now.find(key);
        add_changes(changes, member_path(key), value, found == now.end() ? nullptr : found->second);
      }
      for (const auto& [key, value] : now)
        if (!old.contains(key)) add_changes(changes, member_path(key), nullptr, value);
      return;
    }
  }
  changes.push_back({path, text_of(before), text_of(after)});
}

/// A part that is a list of elements: their ids and, without these, their values.
struct Elements {
  std::vector<Identity> identities;
  std::vector<Json> values;

  void add(std::string id, Json value) {
    value.erase("id");
    identities.push_back({std::move(id), text_of(&value)});
    values.push_back(std::move(value));
  }
};

Elements elements_of(const Json& part) {
  Elements elements;
  if (part.is_object())
    for (const auto& [name, value] : part.items()) elements.add(name, value);
  else
    for (const Json& element : part) elements.add(element["id"].get<std::string>(), element);
  return elements;
}

// Every other member is a list of ids, and becomes a key of the units that it names.
Elements transceivers_of(const Json& part) {
  Elements elements = elements_of(part["list"]);
  std::map<std::string, std::size_t> position;
  for (std::size_t k = 0; k < elements.identities.size(); ++k) position[elements.identities[k].id] = k;
  for (const auto& [key, ids] : part.items()) {
    // Selected units are the answer of an earlier plan, and no part of the question.
    if (key == "list" || key == "selected" || !ids.is_array()) continue;
    for (const Json& id : ids) {
      const auto [found, is_new] = position.emplace(id.get<std::string>(), elements.values.size());
      if (is_new) elements.add(found->first, Json::object());
      elements.values[found->second][key] = true;
    }
  }
  return elements;
}

bool is_direction_or_place(const ValueChange& change) {
  constexpr std::array<std::string_view, 6> keys{"at",     "position", "rotation_deg",
                                                 "normal", "axis",     "roll_deg"};
  return std::find(keys.begin(), keys.end(), change.key) != keys.end();
}

class Comparison {
 public:
  std::vector<StoreChange> changes;

  void whole(StorePart part, const Json* before, const Json* after) {
    StoreChange change{part, StoreChangeKind::changed, {}, {}, {}};
    add_changes(change.values, "", before, after);
    if (before == nullptr) change.kind = StoreChangeKind::added;
    if (after == nullptr) change.kind = StoreChangeKind::removed;
    if (!change.values.empty()) changes.push_back(std::move(change));
  }

  void elements(StorePart part, const Elements& before, const Elements& after) {
    for (const auto& [i, j] : matches(before.identities, after.identities, SameBy::id)) {
      StoreChange change{part, StoreChangeKind::changed, {}, {}, {}};
      if (i) change.before_id = before.identities[*i].id;
      if (j) change.after_id = after.identities[*j].id;
      if (part == StorePart::labels)
        change.description = (j ? after.values[*j] : before.values[*i]).value("description", "");
      if (i && j) {
        add_changes(change.values, "", &before.values[*i], &after.values[*j]);
        const bool is_renamed = change.before_id != change.after_id;
        if (change.values.empty() && !is_renamed) continue;
        if (change.values.empty())
          change.kind = StoreChangeKind::renamed;
        else if (!is_renamed &&
                 std::all_of(change.values.begin(), change.values.end(), is_direction_or_place))
          change.kind = StoreChangeKind::moved;
      } else {
        change.kind = i ? StoreChangeKind::removed : StoreChangeKind::added;
      }
      changes.push_back(std::move(change));
    }
  }
};

Json shop_of(const Json& store) {
  Json shop = Json::object();
  for (const auto& [key, value] : store.items())
    if (!value.is_structured()) shop[key] = value;
  return shop;
}

}  // namespace

std::vector<StoreChange> store_changes(const std::string& before, const std::string& after) {
  const Json old = Json::parse(before), now = Json::parse(after), none = Json::object();
  const auto member = [](const Json& store, std::string_view key) {
    const auto found = store.find(key);
    return found == store.end() ? nullptr : &*found;
  };
  Comparison comparison;
  const Json old_shop = shop_of(old), new_shop = shop_of(now);
  comparison.whole(StorePart::shop, &old_shop, &new_shop);
  for (const auto& [name, part] : names_of<StorePart>) {
    const Json *a = member(old, name), *b = member(now, name);
    if (part == StorePart::shop || (a == nullptr && b == nullptr)) continue;
    if (part == StorePart::room || part == StorePart::variation)
      comparison.whole(part, a, b);
    else if (part == StorePart::transceivers)
      comparison.elements(part, transceivers_of(*a), transceivers_of(*b));
    else
      comparison.elements(part, elements_of(a == nullptr ? none : *a), elements_of(b == nullptr ? none : *b));
  }
  return std::move(comparison.changes);
}

}  // namespace shelfbeam
