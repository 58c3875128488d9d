#pragma once

#include <optional>
#include <string>
#include <utility>

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

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
