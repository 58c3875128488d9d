#pragma once

#include <memory>
#include <string>
#include <utility>

namespace shelfbeam::serve::http {

/// Bytes that are sent, perhaps to several clients at once, and never change.
using Bytes = std::shared_ptr<const std::string>;

/// A message to a page through its WebSocket.
struct Message {
  Bytes bytes;
  bool is_text = true;  ///< UTF-8; otherwise a binary message

  static Message text(std::string bytes) {
    return {std::make_shared<const std::string>(std::move(bytes)), true};
  }
  static Message binary(std::string bytes) {
    return {std::make_shared<const std::string>(std::move(bytes)), false};
  }
};

}  // namespace shelfbeam::serve::http
