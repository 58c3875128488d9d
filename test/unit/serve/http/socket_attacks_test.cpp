// Pages that misuse their WebSocket.

#include <atomic>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/serve/http/attacked_server.hpp"

namespace shelfbeam::test {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t largest = 1 << 20;

class SocketAttack : public AttackedServer {
 protected:
  using AttackedServer::AttackedServer;

  // Expects that the server closes a page that sends this. 0: without a code.
  void expect_closed(const std::string& bytes, unsigned code, const std::string& why) const {
    Client other = server.tab();
    other.send(bytes);
    EXPECT_EQ(other.close_code(), code) << why;
  }
};

TEST_F(SocketAttack, ByAWrongFrameClosesThePage) {
  EXPECT_TRUE(server.answers(page));
  constexpr unsigned protocol_error = 1002, bad_data = 1003, bad_text = 1007;
  const auto expect = [&](const Frame& frame, unsigned code, const std::string& why) {
    expect_closed(frame.bytes(), code, why);
  };
  expect({.payload = "x", .is_masked = false}, protocol_error, "not masked");
  for (const unsigned reserved : {1U, 2U, 4U, 7U})
    expect({.payload = "x", .reserved = reserved}, protocol_error, "reserved bits");
  for (const unsigned opcode : {3U, 7U, 11U, 15U})
    expect({.opcode = static_cast<Opcode>(opcode), .payload = "x"}, protocol_error, "reserved opcode");
  expect({.opcode = Opcode::continuation, .payload = "x"}, protocol_error, "continues nothing");
  expect_closed(Frame{.payload = "x", .is_last = false}.bytes() + Frame{.payload = "y"}.bytes(),
                protocol_error, "begins within a message");
  expect({.opcode = Opcode::binary, .payload = "x"}, bad_data, "binary");
  expect({.payload = "\xff"}, bad_text, "not UTF-8");
  expect({.payload = "\xc3"}, bad_text, "half a character");
  expect({.payload = "\xed\xa0\x80"}, bad_text, "a surrogate");
  for (const Opcode opcode : {Opcode::ping, Opcode::pong, Opcode::close}) {
    expect({.opcode = opcode, .payload = std::string(126, 'x')}, protocol_error, "large control frame");
    expect({.opcode = opcode, .is_last = false}, protocol_error, "control frame in fragments");
  }
  expect({.opcode = Opcode::close, .payload = "x"}, protocol_error, "half a code");
  expect({.opcode = Opcode::close, .payload = "\x03\xe7"}, protocol_error, "code 999");
  expect({.opcode = Opcode::close, .payload = "\x03\xed"}, protocol_error, "code 1005");
  expect({.opcode = Opcode::close, .payload = "\x03\xe8\xff"}, protocol_error, "reason that is not UTF-8");
}

TEST_F(SocketAttack, ByALargeMessageClosesThePage) {
  constexpr unsigned too_large = 1009;
  const std::string most(largest, 'x');
  page.send(Frame{.payload = most});
  EXPECT_EQ(page.message(), most);
  expect_closed(Frame{.payload = most + "x"}.bytes(), too_large, "one byte more");
  expect_closed(Frame{.payload = std::string(5 << 20, 'x')}.bytes(), too_large, "5 MB");
  for (const std::uint64_t size : {std::uint64_t{1} << 32U, std::uint64_t{1} << 62U})
    expect_closed(Frame{.payload = "x", .declared_size = size}.bytes(), too_large, "declared");
  for (const std::uint64_t size : {std::uint64_t{1} << 63U, ~std::uint64_t{0}}) {
    Client other = server.tab();
    other.send(Frame{.payload = "x", .declared_size = size});
    EXPECT_THAT(other.close_code(), testing::AnyOf(1002u, too_large));
  }
}

TEST_F(SocketAttack, ByFragmentsWithoutEndClosesThePage) {
  const Frame first{.payload = std::string(100'000, 'x'), .is_last = false};
  Frame next = first;
  next.opcode = Opcode::continuation;
  const auto send_fragments = [&](Client& client, int count) {
    client.send(first);
    for (int i = 1; i < count; ++i)
      if (!client.send(next)) return;
  };
  send_fragments(page, 10);
  page.send(Frame{.opcode = Opcode::continuation, .payload = "end"});
  EXPECT_EQ(page.message()->size(), 1'000'003u);
  Client other = server.tab();
  send_fragments(other, 200);
  EXPECT_EQ(other.close_code(), 1009u);
}

TEST_F(SocketAttack, ByEmptyFragmentsDelaysNobody) {
  Client other = server.tab();
  other.send(Frame{.is_last = false});
  std::string flood;
  for (int i = 0; i < 100'000; ++i) flood += Frame{.opcode = Opcode::continuation, .is_last = false}.bytes();
  std::thread sender([&] { other.send(flood); });
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(server.answers(page));
  sender.join();
  other.send(Frame{.opcode = Opcode::continuation, .payload = "end"});
  EXPECT_EQ(other.message(), "end");
}

TEST_F(SocketAttack, ByPingsDelaysNobody) {
  std::string flood;
  for (int i = 0; i < 50'000; ++i)
    flood += Frame{.opcode = Opcode::ping, .payload = std::string(100, 'x')}.bytes();
  // This one does not read the pongs, until the test ends.
  Client other = server.tab(4096);
  std::thread sender([&] { other.send(flood); });
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(server.answers(page));
  int pongs = 0;
  while (pongs < 50'000 && other.frame()->opcode == Opcode::pong) ++pongs;
  sender.join();
  EXPECT_EQ(pongs, 50'000);
}

TEST_F(SocketAttack, ByCompressionIsRefused) {
  Client other(server.port());
  other.send(server.handshake("Sec-WebSocket-Extensions: permessage-deflate; client_max_window_bits\r\n"));
  const std::string answer = other.answer();
  EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 101 "));
  EXPECT_THAT(answer, testing::Not(testing::HasSubstr("Sec-WebSocket-Extensions")));
  EXPECT_THAT(answer, testing::HasSubstr("\r\nContent-Security-Policy: default-src 'none'"));
  EXPECT_THAT(answer, testing::Not(testing::HasSubstr("Beast")));
  // Kilobytes that deflate would turn into megabytes.
  std::string bomb = "\xec\xc1\x01\x01";
  for (int i = 0; i < 1000; ++i) bomb += std::string("\0\0\0\x80\x90\xfe\xaf\xee\x08\x0a\0", 11);
  other.send(Frame{.payload = bomb, .reserved = 4});
  EXPECT_EQ(other.close_code(), 1002u);
}

TEST_F(SocketAttack, ByAWrongHandshakeIsRefused) {
  const auto changed = [&](std::string_view from, std::string_view to) {
    std::string handshake = server.handshake();
    return handshake.replace(handshake.find(from), from.size(), to);
  };
  const auto expect = [&](const std::string& handshake, const std::string& status) {
    Client client(server.port());
    client.send(handshake);
    EXPECT_THAT(client.rest(), testing::HasSubstr(" " + status + " ")) << handshake;
  };
  expect(changed("Sec-WebSocket-Version: 13", "Sec-WebSocket-Version: 8"), "426");
  expect(changed("Sec-WebSocket-Version: 13\r\n", ""), "400");
  expect(changed("Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n", ""), "400");
  expect(changed("Sec-WebSocket-Key: ", "Sec-WebSocket-Key: " + std::string(100, 'x')), "400");
  expect(changed("HTTP/1.1", "HTTP/1.0"), "400");
}

class SilentSocketAttack : public SocketAttack {
 protected:
  SilentSocketAttack()
      : SocketAttack(
            {.write = milliseconds(300), .silence = milliseconds(400), .farewell = milliseconds(100)}) {
    reader_ = std::thread([this] {
      // The open page answers pings, as browsers do.
      while (!is_over_) {
        page.send(Frame{.opcode = Opcode::pong});
        std::this_thread::sleep_for(milliseconds(20));
      }
    });
  }
  void TearDown() override {
    is_over_ = true;
    reader_.join();
    SocketAttack::TearDown();
  }

 private:
  std::atomic<bool> is_over_ = false;
  std::thread reader_;
};

TEST_F(SilentSocketAttack, EndsThePage) {
  Client silent = server.tab();
  const auto begin = std::chrono::steady_clock::now();
  int pings = 0;
  while (const auto frame = silent.frame()) pings += frame->opcode == Opcode::ping ? 1 : 0;
  EXPECT_EQ(pings, 1);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(SilentSocketAttack, WithUnreadMessagesEndsThePage) {
  // One message that is too large for the buffers of the kernel, and more messages than may wait.
  for (const auto& [wish, times] : {std::pair{"size 30000000", 1}, {"size 1000000", 20}}) {
    Client other = server.tab(4096);
    bool is_open = true;
    // It sends pongs, so only what it does not read can end it.
    for (int i = 0; i < 500 && is_open; ++i) {
      is_open = other.send(i < times ? Frame{.payload = wish} : Frame{.opcode = Opcode::pong});
      std::this_thread::sleep_for(milliseconds(10));
    }
    EXPECT_FALSE(is_open);
  }
}

}  // namespace
}  // namespace shelfbeam::test
