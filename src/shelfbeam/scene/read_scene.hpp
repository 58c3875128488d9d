#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

class CancelToken;
class ReadCache;
struct Store;

/// An empty cache for StoreLimits::cache, for one thread.
std::shared_ptr<ReadCache> make_read_cache();

/// Limits on a store file, which may come from an untrusted source.
struct StoreLimits {
  /// Whether the store may name files outside its folder.
  bool allow_outside = false;
  /// Memory limit in bytes for labels, candidates and surfaces, estimated before they are allocated; 0: 80 %
  /// of the memory that this process may use.
  std::size_t memory = 0;
  /// Limit in bytes of the store file, and of each file that it names.
  std::uint64_t file_size = std::numeric_limits<std::uint64_t>::max();
  /// A file that the store must not name, because it will be overwritten.
  std::filesystem::path output = {};
  /// Ends the reading of the store, and later all work on it, with Interrupted.
  const CancelToken* cancel = nullptr;
  /// Results of earlier readings.
  ReadCache* cache = nullptr;
  /// Whether the store may name files in its folder through symbolic links.
  bool allow_links = true;
  /// Limit of the number of fixtures, with their copies.
  std::size_t fixtures = std::numeric_limits<std::size_t>::max();
  /// What a user can do about a file outside the folder, for messages.
  const char* outside_remedy = "move it there, or allow files outside it";
};

/// The scene of a store file (docs/formats/store.md) and of the files that it names. Throws InputError with
/// file and location.
Scene read_scene(const std::filesystem::path& store, const StoreLimits& trust = {});

/// The content of a store file, for plan_store, with its scene.
struct StoreWithScene {
  std::shared_ptr<const Store> store;
  Scene scene;
};

/// As `read_scene`.
StoreWithScene read_store_with_scene(const std::filesystem::path& store, const StoreLimits& trust = {});

}  // namespace shelfbeam
