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

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint_records.hpp"

namespace shelfbeam {
namespace fs = std::filesystem;

using detail::RecordReader;
using detail::RecordWriter;
using detail::state_size;

namespace {

constexpr std::string_view any_version = "shelfbeam checkpoint ",
                           checkpoint_line = "shelfbeam checkpoint 1\n";

}  // namespace

CheckpointFile::CheckpointFile(fs::path path, CheckpointIdentity identity, std::uint32_t items)
    : path_(std::move(path)), identity_(std::move(identity)), saved_(items) {
  detail::expect_checkpoint(path_, any_version);
}

CheckpointFile::~CheckpointFile() = default;

bool CheckpointFile::load(const std::function<void(std::uint32_t, const CheckpointState&)>& use) {
  std::error_code unknown;
  if (!fs::exists(path_, unknown)) return false;
  RecordReader file(path_);
  detail::expect_head(file, checkpoint_line, identity_, path_);

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
  writer->record(detail::to_text(identity_));
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
