#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string_view>

#include "serve/http/message.hpp"

namespace shelfbeam::serve::http {

/// The messages that a client has not yet taken, sent in fragments so that a slow line shows progress and a
/// dead one shows none.
class Outbox {
 public:
  struct Fragment {
    Message message;
    std::string_view bytes;  ///< part of `message`
    bool is_last = true;     ///< of its message
  };

  /// `most`: bytes that may wait. `fragment`: bytes of the longest fragment, at least 1.
  Outbox(std::size_t most, std::size_t fragment) : most_(most), fragment_(fragment) {}

  /// Adds a message. False, without adding it, if it and those that wait exceed the limit. The message that
  /// is being sent does not count, and a message of any size may be the only one that waits.
  bool push(Message message);

  /// Takes the next fragment; nothing if everything is sent.
  std::optional<Fragment> next();

  /// Drops what waits, and the rest of the message that is being sent.
  void clear();

 private:
  std::size_t most_, fragment_, waiting_ = 0;  // bytes of `messages_`
  std::deque<Message> messages_;
  Message current_;
  std::size_t sent_ = 0;  // bytes of `current_`
};

}  // namespace shelfbeam::serve::http
