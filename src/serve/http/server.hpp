#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shelfbeam/base/files/descriptor.hpp"

#include "serve/http/message.hpp"
#include "serve/http/options.hpp"

namespace shelfbeam::serve::http {

/// A server for one user's browser: files and documents by GET, and a WebSocket per page. Every address
/// begins with the token, and what the gate refuses, no handler sees. It has no threads of its own.
///
/// `stop` may be called from any thread; all other members are for handlers, and for the thread that calls
/// `run`.
class Server {
 public:
  /// Listens from now on. Throws InputError for an address, port, token or name of a host that cannot be
  /// used.
  Server(Options options, Handlers handlers);
  /// Serves one connected stream socket instead of listening; `run` returns when it has
  /// ended. `options.port` is the port that the client believes to talk to.
  Server(Options options, Handlers handlers, Descriptor connection);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const;
  const std::string& token() const;
  /// "http://127.0.0.1:8080/TOKEN/". Of a server that listens on all addresses, first the one for this
  /// computer, then those for others.
  std::vector<std::string> addresses() const;

  /// Serves until `stop`. Then pages are closed with code 1001, and it returns as soon as they have gone, at
  /// the latest after `Limits::farewell`.
  void run();
  void stop();

  /// Sends a message to a page; nothing happens if it has gone. A page that does not take its messages in
  /// time, or for which too many wait, is closed with code 1013: it can connect again and be sent everything
  /// anew.
  void send(TabId tab, Message message);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace shelfbeam::serve::http
