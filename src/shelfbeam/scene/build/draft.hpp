#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shelfbeam/base/finding/finding.hpp"
#include "shelfbeam/scene/fixture/fixture_type.hpp"
#include "shelfbeam/scene/read_scene.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// A store that may be half drawn: everything in it that can be resolved, and all of its problems.
struct Draft {
  Store store;
  /// Without warnings and hash. Fixtures with problems are outlines, if their size is known.
  Scene scene;
  DeviceSources sources;
  std::vector<Finding> problems;  ///< none: `make_scene` makes the complete scene
};

/// Reads a store file; files that it names are relative to `folder`. Throws InputError only for a limit of
/// memory, and Interrupted.
Draft read_draft(const JsonCursor& document, const std::filesystem::path& folder, SceneDetail detail,
                 const StoreLimits& limits = {});

}  // namespace shelfbeam
