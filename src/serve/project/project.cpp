#include "serve/project/project.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/files/access.hpp"
#include "shelfbeam/base/files/descriptor.hpp"
#include "shelfbeam/base/files/file_time.hpp"
#include "shelfbeam/base/files/open_file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/base/text.hpp"

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_label = 200;
constexpr std::chrono::milliseconds joining_time{800};

bool is_settled(const std::optional<FileStamp>& stamp) {
  return !stamp || shelfbeam::is_settled(stamp->modified_ns);
}

std::vector<std::string> paths_of(const std::vector<EditOp>& ops) {
  std::vector<std::string> paths;
  paths.reserve(ops.size());
  for (const EditOp& op : ops) paths.push_back(op.path);
  return paths;
}

fs::path folder_or_here(const fs::path& folder) {
  return folder.empty() ? "." : folder;
}

// Opens the new folder `own` to those to whom the folder around it is open, so that a group can share a
// project, but not to those who may not read the store: the history has its texts. Earlier versions made it
// private.
void open_like(const fs::path& own, const fs::path& store) {
  struct stat now = {}, around = {}, file = {};
  const Descriptor opened(::open(own.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (::fstat(opened.number(), &now) != 0 || now.st_uid != ::geteuid() || (now.st_mode & 0777) != S_IRWXU ||
      ::stat(folder_or_here(store.parent_path()).c_str(), &around) != 0)
    return;
  take_access(opened.number(), around);
  mode_t mode = ::fstat(opened.number(), &now) == 0 ? now.st_mode & 0777 : 0;
  if (::lstat(store.c_str(), &file) == 0)
    for (const mode_t readers : {mode_t{S_IRGRP}, mode_t{S_IROTH}})
      if ((file.st_mode & readers) == 0) mode &= ~(readers | readers >> 1 | readers >> 2);
  if ((mode & S_IWGRP) != 0) mode |= S_ISGID;  // its files get its group
  ::fchmod(opened.number(), mode | S_IRWXU);
}

}  // namespace

Project::Project(const fs::path& folder, ProjectOptions options)
    : folder_((folder / "store.json").lexically_normal().parent_path()),  // empty rather than "."
      home_(fs::weakly_canonical(folder_or_here(folder_))),
      options_(std::move(options)),
      file_((folder / "store.json").lexically_normal(), options_.check) {
  // A folder without a store stays as it is.
  if (!stamp_of(history_path())) read_valid();
  take_own_folder();
  // Only a file that was written before the last record can lack it. A younger one has an older text because
  // somebody wanted it. Times that are equal, or not known, belong to a program that was killed.
  const auto written = change_time(file_.path()), recorded = change_time(history_path());
  history_.emplace(history_path(), options_.history);
  start(history_->take_texts(), written <= recorded);
}

void Project::take_own_folder() {
  const fs::path own = history_path().parent_path();
  if (::mkdir(own.c_str(), S_IRWXU) != 0 && errno != EEXIST) cannot_write(own, system_reason());
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(own, error)))
    throw InputError(own.string(), "is not a folder", "move it elsewhere");
  open_like(own, file_.path());
  if (::access(own.c_str(), R_OK | W_OK | X_OK) != 0)
    cannot_write(own, system_reason(),
                 "let its owner make it readable and writable for you, e.g. with 'chmod -R g+rwX'");
  own_.emplace(history_path(), home_.string(), "use the page of the other, or end it");
}

std::string Project::read_valid() const {
  auto found = file_.read();
  if (!found) throw InputError(file_.path().string(), "does not exist", "name a folder with a store.json");
  file_.expect_valid(found->content);
  return std::move(found->content);
}

void Project::start(std::optional<HistoryTexts> texts, bool may_be_one_behind) {
  if (!texts) {
    text_ = read_valid();
    history_->begin(text_, utc_text(options_.now()));
    texts.emplace().last = text_;
  }
  text_ = std::move(texts->last);
  if (may_be_one_behind && texts->before && has_content(file_.path(), *texts->before)) {
    file_.expect_valid(text_);
    file_.put(text_, &*texts->before);
  }
  look(true);
  file_.expect_valid(text_);  // the history may come from elsewhere
}

bool Project::is_gone() const {
  struct stat here = {};
  std::error_code error;
  if (!folder_.empty()) return false;
  return fs::current_path(error).empty() || error || ::stat(".", &here) != 0;
}

InputError Project::gone() const {
  return {
      home_.string(), "was removed, or its drive is gone",
      "put the folder back with the same store.json, and the planner continues; for another shop, start it "
      "again"};
}

// The mount point of a drive that is gone is another, empty folder.
bool Project::returns() {
  const auto found = read_regular_file(home_ / file_.path(), max_store_text);
  if (!found || found->content != text_ || ::chdir(home_.c_str()) != 0) return false;
  own_history();
  return true;
}

