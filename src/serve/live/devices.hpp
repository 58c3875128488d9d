#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/scene/build/draft.hpp"

namespace shelfbeam::serve {

/// Labels or units as arrays for the page (docs/formats/planner.md).
struct DeviceArrays {
  std::vector<float> position, direction;  ///< three elements each; m, and unit length
  std::vector<std::uint8_t> mark;          ///< of a label its shelf level, of a unit its UnitState
  std::vector<std::uint8_t> kind;          ///< LabelSource or UnitSource
  std::vector<std::uint32_t> source;       ///< index of the element with this kind of source

  std::size_t size() const { return kind.size(); }
  bool operator==(const DeviceArrays&) const = default;
};

enum class UnitState : std::uint8_t { candidate, installed, pinned, excluded, selected };
enum class LabelSource : std::uint8_t { list, fixture, file };
enum class UnitSource : std::uint8_t { list, grid, area, rail, on, file };

DeviceArrays labels_of(const Draft& draft);
/// Candidates first, then excluded ones.
DeviceArrays units_of(const Draft& draft);

/// A binary frame that replaces the devices of a page by others, as far as they differ; nothing if they do
/// not. `event`: "labels" or "units".
std::optional<std::string> devices_frame(const std::string& event, std::uint64_t revision,
                                         const DeviceArrays& before, const DeviceArrays& after);

}  // namespace shelfbeam::serve
