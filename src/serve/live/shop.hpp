#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/build/draft.hpp"
#include "shelfbeam/scene/read_scene.hpp"
#include "shelfbeam/scene/store/completed_fixture.hpp"

#include "serve/live/devices.hpp"
#include "serve/live/parts.hpp"
#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

/// The differences of a shop from the one before, for pages (docs/formats/planner.md).
struct ShopChanges {
  nlohmann::ordered_json parts;              ///< {"set": [...], "remove": [...]}
  std::optional<std::string> labels, units;  ///< frames
  bool changes_light = true;                 ///< more may have changed than units and names
};

/// The resolved shop of a store file that is being edited.
class Shop {
 public:
  /// `file`: the store file. Files that it names must lie in its folder, and not behind links. `cancel` ends
  /// its work with Interrupted, and must outlive it.
  explicit Shop(std::filesystem::path file, const CancelToken* cancel = nullptr);

  /// Resolves a text, which must be a JSON object. Problems of its content are part of the result. If it
  /// cannot be resolved at all, for example for lack of memory, that is the only problem, and nothing is
  /// resolved.
  ShopChanges update(const std::string& text, std::uint64_t revision);

  /// The file as it was parsed.
  const nlohmann::ordered_json& json() const { return document_.value(); }
  const Draft& draft() const { return draft_; }
  nlohmann::ordered_json parts() const;
  /// Code, path, pointer and sentence of each, as `locate` says.
  nlohmann::ordered_json problems() const;
  /// Of what the server reads.
  StoreLimits limits() const;
  /// Adds to a finding with a path the `pointer` to its element, and the `key` of the part if it is one of
  /// several copies.
  void locate(nlohmann::ordered_json& finding) const;
  /// The names of presets, materials and types, also from catalogues.
  nlohmann::ordered_json names() const;
  std::string labels(std::uint64_t revision) const;
  std::string units(std::uint64_t revision) const;

  /// An entry of "fixtures" with the keys of its presets, and with all keys, in m.
  nlohmann::ordered_json details(const std::string& pointer) const;
  /// The presets of the store and its catalogues by name: `effective` with the keys of its own preset, and
  /// `units` as in `details`. Throws InputError if one has problems.
  nlohmann::ordered_json presets() const;
  /// The edit that makes fixtures with places of their own out of an entry (live/dissolve.hpp).
  std::vector<EditOp> dissolved(const std::string& pointer) const;
  /// Precondition for both: the index is below the number of labels or units.
  nlohmann::ordered_json label(std::size_t index) const;
  nlohmann::ordered_json unit(std::size_t index) const;
  std::size_t label_count() const { return labels_.size(); }
  std::size_t unit_count() const { return units_.size(); }
  /// Fixtures, labels and units whose id contains a text, in any case; at most 50.
  nlohmann::ordered_json find(const std::string& text) const;
  /// The scene with its surfaces, for the 3-D view.
  std::string scene(std::uint64_t revision) const;

 private:
  CompletedFixture completed(const std::string& pointer) const;
  const Transceiver& unit_at(std::size_t index) const;

  std::filesystem::path file_;
  const CancelToken* cancel_;
  std::shared_ptr<ReadCache> cache_;
  std::string files_;  // state_of_named_files
  JsonCursor document_;
  Draft draft_;
  std::vector<Part> parts_;
  DeviceArrays labels_, units_;
};

}  // namespace shelfbeam::serve
