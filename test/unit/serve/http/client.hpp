#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "frame.hpp"

namespace shelfbeam::test {

/// A bare TCP connection to a server on this computer, which sends whatever bytes a test wants. It waits for
/// bytes for at most 20 s.
class Client {
 public:
  /// `receive_buffer`: bytes that the kernel keeps for it; 0: as usual.
  explicit Client(std::uint16_t port, int receive_buffer = 0)
      : descriptor_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer > 0)
      ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    const timeval patience{20, 0};
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(descriptor_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    const int on = 1;
    ::setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      ::close(descriptor_);
      throw std::runtime_error("cannot connect");
    }
  }
  ~Client() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Client(Client&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)), unread_(std::move(other.unread_)) {}
  Client& operator=(Client&&) = delete;

  /// False if the server has closed the connection.
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  bool send(const Frame& frame) const { return send(frame.bytes()); }

  /// Everything up to the end of the connection.
  std::string rest() {
    while (receive()) continue;
    return std::exchange(unread_, {});
  }

  /// The next answer: head and body. `has_body`: false after a HEAD.
  std::string answer(bool has_body = true) {
    std::size_t end = 0;
    while ((end = unread_.find("\r\n\r\n")) == std::string::npos)
      if (!receive()) return std::exchange(unread_, {});
    end += 4;
    const std::size_t field = unread_.find("Content-Length: ");
    const std::size_t size = has_body && field < end ? std::stoul(unread_.substr(field + 16)) : 0;
    while (unread_.size() < end + size && receive()) continue;
    std::string taken = unread_.substr(0, end + size);
    unread_.erase(0, end + size);
    return taken;
  }

  /// The next frame; nothing at the end of the connection.
  std::optional<Frame> frame() {
    while (true) {
      if (std::optional<Frame> found = take_frame(unread_)) return found;
      if (!receive()) return std::nullopt;
    }
  }

  /// The next whole message, of all its fragments, without pings and pongs. Nothing if the connection is
  /// closed.
  std::optional<std::string> message() {
    std::string text;
    while (true) {
      const std::optional<Frame> next = frame();
      if (!next || next->opcode == Opcode::close) return std::nullopt;
      if (next->opcode == Opcode::ping || next->opcode == Opcode::pong) continue;
      text += next->payload;
      if (next->is_last) return text;
    }
  }

  /// The code with which the server closes the WebSocket; 0 if it ends without one.
  unsigned close_code() {
    while (true) {
      const std::optional<Frame> next = frame();
      if (!next) return 0;
      if (next->opcode == Opcode::close) return next->code();
    }
  }

 private:
  bool receive() {
    char bytes[65536];
    const ssize_t got = ::recv(descriptor_, bytes, sizeof bytes, 0);
    if (got <= 0) return false;
    unread_.append(bytes, static_cast<std::size_t>(got));
    return true;
  }

  int descriptor_;
  std::string unread_;
};

}  // namespace shelfbeam::test
