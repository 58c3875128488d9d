#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "serve/project/record.hpp"

namespace shelfbeam::serve {

/// The steps of a project's history, of which the first are applied and the others undone. A step has one
/// change, or several that follow one another quickly.
class Timeline {
 public:
  using Changes = std::vector<Change>;

  /// `hash` is that of the text before the first step.
  explicit Timeline(std::string hash = {}) : begin_(std::move(hash)) {}

  /// The number of applied steps.
  std::size_t position() const { return position_; }
  const std::vector<Changes>& steps() const { return steps_; }

  /// Adds a change behind the applied steps; what is undone cannot be redone any more.
  void add(Change change);
  /// Precondition: `position` is at most the number of steps.
  void move(std::size_t position) { position_ = position; }
  /// Forgets the oldest steps. Precondition: they are applied.
  void forget(std::size_t count);

  /// The content hash of the text with the first `position` steps.
  const std::string& hash_at(std::size_t position) const;
  /// That text, from the present one. Throws InputError if the changes do not lead to it.
  std::string text_at(std::size_t position, std::string_view present) const;

 private:
  std::string begin_;
  std::vector<Changes> steps_;
  std::size_t position_ = 0;
};

}  // namespace shelfbeam::serve
