#pragma once

#include <cstddef>
#include <exception>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/finding/finding.hpp"

namespace shelfbeam {

/// Thrown for a reference to an element that has problems itself: the reference is not reported.
struct Consequence {};

/// The problems of a store file that is read to its end.
class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  /// Calls `read` and keeps the InputError that it throws, unless it concerns a limit of memory. Returns
  /// whether it succeeded.
  template <class Read>
  bool collect(Read read) {
    try {
      read();
      return true;
    } catch (const InputError& error) {
      if (error.setting() == Setting::memory) throw;  // the rest would exceed the limit, too
      keep(error);
    } catch (const Consequence&) {
      ++failures_;
    }
    return false;
  }
  void keep(const InputError& error);

  /// Failures so far. Parts of the file without a failure between two calls have been read completely.
  std::size_t failures() const { return failures_; }
  /// In the order of their discovery, without repetitions; at most 1000.
  const std::vector<Finding>& all() const { return all_; }
  /// Throws the first problem, if any, as it was thrown.
  void throw_first() const {
    if (first_) std::rethrow_exception(first_);
  }

  /// Notes that a part of the store ("room", "material") or an element with this id is not known completely.
  void mark(const std::string& incomplete) { incomplete_.insert(incomplete); }
  /// Throws Consequence if this was noted.
  void expect_complete(const std::string& part) const {
    if (incomplete_.contains(part)) throw Consequence{};
  }

 private:
  std::string file_;
  std::vector<Finding> all_;
  std::set<std::string> sentences_, incomplete_;
  std::exception_ptr first_;
  std::size_t failures_ = 0;
};

}  // namespace shelfbeam
