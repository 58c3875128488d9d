#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include <nlohmann/json.hpp>

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

/// Random JSON values, texts of them with comments in many layouts, and edits.
class RandomJson {
 public:
  explicit RandomJson(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return random_() % count; }
  Json value(std::size_t levels);
  /// A text that reads as the value.
  std::string text(const Json& value);
  /// An operation that fits the value.
  EditOp op(const Json& value);

 private:
  std::string key();
  std::string gap();
  std::string line_gap();
  void write(const Json& value, std::size_t level, std::string& text);

  std::mt19937_64 random_;
  std::size_t layout_ = 0;
  std::string line_end_;
};

}  // namespace shelfbeam::serve
