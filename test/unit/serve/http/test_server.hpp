#pragma once

#include <atomic>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "shelfbeam/base/files/open_file.hpp"

#include "serve/http/server.hpp"
#include "support/sanitizers.hpp"
#include "unit/serve/http/frame.hpp"
#include "unit/serve/testing.hpp"

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

inline constexpr auto test_token = "0123456789abcdef0123456789abcdef";

/// A server on a thread of its own. Pages may say "size N" to get N bytes, "throw", or anything else, which
/// comes back.
class RunningServer {
 public:
  explicit RunningServer(serve::http::Limits limits = {}, std::vector<std::string> hosts = {})
      : server_(options(limits, std::move(hosts)), handlers()), thread_([this] { server_.run(); }) {}
  ~RunningServer() { stop(); }
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;

  /// Returns when `run` has.
  void stop() {
    server_.stop();
    if (thread_.joinable()) thread_.join();
  }

  std::uint16_t port() const { return server_.port(); }
  std::string host() const { return fmt::format("127.0.0.1:{}", port()); }

  /// A request as a browser sends it. `fields`: further ones, each with its end of line.
  std::string request(std::string_view name, std::string_view fields = {},
                      std::string_view method = "GET") const {
    return fmt::format("{} /{}/{} HTTP/1.1\r\nHost: {}\r\n{}\r\n", method, test_token, name, host(), fields);
  }
  /// `fields`: further ones.
  std::string handshake(std::string_view fields = {}) const {
    return request("socket", fmt::format("Origin: http://{}\r\n{}{}", host(), upgrade, fields));
  }

  /// The answer to a request on a connection of its own; empty if there is none.
  std::string ask(std::string_view bytes) const {
    Client client(port());
    client.send(bytes);
    return client.answer();
  }

  /// A page with an open WebSocket.
  Client tab(int receive_buffer = 0, std::string_view fields = {}) const {
    Client client(port(), receive_buffer);
    client.send(handshake(fields));
    if (!client.answer().starts_with("HTTP/1.1 101")) throw std::runtime_error("the WebSocket does not open");
    return client;
  }

  /// Whether a page and a new request are still answered.
  bool answers(Client& page) const {
    return page.send(Frame{.payload = "still there?"}) && page.message() == "still there?" &&
           ask(request("page.txt")).ends_with("the page");
  }

  static constexpr std::string_view upgrade =
      "Connection: keep-alive, Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

  std::atomic<int> opened = 0, closed = 0, failed = 0, ticks = 0;

 private:
  static serve::http::Options options(const serve::http::Limits& limits, std::vector<std::string> hosts) {
    serve::http::Options options{.token = test_token, .hosts = std::move(hosts), .limits = limits};
    options.tick = milliseconds(10);
    options.assets.emplace("", serve::http::Asset("text/html; charset=utf-8", "<!doctype html>"));
    options.assets.emplace("page.txt", serve::http::Asset("text/plain", "the page"));
    return options;
  }

  serve::http::Handlers handlers() {
    using serve::http::Message;
    return {.opened = [this](serve::http::TabId) { ++opened; },
            .text = [this](serve::http::TabId tab, std::string_view text) { answer(tab, text); },
            .closed = [this](serve::http::TabId) { ++closed; },
            .get = [](std::string_view name) -> std::optional<serve::http::Document> {
              if (name == "throw") throw std::runtime_error("a secret detail");
              if (name == "large")
                return serve::http::Document{"text/plain",
                                             std::make_shared<const std::string>(std::size_t{32} << 20, 'x')};
              if (name != "made") return std::nullopt;
              return serve::http::Document{"application/json", std::make_shared<const std::string>("{}")};
            },
            .spool = [] { return open_unnamed(std::filesystem::temp_directory_path()); },
            .put =
                [](std::string_view name, std::string_view content) {
                  return name == "files/bad.png"
                             ? serve::http::Receipt{false, "no picture"}
                             : serve::http::Receipt{true,
                                                    fmt::format("{} bytes of {}", content.size(), name)};
                },
            .tick = [this] { ++ticks; },
            .failed = [this](std::string_view) { ++failed; }};
  }

  void answer(serve::http::TabId tab, std::string_view text) {
    using serve::http::Message;
    if (text == "throw") throw std::runtime_error("a secret detail");
    if (text.starts_with("size ")) {
      server_.send(tab, Message::binary(std::string(std::stoul(std::string(text.substr(5))), 'x')));
    } else {
      server_.send(tab, Message::text(std::string(text)));
    }
  }

  serve::http::Server server_;
  std::thread thread_;
};

/// A server with an open page, which must still be answered after the attack of the test. Server and attacker
/// together, which are this process, may not grow by 300 MB.
class AttackedServer : public testing::Test {
 protected:
  AttackedServer() : AttackedServer(serve::http::Limits{}) {}
  explicit AttackedServer(const serve::http::Limits& limits) : server(limits), page(server.tab()) {
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins anew
  }

  void TearDown() override {
    EXPECT_TRUE(server.answers(page)) << "after the attack";
    EXPECT_EQ(server.failed, 0);
    const long growth = peak_memory() - memory_before_;
    RecordProperty("kilobytes", static_cast<int>(growth));
    if (memory_can_be_limited) {
      EXPECT_LT(growth, 300 << 10) << "kB";
    }
  }

  /// Sends a request, and expects that it is refused and its connection closed.
  void expect_refused(const std::string& bytes, const std::string& status) const {
    Client client(server.port());
    client.send(bytes);
    const std::string answer = client.rest();
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 " + status + " ")) << bytes.substr(0, 300);
    EXPECT_THAT(answer, testing::HasSubstr("\r\nConnection: close\r\n"));
    EXPECT_EQ(answer.find("HTTP/1.1", 1), std::string::npos) << "one answer only";
  }

  /// Expects that the same bytes are answered: without that, a refusal would prove nothing.
  void expect_let_in(const std::string& bytes, const std::string& status = "200") const {
    EXPECT_THAT(server.ask(bytes), testing::StartsWith("HTTP/1.1 " + status + " ")) << bytes;
  }

  /// Largest memory of this process since the attack began, in kB.
  static long peak_memory() { return memory("VmHWM:"); }

 private:
  static long memory(std::string_view name) {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;)
      if (word == name && file >> word) return std::stol(word);
    return 0;
  }

  long memory_before_ = memory("VmRSS:");

 protected:
  RunningServer server;
  Client page;
};

}  // namespace shelfbeam::test
