#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "shelfbeam/base/files/descriptor.hpp"

#include "serve/http/gate.hpp"
#include "serve/http/message.hpp"
#include "serve/http/options.hpp"
#include "serve/http/reply.hpp"
#include "serve/http/request.hpp"

namespace boost::asio {
class io_context;
}

namespace shelfbeam::serve::http {

/// What a session asks its server, and tells it. Nothing throws.
class SessionHost {
 public:
  virtual ~SessionHost() = default;
  virtual const Limits& limits() const = 0;
  virtual Verdict judge(const Request& request) = 0;
  /// The answer to a request that was let in and does not open the WebSocket.
  virtual Reply reply(const Request& request, const Verdict& verdict) = 0;
  /// Opens a file for the bytes of an upload; otherwise the answer says why there is none.
  virtual std::optional<Reply> spool(std::uint64_t size, Descriptor& file) = 0;
  /// The answer to an upload whose bytes are in the file.
  virtual Reply receive(const std::string& name, const Descriptor& file, std::uint64_t size) = 0;
  /// These two return false if the page is to be closed because its handler failed.
  virtual bool opened(TabId id) = 0;
  virtual bool text(TabId id, std::string_view message) = 0;
  /// The last call of a session.
  virtual void ended(TabId id, bool was_open) = 0;
};

/// Codes of RFC 6455 with which a WebSocket ends.
enum class CloseCode : std::uint16_t {
  going_away = 1001,
  unknown_data = 1003,
  internal_error = 1011,
  try_again_later = 1013
};

/// Which sessions go first when there are too many.
enum class Standing {
  stranger,  ///< has not shown the token
  waiting,   ///< has shown it, and has no request under way
  answered,  ///< has a request under way
  open       ///< is a page with a WebSocket
};

/// One connection. It first reads requests; one of them may open the WebSocket.
class Session {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~Session() = default;
  virtual void start() = 0;
  virtual Standing standing() const = 0;
  /// When the client must have done what is next.
  virtual Clock::time_point deadline() const = 0;
  /// Bytes of the file that is being received.
  virtual std::uint64_t upload() const = 0;
  /// Queues a message for an open page. A page that does not take its messages is closed.
  virtual void send(Message message) = 0;
  /// Closes the WebSocket with a code; ends any other connection at once.
  virtual void close(CloseCode code) = 0;
  /// Ends the connection at once.
  virtual void abort() = 0;
};

/// A session on a connected stream socket. `host` must outlive the context.
std::shared_ptr<Session> make_session(boost::asio::io_context& context, Descriptor connection, TabId id,
                                      SessionHost& host);

}  // namespace shelfbeam::serve::http
