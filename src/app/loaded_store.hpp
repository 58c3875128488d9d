#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::app {

/// A store file made ready for use.
struct LoadedStore {
  Scene scene;
  std::string resolved;  ///< the store with nothing left to look up, as JSON
  std::string hash;      ///< of `resolved`
};

/// Files that the store names lie in its folder unless `allow_outside`. `memory`: bytes, 0 for most of what
/// the machine has.
LoadedStore load_store(const std::filesystem::path& path, bool allow_outside = false, std::size_t memory = 0);

/// --allow-outside.
void add_store_options(CLI::App& verb, bool& allow_outside);

}  // namespace shelfbeam::app
