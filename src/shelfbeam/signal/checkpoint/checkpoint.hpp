#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace shelfbeam {

namespace detail {
class RecordWriter;
}

/// What a simulation must have in common with a checkpoint to go on from it: names and values, in a fixed
/// order. Neither holds a line break.
using CheckpointIdentity = std::vector<std::pair<std::string, std::string>>;

/// The state of one item of the work: the batches done and its sums over them.
struct CheckpointState {
  std::uint32_t batches = 0;
  std::span<const double> values;
};

/// A file that keeps the state of a simulation's items while it works (docs/formats/checkpoint.md): records
/// are appended, each the whole state of one item, and the last record of an item counts. Two processes that
/// keep one of the same name do not mix: each appends to its own file alone, and the name is of the last new
/// one.
class CheckpointFile {
 public:
  /// Touches no file.
  CheckpointFile(std::filesystem::path path, CheckpointIdentity identity, std::uint32_t items);
  ~CheckpointFile();

  /// Reads the file: calls use(item, state) for every record in turn. False where there
  /// is none. A record that is cut off at the end is dropped. Throws InputError for a file of another
  /// identity, naming what differs, and for a damaged one.
  bool load(const std::function<void(std::uint32_t item, const CheckpointState&)>& use);

  /// Appends the items that have other batches than the file has. Writes a new file, through a temporary one,
  /// the first time and where the old would be more than twice as large. Throws OutputError when that fails;
  /// the file still has what it had.
  void save(const std::function<CheckpointState(std::uint32_t item)>& state);

  bool has_saved() const { return size_ > 0; }
  const std::filesystem::path& path() const { return path_; }

 private:
  void append(const std::function<CheckpointState(std::uint32_t item)>& state);
  void rewrite(const std::function<CheckpointState(std::uint32_t item)>& state);

  std::filesystem::path path_;
  CheckpointIdentity identity_;
  std::vector<std::uint32_t> saved_;  ///< batches in the file, by item
  std::uint64_t size_ = 0;            ///< of what is good of the file; 0: there is none, or it is not ours
  std::unique_ptr<detail::RecordWriter> own_;  ///< the file that this process has made
};

/// The checkpoint that belongs to an output, beside it.
std::filesystem::path checkpoint_path(const std::filesystem::path& output);

/// Removes a checkpoint, and what killed programs left of new ones.
void remove_checkpoint(const std::filesystem::path& path);

}  // namespace shelfbeam
