#pragma once

#include <chrono>
#include <thread>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json_parser.hpp"

#include "serve/text/edit.hpp"
#include "support/testing.hpp"

namespace shelfbeam::test {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// A limit of this process, for example of open files, until the end of the scope.
class ProcessLimit {
 public:
  using Resource = decltype(RLIMIT_NOFILE);
  ProcessLimit(Resource resource, rlim_t value) : resource_(resource) {
    ::getrlimit(resource, &before_);
    const rlimit limit{std::min(value, before_.rlim_max), before_.rlim_max};
    ::setrlimit(resource, &limit);
  }
  ~ProcessLimit() { ::setrlimit(resource_, &before_); }
  ProcessLimit(const ProcessLimit&) = delete;
  ProcessLimit& operator=(const ProcessLimit&) = delete;

 private:
  Resource resource_;
  rlimit before_{};
};

/// Waits until another thread or process has made it true, for at most two minutes.
template <class Condition>
bool becomes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + seconds(120);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return true;
}

}  // namespace shelfbeam::test

namespace shelfbeam::serve {

using namespace test;

inline EditOp to_set(const std::string& path, Json before, Json after) {
  return {path, std::move(before), std::move(after)};
}
inline EditOp to_insert(const std::string& path, Json after) {
  return {path, std::nullopt, std::move(after)};
}
inline EditOp to_remove(const std::string& path, Json before) {
  return {path, std::move(before), std::nullopt};
}

}  // namespace shelfbeam::serve
