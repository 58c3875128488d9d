#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint_records.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {
namespace fs = std::filesystem;

using detail::RecordReader;
using detail::RecordWriter;
using detail::state_size;

namespace {

constexpr std::string_view any_version = "shelfbeam checkpoint ",
                           checkpoint_line = "shelfbeam checkpoint 1\n";

std::string to_text(const CheckpointIdentity& identity) {
  std::string text;
  for (const auto& [name, value] : identity) text += fmt::format("{}: {}\n", name, value);
  return text;
}

// The value of a name in a text from `to_text`.
std::string value_of(std::string_view text, const std::string& name) {
  const std::string begin = name + ": ";
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with(begin)) return std::string(line.substr(begin.size()));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return "unknown";
}

}  // namespace

CheckpointFile::CheckpointFile(fs::path path, CheckpointIdentity identity, std::uint32_t items)
    : path_(std::move(path)), identity_(std::move(identity)), saved_(items) {
  std::error_code unknown;
  const fs::file_status found = fs::symlink_status(path_, unknown);
  if (!fs::exists(found)) return;
  if (!fs::is_regular_file(found) ||
      !detail::read_first_bytes(path_, any_version.size()).starts_with(any_version))
    throw InputError(path_.string(), "is not a checkpoint, though its name is that of one",
                     "move it elsewhere, or choose another output");
}

CheckpointFile::~CheckpointFile() = default;

bool CheckpointFile::load(const std::function<void(std::uint32_t, const CheckpointState&)>& use) {
  std::error_code unknown;
  if (!fs::exists(path_, unknown)) return false;
  RecordReader file(path_);
  if (!file.line(checkpoint_line))
    throw InputError(path_.string(), "is not a checkpoint of this program version",
                     "delete it, or start again without resuming", Setting::resumption);
  const auto first = file.next();
  if (!first) file.fail();
  const std::string found(*first);
  for (const auto& [name, value] : identity_)
    if (const std::string theirs = value_of(found, name); theirs != value)
      throw InputError(path_.string(),
                       fmt::format("belongs to another simulation: its {} is {} instead of {}", name,
                                   in_quotes(theirs), in_quotes(value)),
                       "resume with the same store and options, or start again without resuming",
                       Setting::resumption);
  if (found != to_text(identity_)) file.fail();

  std::vector<double> values;
  while (const auto record = file.next()) {
    std::uint32_t numbers[2];
    if (record->size() < sizeof numbers || (record->size() - sizeof numbers) % sizeof(double) != 0)
      file.fail();
    std::memcpy(numbers, record->data(), sizeof numbers);
    if (numbers[0] >= saved_.size()) file.fail();
    values.resize((record->size() - sizeof numbers) / sizeof(double));
    if (!values.empty())
      std::memcpy(values.data(), record->data() + sizeof numbers, values.size() * sizeof(double));
    use(numbers[0], {numbers[1], values});
    saved_[numbers[0]] = numbers[1];
  }
  size_ = file.valid_size();
  return true;
}

void CheckpointFile::save(const std::function<CheckpointState(std::uint32_t)>& state) {
  std::uint64_t alive = 0, added = 0;
  for (std::uint32_t item = 0; item < saved_.size(); ++item) {
    const CheckpointState now = state(item);
    if (now.batches == 0) continue;
    const std::uint64_t size = state_size(now.values.size());
    alive += size;
    if (now.batches != saved_[item]) added += size;
  }
  if (added == 0) return;
  if (!writer_ || !writer_->is_at(path_) || size_ + added > 2 * alive)
    rewrite(state);
  else
    append(state);
  size_ = writer_->written();
  for (std::uint32_t item = 0; item < saved_.size(); ++item) saved_[item] = state(item).batches;
}

void CheckpointFile::append(const std::function<CheckpointState(std::uint32_t)>& state) {
  writer_->truncate(size_);  // remains of a failed write
  for (std::uint32_t item = 0; item < saved_.size(); ++item)
    if (const CheckpointState now = state(item); now.batches != saved_[item]) writer_->state(item, now);
  writer_->flush();
}

void CheckpointFile::rewrite(const std::function<CheckpointState(std::uint32_t)>& state) {
  AtomicFile file(path_);
  auto writer = std::make_unique<RecordWriter>(file.temporary(), path_.string());
  writer->line(checkpoint_line);
  writer->record(to_text(identity_));
  for (std::uint32_t item = 0; item < saved_.size(); ++item)
    if (const CheckpointState now = state(item); now.batches > 0) writer->state(item, now);
  writer->flush();
  file.commit();
  writer_ = std::move(writer);
}

fs::path checkpoint_path(const fs::path& output) {
  return output.string() + ".checkpoint";
}

void remove_checkpoint(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
  remove_abandoned(path);
}

}  // namespace shelfbeam
