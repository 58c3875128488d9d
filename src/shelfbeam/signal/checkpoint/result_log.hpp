#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "shelfbeam/signal/checkpoint/checkpoint_identity.hpp"

namespace shelfbeam {

namespace detail {
class RecordWriter;
}

/// Results of the finished steps of a long run, in a file from which an interrupted run continues
/// (docs/formats/checkpoint.md). Each result has a key, a hash of all that determines it within the identity.
class ResultLog {
 public:
  /// With `resumes`, reads the results of an earlier run, if the file exists. Without a path, nothing is
  /// kept. Throws InputError as CheckpointFile and its `load`.
  ResultLog(std::filesystem::path path, CheckpointIdentity identity, bool resumes, double interval_s);
  ~ResultLog();
  ResultLog(const ResultLog&) = delete;
  ResultLog& operator=(const ResultLog&) = delete;

  /// The result of an earlier run.
  std::optional<std::string_view> find(std::uint64_t key) const;
  /// Appends a result; the file contains it `interval_s` later at the latest, if more are added, or after
  /// `flush`. If the file cannot be written, it keeps the earlier results, and the run goes without a log.
  void add(std::uint64_t key, std::string_view result);
  void flush();

 private:
  void begin();
  void stop();

  std::filesystem::path path_;
  CheckpointIdentity identity_;
  double interval_s_;
  std::unordered_map<std::uint64_t, std::string> earlier_;
  std::unique_ptr<detail::RecordWriter> writer_;
  std::chrono::steady_clock::time_point flushed_at_ = std::chrono::steady_clock::now();
};

}  // namespace shelfbeam
