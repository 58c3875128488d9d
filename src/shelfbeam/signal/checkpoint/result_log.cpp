#include "shelfbeam/signal/checkpoint/result_log.hpp"

#include <cstring>
#include <system_error>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint_records.hpp"

namespace shelfbeam {

using detail::RecordReader;
using detail::RecordWriter;

namespace {

constexpr std::string_view any_results = "shelfbeam results ", results_line = "shelfbeam results 1\n";

std::string record_of(std::uint64_t key, std::string_view result) {
  std::string record(reinterpret_cast<const char*>(&key), sizeof key);
  record += result;
  return record;
}

}  // namespace

ResultLog::ResultLog(std::filesystem::path path, CheckpointIdentity identity, bool resumes, double interval_s)
    : path_(std::move(path)), identity_(std::move(identity)), interval_s_(interval_s) {
  if (path_.empty()) return;
  detail::expect_checkpoint(path_, any_results);
  std::error_code unknown;
  if (!resumes || !std::filesystem::exists(path_, unknown)) return;
  RecordReader file(path_);
  detail::expect_head(file, results_line, identity_, path_);
  while (const auto record = file.next()) {
    std::uint64_t key = 0;
    if (record->size() < sizeof key) file.fail();
    std::memcpy(&key, record->data(), sizeof key);
    earlier_[key] = record->substr(sizeof key);
  }
}

ResultLog::~ResultLog() {
  flush();
}

std::optional<std::string_view> ResultLog::find(std::uint64_t key) const {
  const auto found = earlier_.find(key);
  if (found == earlier_.end()) return std::nullopt;
  return found->second;
}

// A new file with the earlier results, because a process appends only to a file that it has created.
void ResultLog::begin() {
  AtomicFile file(path_);
  writer_ = std::make_unique<RecordWriter>(file.temporary(), path_.string());
  writer_->line(results_line);
  writer_->record(detail::to_text(identity_));
  for (const auto& [key, result] : earlier_) writer_->record(record_of(key, result));
  writer_->flush();
  file.commit();
}

void ResultLog::add(std::uint64_t key, std::string_view result) {
  if (path_.empty()) return;
  try {
    if (!writer_) begin();
    writer_->record(record_of(key, result));
  } catch (const OutputError&) {
    stop();
  }
  const auto since = std::chrono::steady_clock::now() - flushed_at_;
  if (std::chrono::duration<double>(since).count() >= interval_s_) flush();
}

void ResultLog::flush() {
  flushed_at_ = std::chrono::steady_clock::now();
  if (!writer_) return;
  try {
    writer_->flush();
  } catch (const OutputError&) {
    stop();
  }
}

// A full disk must not end a run whose results are needed without it.
void ResultLog::stop() {
  writer_.reset();
  path_.clear();
}

}  // namespace shelfbeam
