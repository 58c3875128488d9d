#include "serve/live/devices.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <tuple>

#include <nlohmann/json.hpp>

#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/viewer/page_data.hpp"

#include "serve/live/place.hpp"

namespace shelfbeam::serve {

namespace {

// The beginnings of locations in the store file, by kind of source.
constexpr auto label_lists = std::to_array<std::string_view>({"labels[", "fixtures[", "measuring_planes["});
constexpr auto unit_lists =
    std::to_array<std::string_view>({"transceivers.list[", "transceivers.grids[", "transceivers.areas[",
                                     "transceivers.rails[", "transceivers.on["});

// `where`: "store.json: labels[17]". Elements of other files have the kind behind all lists.
template <std::size_t size>
void add_source(DeviceArrays& devices, const std::string& where, const std::string& file,
                const std::array<std::string_view, size>& lists) {
  std::uint8_t kind = size;
  std::uint32_t index = 0;
  if (const auto path = path_in(where, file))
    for (std::size_t k = 0; k < size; ++k)
      if (path->starts_with(lists[k])) {
        kind = static_cast<std::uint8_t>(k);
        std::from_chars(path->data() + lists[k].size(), path->data() + path->size(), index);
      }
  devices.kind.push_back(kind);
  devices.source.push_back(index);
}

template <class Value>
std::vector<Value> part_of(const std::vector<Value>& values, std::size_t begin, std::size_t end,
                           std::size_t width) {
  const auto at = [&](std::size_t k) { return values.begin() + static_cast<std::ptrdiff_t>(width * k); };
  return {at(begin), at(end)};
}

bool are_equal(const DeviceArrays& a, std::size_t i, const DeviceArrays& b, std::size_t j) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a.position[3 * i + axis] != b.position[3 * j + axis] ||
        a.direction[3 * i + axis] != b.direction[3 * j + axis])
      return false;
  return a.mark[i] == b.mark[j] && a.kind[i] == b.kind[j] && a.source[i] == b.source[j];
}

}  // namespace

DeviceArrays labels_of(const Draft& draft) {
  DeviceArrays devices;
  std::vector<double> heights;
  const auto& labels = draft.scene.labels;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    append_point(devices.position, labels[i].position);
    append_point(devices.direction, labels[i].normal);
    heights.push_back(labels[i].position.z);
    add_source(devices, draft.sources.labels[i], draft.store.file, label_lists);
  }
  devices.mark.resize(labels.size());
  const std::vector<ShelfLevel> levels = shelf_levels(heights);
  for (std::size_t k = 0; k < levels.size(); ++k)
    for (const LabelId label : levels[k].labels)
      devices.mark[label] = static_cast<std::uint8_t>(std::min<std::size_t>(k, UINT8_MAX));
  return devices;
}

DeviceArrays units_of(const Draft& draft) {
  DeviceArrays devices;
  const auto add = [&](const Transceiver& unit, UnitState state, const std::string& where) {
    append_point(devices.position, unit.position);
    append_point(devices.direction, unit.axis);
    devices.mark.push_back(static_cast<std::uint8_t>(state));
    add_source(devices, where, draft.store.file, unit_lists);
  };
  const auto& [scene, sources] = std::tie(draft.scene, draft.sources);
  for (std::size_t j = 0; j < scene.transceivers.size(); ++j) {
    const Transceiver& unit = scene.transceivers[j];
    add(unit,
        unit.installed  ? UnitState::installed
        : unit.pinned   ? UnitState::pinned
        : unit.selected ? UnitState::selected
                        : UnitState::candidate,
        sources.transceivers[j]);
  }
  for (std::size_t j = 0; j < scene.excluded.size(); ++j)
    add(scene.excluded[j], UnitState::excluded, sources.excluded[j]);
  return devices;
}

std::optional<std::string> devices_frame(const std::string& event, std::uint64_t revision,
                                         const DeviceArrays& before, const DeviceArrays& after) {
  const std::size_t shorter = std::min(before.size(), after.size());
  std::size_t front = 0, back = 0;
  while (front < shorter && are_equal(before, front, after, front)) ++front;
  while (back < shorter - front &&
         are_equal(before, before.size() - 1 - back, after, after.size() - 1 - back))
    ++back;
  const std::size_t end = after.size() - back;
  if (front == end && front == before.size() - back) return {};
  const bool are_labels = event == "labels";
  PageData page;
  page.add("position", part_of(after.position, front, end, 3));
  page.add(are_labels ? "normal" : "axis", part_of(after.direction, front, end, 3));
  page.add(are_labels ? "level" : "state", part_of(after.mark, front, end, 1));
  page.add("source_kind", part_of(after.kind, front, end, 1));
  page.add("source", part_of(after.source, front, end, 1));
  return page.binary(nlohmann::ordered_json{
      {"event", event}, {"revision", revision}, {"from", front}, {"remove", before.size() - back - front}}
                         .dump());
}

}  // namespace shelfbeam::serve
