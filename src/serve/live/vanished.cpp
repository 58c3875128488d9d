#include "serve/live/vanished.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/length_unit.hpp"

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most = 1000;
constexpr double side = 1;  // m

// The place that an entry of the file gives to its element, m.
std::optional<Vec2> place_in(const Json& entry, LengthUnit unit) {
  constexpr double farthest = 1e4;  // as for coordinates
  for (const char* key : {"at", "min"}) {
    const auto found = entry.is_object() ? entry.find(key) : entry.end();
    if (found == entry.end() || !found->is_array() || found->size() < 2) continue;
    const Json &x = (*found)[0], &y = (*found)[1];
    if (!x.is_number() || !y.is_number()) continue;
    const Vec2 at{to_metres(x.get<double>(), unit), to_metres(y.get<double>(), unit)};
    if (std::max(std::abs(at[0]), std::abs(at[1])) <= farthest) return at;
  }
  return {};
}

// Nothing if another list makes the pointer that of another element.
const Json* element_at(const std::string& pointer, const Json& store, const Json& store_before) {
  const Json::json_pointer here(pointer), list = here.parent_pointer();
  if (!store.contains(here) || !store_before.contains(here)) return nullptr;
  if (store[list].is_array() && store[list].size() != store_before[list].size()) return nullptr;
  return &store[here];
}

void move_point(Json& point, const Vec2& by) {
  for (std::size_t k = 0; k < 2; ++k) point[k] = point[k].get<double>() + by[k];
}

void move(Json& part, const Vec2& by) {
  for (Json& point : part["outline"]) move_point(point, by);
  if (const auto footing = part.find("footing"); footing != part.end()) move_point((*footing)["at"], by);
}

Vec2 middle_of(const Scene& scene) {
  if (!scene.room) return {};
  const Vec3 low = scene.room->lower(), high = scene.room->upper();
  return {(low.x + high.x) / 2, (low.y + high.y) / 2};
}

Part square(std::size_t index, const Json& entry, const Draft& draft) {
  const auto text = [&](const char* key) {
    const auto found = entry.is_object() ? entry.find(key) : entry.end();
    return found != entry.end() && found->is_string() ? found->get<std::string>() : "";
  };
  const auto [x, y] = place_in(entry, draft.store.unit).value_or(middle_of(draft.scene));
  const std::string key = "fixtures/" + std::to_string(index);
  return {key,
          {{"key", key},
           {"path", "/" + key},
           {"kind", "fixture"},
           {"locked", nullptr},
           {"id", text("id")},
           {"type", text("type")},
           {"form", "block"},
           {"outline", {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}},
           {"height", side},
           {"rotation", 0},
           {"unfinished", true}}};
}

}  // namespace

std::vector<Part> vanished_parts(const std::vector<Part>& parts, const std::vector<Part>& before,
                                 const Json& store_before, const Draft& draft, const Json& store) {
  std::vector<Part> vanished;
  if (draft.problems.empty()) return vanished;
  std::set<std::string> present, found_again;
  for (const Part& part : parts) present.insert(part.json["path"].get<std::string>());
  for (const Part& part : before) {
    const auto pointer = part.json["path"].get<std::string>();
    if (vanished.size() == most || present.contains(pointer)) continue;
    const Json* entry = element_at(pointer, store, store_before);
    if (entry == nullptr) continue;
    Part last = part;
    last.json["unfinished"] = true;
    const auto from = place_in(store_before[Json::json_pointer(pointer)], draft.store.unit);
    if (const auto to = place_in(*entry, draft.store.unit); from && to)
      move(last.json, {(*to)[0] - (*from)[0], (*to)[1] - (*from)[1]});
    vanished.push_back(std::move(last));
    found_again.insert(pointer);
  }
  present.merge(found_again);
  const auto fixtures = store.find("fixtures");
  if (fixtures == store.end() || !fixtures->is_array()) return vanished;
  for (std::size_t k = 0; k < fixtures->size() && vanished.size() < most; ++k)
    if (!present.contains("/fixtures/" + std::to_string(k)))
      vanished.push_back(square(k, (*fixtures)[k], draft));
  return vanished;
}

}  // namespace shelfbeam::serve
