#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "serve/project/history.hpp"
#include "serve/project/store_file.hpp"

namespace shelfbeam::serve {

struct EditOp;

/// A step of the history, for a list.
struct Step {
  std::string label, time;  ///< the time is that of its last change, in UTC (ISO 8601)

  bool operator==(const Step&) const = default;
};

struct ProjectOptions {
  StoreCheck check = {};
  HistoryLimits history = {};
  std::function<std::chrono::system_clock::time_point()> now = std::chrono::system_clock::now;
};

/// A folder with a store.json and its history in `.shelfbeam`. The text of the file is the truth; it is the
/// text of the project after every call, and is changed by edits of single values only (text/edit.hpp).
///
/// When a change returns, it is on the disk: first in the history, then in the file. If the process ends in
/// between, the next project finishes the change. A change from outside is never overwritten: it becomes a
/// step of the history, after which an edit must still fit. While the file is invalid or gone, or its change
/// cannot be written to the history, the project keeps the last valid text, and is locked: it cannot be
/// changed. The same holds while the present folder of the process, if it is that of the project, is gone:
/// the project continues when it is back in its place with the same text.
///
/// A function that throws OutputError (disk full, no permission) has changed nothing. For one thread.
class Project {
 public:
  /// Without a history, store.json must be valid; with one, the project begins locked if it is not. Throws
  /// InputError for a store.json that is not, if another process has opened the project, which the error
  /// names, and if `.shelfbeam` or the history is a symbolic link; OutputError if the folder cannot be
  /// written to.
  explicit Project(const std::filesystem::path& folder, ProjectOptions options = {});

  /// The last valid text of store.json.
  const std::string& text() const { return text_; }
  /// Counts the texts since the project was opened, from 1.
  std::uint64_t revision() const { return revision_; }

  /// Changes the text; returns whether it has changed. With `join`, an edit of the same label and paths
  /// within 800 ms after another is part of its step. An edit that changes no byte is no step. Throws
  /// EditConflict, and InputError if the result would be too large or invalid, or the project is locked.
  /// Outside changes that were found first have been taken in nevertheless: compare the revision.
  bool edit(const std::string& label, const std::vector<EditOp>& ops, bool join = false);

  /// Without a step to undo or redo, these do nothing. They throw InputError if the file was changed outside
  /// just before, which is then the step that they would undo, and if the project is locked.
  void undo();
  void redo();
  /// Undoes or redoes until the first `position` steps are applied. Throws InputError, too, if there are not
  /// as many, or if a history from elsewhere leads to an invalid text.
  void go(std::size_t position);

  std::vector<Step> steps() const;
  /// The number of applied steps.
  std::size_t position() const { return history_->timeline().position(); }

  /// Looks whether the file has changed; reads it only if its size, time or number has, or may have. To be
  /// called about once a second. Returns whether the text, or the reason of the lock, is another one now.
  bool check_outside() { return look(false); }
  /// Why the project is locked; nothing if it is not.
  const std::optional<std::string>& locked() const { return locked_; }
  /// Puts the last valid text back if the project is locked. A file that is in its place gets the first free
  /// name out of `store.json.outside-1`, ... Throws OutputError.
  void restore_mine();

 private:
  using Clock = std::chrono::system_clock;
  /// The edit that another one may join.
  struct LastEdit {
    std::string label;
    std::vector<std::string> paths;
    Clock::time_point time;
  };

  std::filesystem::path history_path() const { return folder_ / ".shelfbeam" / "history.jsonl"; }
  std::string read_valid() const;
  bool is_gone() const;
  InputError gone() const;
  bool returns();
  void take_own_folder();
  void own_history();
  void start(std::optional<HistoryTexts> texts, bool may_be_one_behind);
  bool look(bool by_content);
  bool lock(std::string reason);
  bool take_in(const std::string& text);
  void expect_unlocked() const;
  void record(const Record& record);
  bool write(const Record& change, const std::string& text);

  std::filesystem::path folder_, home_;  ///< as given, empty for the present one; and its absolute path
  ProjectOptions options_;
  StoreFile file_;
  std::optional<OutputLock> own_;
  std::optional<History> history_;
  std::string text_;
  std::uint64_t revision_ = 1;
  std::optional<std::string> locked_;
  std::optional<FileStamp> known_;  ///< of the file when it was last read or written
  bool is_settled_ = false;         ///< a later change would have changed the stamp
  std::optional<LastEdit> last_edit_;
};

}  // namespace shelfbeam::serve
