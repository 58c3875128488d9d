// What a page sends through its WebSocket to the planner's server.

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

#include "reader.hpp"
#include "served_bytes.hpp"
#include "unit/serve/http/frame.hpp"

namespace shelfbeam::fuzz {

namespace {

using test::Frame;
using test::Opcode;

constexpr std::string_view handshake =
    "GET /0123456789abcdef/socket HTTP/1.1\r\nHost: localhost:8080\r\nOrigin: http://localhost:8080\r\n"
    "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";

void expect(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

void fuzz_websocket(std::string_view bytes) {
  serve::http::Server* server = nullptr;
  int closed = 0;
  std::string failure;
  serve::http::Handlers handlers;
  handlers.text = [&](serve::http::TabId tab, std::string_view text) {
    expect(text.size() <= 4096, "a message is larger than allowed");
    expect(is_utf8(text), "a message is not UTF-8");
    if (text == "throw") throw InputError("message", "is refused by its handler");
    for (int i = 0; i < (text == "many" ? 10 : 1); ++i)
      server->send(tab, text == "many" ? serve::http::Message::binary(std::string(2000, 'x'))
                                       : serve::http::Message::text(std::string(text)));
  };
  handlers.closed = [&](serve::http::TabId) { ++closed; };
  handlers.failed = [&](std::string_view what) {
    if (what.find("is refused") == std::string_view::npos) failure = what;
  };
  std::string answer = served_bytes(handshake, bytes.empty() ? " " : bytes, std::move(handlers), server);

  expect(answer.starts_with("HTTP/1.1 101 "), "the WebSocket is not opened");
  expect(failure.empty(), failure.c_str());
  expect(closed == 1, "the page is not closed once");
  answer.erase(0, answer.find("\r\n\r\n") + 4);
  unsigned code = 1000;
  while (const std::optional<Frame> frame = test::take_frame(answer)) {
    expect(!frame->is_masked && frame->reserved == 0, "the server sends a wrong frame");
    expect(frame->opcode != Opcode::text || is_utf8(frame->payload), "the server sends a wrong text");
    if (frame->opcode == Opcode::close) code = frame->code();
  }
  expect(answer.empty(), "the server sends half a frame");
  if (code >= 1002 && code != 1005) throw InputError("websocket", "is closed");
}

std::vector<std::string> websocket_seeds() {
  const auto text = [](std::string content) { return Frame{.payload = std::move(content)}.bytes(); };
  const std::string begin = Frame{.payload = "begin", .is_last = false}.bytes();
  const std::string end = Frame{.opcode = Opcode::continuation, .payload = "end"}.bytes();
  const std::string ping = Frame{.opcode = Opcode::ping, .payload = "?"}.bytes();
  const std::string close = Frame{.opcode = Opcode::close, .payload = "\x03\xe8goodbye"}.bytes();
  return {text(R"({"id": 1, "do": "undo"})") + close,
          begin + ping + end + close,
          begin + begin,
          text(std::string(200, 'x')) + text("") + close,
          text(std::string(4096, 'x')),
          text(std::string(5000, 'x')),
          text("many") + text("many"),
          text("throw"),
          text("\xc3\xa4\xe2\x82\xac"),
          text("\xff"),
          Frame{.opcode = Opcode::binary, .payload = "x"}.bytes(),
          Frame{.opcode = Opcode::pong}.bytes() + ping + ping,
          Frame{.payload = "x", .reserved = 4}.bytes(),
          Frame{.payload = "x", .declared_size = std::uint64_t{1} << 63U}.bytes(),
          close + text("late")};
}

// Makes masked frames without reserved bits, the last of which ends with the bytes.
void repair_websocket(std::string& bytes) {
  for (std::size_t at = 0; at + 6 <= bytes.size();) {
    bytes[at] = static_cast<char>(bytes[at] & 0x8f);
    std::size_t size = static_cast<unsigned char>(bytes[at + 1]) & 127U;
    std::size_t head = 6;
    if (size > 125) {
      if (size == 127 || at + 8 > bytes.size()) return;
      size = static_cast<unsigned char>(bytes[at + 2]) * 256U + static_cast<unsigned char>(bytes[at + 3]);
      head = 8;
    } else if (at + head + size > bytes.size()) {
      size = bytes.size() - at - head;
      if (size > 125) return;
      bytes[at + 1] = static_cast<char>(size);
    }
    bytes[at + 1] = static_cast<char>(bytes[at + 1] | 0x80);
    at += head + size;
  }
}

}  // namespace

extern const Reader websocket;
const Reader websocket{"websocket", fuzz_websocket, websocket_seeds, repair_websocket};

}  // namespace shelfbeam::fuzz