bool Project::look(bool by_content) {
  try {
    if (is_gone() && !returns()) throw gone();
  } catch (const InputError& error) {
    known_.reset();
    return lock(error.what());
  }
  const auto stamp = stamp_of(file_.path());
  if (!by_content && stamp == known_ && is_settled_) return false;
  std::optional<FileContent> found;
  try {
    found = file_.read();
    known_ = found ? std::optional(found->stamp) : std::nullopt;
    is_settled_ = is_settled(known_);
    if (!found) return lock(file_.path().string() + ": was removed");
    if (found->content != text_) file_.expect_valid(found->content);
  } catch (const InputError& error) {
    known_ = stamp;
    is_settled_ = is_settled(known_);
    return lock(error.what());
  }
  if (found->content != text_) return take_in(found->content);
  return std::exchange(locked_, std::nullopt).has_value();
}

bool Project::lock(std::string reason) {
  if (locked_ == reason) return false;
  locked_ = std::move(reason);
  return true;
}

bool Project::take_in(const std::string& text) {
  Change change{utc_text(options_.now()), "Changed outside", {}, false, {splice_between(text_, text)},
                content_hash(text_),      content_hash(text)};
  try {
    record(change);
  } catch (const InputError& error) {
    is_settled_ = false;  // the next look tries again
    return lock(error.what());
  }
  text_ = text;
  ++revision_;
  locked_.reset();
  last_edit_.reset();
  history_->accept(change, text_);
  return true;
}

void Project::expect_unlocked() const {
  if (is_gone()) throw gone();
  if (locked_)
    throw InputError("the project", "is locked: " + *locked_,
                     "correct the file, or restore the last valid one");
}

void Project::own_history() {
  if (history_->is_in_place()) return;
  take_own_folder();  // the folder was removed, and the lock with it
  history_->restore(text_);
}

void Project::record(const Record& record) {
  own_history();
  history_->write(record);
}

bool Project::write(const Record& change, const std::string& text) {
  record(change);
  std::optional<FileStamp> stamp;
  try {
    stamp = file_.put(text, &text_);
  } catch (const OutputError&) {
    history_->take_back();
    throw;
  }
  if (!stamp) {
    history_->take_back();
    return false;
  }
  known_ = stamp;
  is_settled_ = false;
  text_ = text;
  ++revision_;
  history_->accept(change, text_);
  return true;
}

bool Project::edit(const std::string& label, const std::vector<EditOp>& ops, bool join) {
  constexpr int attempts = 3;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    look(true);
    expect_unlocked();
    const EditedText result = edited(text_, ops);
    if (result.splices.empty()) return false;
    file_.expect_valid(result.text, result.value);
    const Clock::time_point now = options_.now();
    LastEdit edit{shortened(label, longest_label), paths_of(ops), now};
    const bool joins = join && last_edit_ && last_edit_->label == edit.label &&
                       last_edit_->paths == edit.paths && now >= last_edit_->time &&
                       now - last_edit_->time <= joining_time;
    if (write(Change{utc_text(now), edit.label, edit.paths, joins, result.splices, content_hash(text_),
                     content_hash(result.text)},
              result.text)) {
      last_edit_ = join ? std::optional(std::move(edit)) : std::nullopt;
      return true;
    }
  }
  throw InputError(file_.path().string(), "is being changed by another program",
                   "try again when it has ended");
}

void Project::undo() {
  if (position() > 0) go(position() - 1);
}

void Project::redo() {
  if (position() < history_->timeline().steps().size()) go(position() + 1);
}

void Project::go(std::size_t position) {
  const Timeline& timeline = history_->timeline();
  const bool has_changed = look(true);
  expect_unlocked();
  const auto refuse = [&] {
    throw InputError(file_.path().string(), "was changed outside at the same time",
                     "look at the change first");
  };
  if (has_changed) refuse();
  if (position > timeline.steps().size())
    throw InputError("the history", fmt::format("has {}", counted(timeline.steps().size(), "step")));
  if (position == timeline.position()) return;
  const std::string text = timeline.text_at(position, text_);
  file_.expect_valid(text);
  last_edit_.reset();
  if (!write(Move{utc_text(options_.now()), position, content_hash(text_), content_hash(text)}, text)) {
    look(true);
    refuse();
  }
}

std::vector<Step> Project::steps() const {
  std::vector<Step> steps;
  for (const Timeline::Changes& changes : history_->timeline().steps())
    steps.push_back({changes.back().label, changes.back().time});
  return steps;
}

void Project::restore_mine() {
  look(true);
  if (is_gone()) throw gone();
  if (!locked_) return;
  if (stamp_of(file_.path())) file_.set_aside();
  known_ = file_.put(text_);
  is_settled_ = false;
  locked_.reset();
}

}  // namespace shelfbeam::serve
