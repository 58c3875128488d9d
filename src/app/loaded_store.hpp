#pragma once

#include <filesystem>
#include <string>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::app {

/// A store file made ready for use.
struct LoadedStore {
  Scene scene;
  std::string resolved;  ///< the store with nothing left to look up, as JSON
  std::string hash;      ///< of `resolved`
};

LoadedStore load_store(const std::filesystem::path& path);

}  // namespace shelfbeam::app
