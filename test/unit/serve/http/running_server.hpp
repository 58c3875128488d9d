#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/files/open_file.hpp"

#include "serve/http/server.hpp"
#include "unit/serve/http/client.hpp"

namespace shelfbeam::test {

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
    options.tick = std::chrono::milliseconds(10);
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

}  // namespace shelfbeam::test
