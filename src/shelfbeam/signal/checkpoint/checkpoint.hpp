#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "shelfbeam/signal/checkpoint/checkpoint_identity.hpp"

namespace shelfbeam {

namespace detail {
class RecordWriter;
}

/// The state of an item of work: its completed batches and its sums over them.
struct CheckpointState {
  std::uint32_t batches = 0;
  std::span<const double> values;
};

/// A file with the state of a running simulation's items (docs/formats/checkpoint.md). It consists of
/// appended records, each with the complete state of one item; the last record of an item is valid. Processes
/// that use the same name do not mix their records: each appends only to its own file, and the name refers to
/// the file that was created last.
class CheckpointFile {
 public:
  /// Throws InputError if a file of this name is not a checkpoint of any version.
  CheckpointFile(std::filesystem::path path, CheckpointIdentity identity, std::uint32_t items);
  ~CheckpointFile();

  /// Reads the file and calls use(item, state) for every record in order. False if the file does not exist. A
  /// truncated record at the end is ignored. Throws InputError for a file with another identity, naming the
  /// difference, and for a corrupt file.
  bool load(const std::function<void(std::uint32_t item, const CheckpointState&)>& use);

  /// Appends the items whose batches differ from the file. Instead writes a new file, through a temporary
  /// file, the first time and when the old file would exceed twice the necessary size. Throws OutputError;
  /// the old content is then still valid.
  void save(const std::function<CheckpointState(std::uint32_t item)>& state);

  bool has_saved() const { return size_ > 0; }
  const std::filesystem::path& path() const { return path_; }

 private:
  void append(const std::function<CheckpointState(std::uint32_t item)>& state);
  void rewrite(const std::function<CheckpointState(std::uint32_t item)>& state);

  std::filesystem::path path_;
  CheckpointIdentity identity_;
  std::vector<std::uint32_t> saved_;              ///< batches in the file, by item
  std::uint64_t size_ = 0;                        ///< bytes of the file's valid content; 0: no file
  std::unique_ptr<detail::RecordWriter> writer_;  ///< the file that this process has created
};

/// The checkpoint of an output file, in the same folder.
std::filesystem::path checkpoint_path(const std::filesystem::path& output);

/// Removes a checkpoint and the temporary files that killed programs left.
void remove_checkpoint(const std::filesystem::path& path);

}  // namespace shelfbeam
