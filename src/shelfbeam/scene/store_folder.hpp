#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/scene/read_scene.hpp"

namespace shelfbeam {

class JsonCursor;

/// The folder of a store file, which contains the files that the store names.
class StoreFolder {
 public:
  explicit StoreFolder(std::filesystem::path folder, const StoreLimits& trust = {});

  /// StoreLimits::memory, but at least the memory that the program itself requires.
  std::size_t memory() const;
  const CancelToken* cancel() const { return trust_.cancel; }
  ReadCache* cache() const { return trust_.cache; }

  /// Throws InputError at the entry that makes the store have so many fixtures if they are too many.
  void expect_few_fixtures(std::size_t count, const JsonCursor& entry) const;

  /// Opens a file named relative to the folder. Throws InputError at the JSON position if the file does not
  /// exist, is a folder or too large, cannot be read, is StoreLimits::output, or lies outside this folder: by
  /// "..", an absolute path or a symbolic link. Other programs that change the folder meanwhile change
  /// nothing about that.
  InputFile find(const JsonCursor& name) const;
  /// The same for any name; `where` is its location and `what` the kind of file ("mesh"), for messages.
  InputFile find(const std::filesystem::path& name, const std::string& where, const std::string& what) const;

 private:
  static constexpr std::size_t min_memory = 1 << 26;

  FoundFile found(const std::filesystem::path& name) const;
  bool is_output(const FoundFile& found) const;

  std::filesystem::path folder_;
  StoreLimits trust_;
};

}  // namespace shelfbeam
