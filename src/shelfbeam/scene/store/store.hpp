#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/base/length_unit.hpp"
#include "shelfbeam/device/device_types.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/fixture/fixture.hpp"
#include "shelfbeam/scene/room/room.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/measuring_plane.hpp"
#include "shelfbeam/scene/store/mounts.hpp"
#include "shelfbeam/scene/store_folder.hpp"
#include "shelfbeam/scene/variation.hpp"
#include "shelfbeam/scene/warning_list.hpp"

namespace shelfbeam {

class Problems;

struct TransceiverGrid {
  Vec2 min{}, max{};
  /// m; adjusted slightly if it does not divide the extent, so that both ends are included
  double spacing = 1;
  double z = 0;
  Vec3 axis{0, 0, -1};
  double roll_deg = 0;
  TransceiverTypeId type;
};

/// A listed item and its location in the file ("labels[3]", "labels.csv:5") for messages.
template <class T>
struct Listed {
  T value;
  std::string where;
};

/// Numbers of materials and types.
struct NameCounts {
  std::size_t materials = 0, label_types = 0, transceiver_types = 0;
};

/// The content of a store file, with names resolved to indices and with tables and meshes loaded.
struct Store {
  std::string file;                 ///< for messages
  LengthUnit unit = LengthUnit::m;  ///< of its CSV files; all lengths below are in m
  std::string name;
  Language language = Language::english;  ///< of reports
  double wavelength_nm = 940;
  std::string currency;               ///< of the costs of transceivers; empty: not given
  std::optional<ValueSource> source;  ///< of all values without another one
  std::vector<DecisiveValue> marks;   ///< confirmed and assumed values, which may have changed since
  std::optional<Room> room;
  std::vector<NamedMaterial> materials;
  std::vector<LabelType> label_types;
  std::vector<TransceiverType> transceiver_types;
  NameCounts shared;                 ///< those from catalogues, which come first; a store need not use them
  std::vector<std::string> presets;  ///< names
  std::vector<Listed<Fixture>> fixtures;
  std::vector<Listed<Fixture>> unfinished;  ///< fixtures with problems whose size is known
  std::vector<Listed<Label>> labels;
  std::vector<Listed<MeasuringPlane>> measuring_planes;
  std::vector<Listed<TransceiverGrid>> grids;
  std::vector<Listed<MountArea>> areas;
  std::vector<Listed<MountRail>> rails;
  std::vector<Listed<MountFaces>> faces;
  std::vector<Listed<Transceiver>> transceivers;
  std::vector<Listed<KeepOut>> keep_out;
  std::vector<Listed<std::string>> installed;
  std::vector<Listed<std::string>> pinned, excluded;  ///< ids or patterns
  std::vector<Listed<std::string>> selected;          ///< ids; a choice that binds no plan
  std::optional<StoreVariation> variation;
  std::vector<Finding> warnings;  ///< about the ids in its CSV files
  IgnoredCodes ignored;
  /// Memory limit of its scene, bytes (StoreLimits::memory).
  std::size_t memory = std::numeric_limits<std::size_t>::max();
  /// Ends making and checking its scene and drawing its states with Interrupted (StoreLimits::cancel).
  const CancelToken* cancel = nullptr;
};

/// Version of the store format (key "format").
inline constexpr int store_format_version = 1;

/// Reads a store file (docs/formats/store.md) and the CSV and mesh files it names, relative to its folder.
/// Throws InputError with file and JSON path.
/// With `problems`, collects all of them instead of throwing the first; the store is then incomplete.
Store read_store(const std::filesystem::path& path, const StoreLimits& trust = {},
                 Problems* problems = nullptr);

/// As above, from a text; named files are relative to `folder`.
Store parse_store(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                  const StoreLimits& trust = {}, Problems* problems = nullptr);
Store parse_store(const JsonCursor& document, const std::filesystem::path& folder,
                  const StoreLimits& trust = {}, Problems* problems = nullptr);

/// Throws InputError for keys that a catalogue does not have, and for a value that is no object.
void expect_catalogue(const JsonCursor& file);

/// The locations in the store file of a scene's fixtures, labels, transceivers and excluded candidates, in
/// their order, for messages. A generated device has the location of its fixture or grid.
struct DeviceSources {
  std::vector<std::string> fixtures, labels, transceivers, excluded;
};

/// Expands fixtures and grids, checks ids and positions, and freezes the result. Throws InputError.
Scene make_scene(const Store& store, DeviceSources* sources = nullptr);

/// Removes candidates, mounted units and choices.
void clear_units(Store& store);

/// The store with the units of a CSV file (read_transceivers_csv) instead of its candidates. They may have
/// any position, even the same. Throws InputError with file and line.
Store store_with_units(Store store, const std::filesystem::path& csv);

/// The store without references: labels and candidates are listed, meshes are inlined. Reading it back gives
/// the same scene to the bit. hash_of_resolved identifies the store in result files.
std::string resolved_store_json(const Store& store, const Scene& scene);

/// The content hash of a resolved store without its language and the descriptions of its labels, on which no
/// result depends.
std::string hash_of_resolved(std::string_view text);

}  // namespace shelfbeam
