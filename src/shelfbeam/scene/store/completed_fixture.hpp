#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/length_unit.hpp"
#include "shelfbeam/scene/read_scene.hpp"

namespace shelfbeam {

/// Keys of a fixture.
struct FixtureKeys {
  nlohmann::ordered_json json;
  std::map<std::string, LengthUnit> units;  ///< of keys from a catalogue in another unit than the file's
};

/// A fixture of a store file with the keys of its presets.
struct CompletedFixture {
  FixtureKeys whole;
  FixtureKeys inherited;  ///< those of the presets alone
};
/// `document`: a store file; `index`: in its "fixtures". Throws InputError if there is no such fixture, or if
/// its presets have problems.
CompletedFixture completed_fixture(const JsonCursor& document, const std::filesystem::path& folder,
                                   std::size_t index, const StoreLimits& limits = {});

/// The presets of a store file and its catalogues, each with the keys of its own preset. Throws InputError if
/// one has problems.
std::map<std::string, FixtureKeys> completed_presets(const JsonCursor& document,
                                                     const std::filesystem::path& folder,
                                                     const StoreLimits& limits = {});

}  // namespace shelfbeam
