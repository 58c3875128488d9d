// Pages that misuse their WebSocket, and many connections.

#include <atomic>

#include <fcntl.h>

#include "support/processor_time.hpp"
#include "unit/serve/http/test_server.hpp"

namespace shelfbeam::test {
namespace {

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
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(10));
}

TEST_F(SilentSocketAttack, WithUnreadMessagesEndsThePage) {
  // One message that is too large for the buffers of the kernel, and more messages than may wait.
  for (const auto& [wish, times] : {std::pair{"size 30000000", 1}, {"size 1000000", 20}}) {
    Client other = server.tab(4096);
    int sent = 0;
    // It sends pongs, so only what it does not read can end it.
    EXPECT_TRUE(becomes_true([&, wish = wish, times = times] {
      return !other.send(sent++ < times ? Frame{.payload = wish} : Frame{.opcode = Opcode::pong});
    }));
  }
}

class Crowd : public AttackedServer {};

TEST_F(Crowd, OfStrangersGivesWayToTheOwner) {
  std::vector<Client> strangers;
  for (int i = 0; i < 200; ++i) {
    strangers.emplace_back(server.port());
    if (i % 50 == 49) {
      EXPECT_TRUE(server.answers(page)) << i;
    }
  }
  EXPECT_EQ(strangers.front().rest(), "") << "the oldest is dropped";
}

TEST_F(Crowd, OfPagesIsLimited) {
  std::vector<Client> pages;
  for (int i = 1; i < 64; ++i) pages.push_back(server.tab());
  Client one_more(server.port());
  one_more.send(server.request("page.txt"));
  EXPECT_EQ(one_more.rest(), "");
  for (Client& other : pages) {
    other.send(Frame{.payload = "hello"});
    EXPECT_EQ(other.message(), "hello");
  }
  pages.pop_back();
}

TEST_F(Crowd, OfIdleConnectionsGivesWay) {
  std::vector<Client> idle;
  for (int i = 0; i < 200; ++i) {
    idle.emplace_back(server.port()).send(server.request("page.txt"));
    EXPECT_THAT(idle.back().answer(), testing::EndsWith("the page"));
  }
}

TEST_F(Crowd, OfStrangersLeavesIdleConnectionsOfTheOwner) {
  Client idle(server.port());
  idle.send(server.request("page.txt"));
  EXPECT_THAT(idle.answer(), testing::EndsWith("the page"));
  std::vector<Client> strangers;
  strangers.reserve(100);
  for (int i = 0; i < 100; ++i) strangers.emplace_back(server.port());
  EXPECT_TRUE(server.answers(page));
  idle.send(server.request("page.txt"));
  EXPECT_THAT(idle.answer(), testing::EndsWith("the page"));
}

// The files of this process up to its limit.
class UsedUpDescriptors {
 public:
  explicit UsedUpDescriptors(rlim_t limit) : limit_(RLIMIT_NOFILE, limit) {
    for (int file = 0; (file = ::open("/dev/null", O_RDONLY)) >= 0;) files_.push_back(file);
  }
  ~UsedUpDescriptors() {
    while (!files_.empty()) free_one();
  }
  UsedUpDescriptors(const UsedUpDescriptors&) = delete;
  UsedUpDescriptors& operator=(const UsedUpDescriptors&) = delete;

  void free_one() {
    ::close(files_.back());
    files_.pop_back();
  }

 private:
  ProcessLimit limit_;
  std::vector<int> files_;
};

TEST_F(Crowd, WithoutDescriptorsWaits) {
  std::optional<UsedUpDescriptors> full(std::in_place, 200);
  full->free_one();
  Client client(server.port());  // takes the last one
  client.send(server.request("page.txt"));
  const ProcessorTime time;
  std::this_thread::sleep_for(milliseconds(300));
  page.send(Frame{.payload = "hello"});
  EXPECT_EQ(page.message(), "hello");
  EXPECT_LT(time.seconds(), 0.05 * slowness) << "the server spins";
  full.reset();
  EXPECT_THAT(client.answer(), testing::EndsWith("the page"));
}

class SlowCrowd : public Crowd {
  ProcessLimit limit_{RLIMIT_NOFILE, 4096};
};

TEST_F(SlowCrowd, OfTenThousandOneByOneLeavesNoTrace) {
  for (int i = 0; i < 10'000; ++i) {
    const Client client(server.port());
    if (i % 3 > 0)
      client.send(i % 3 == 1 ? "GET / HTTP" : "GET / HTTP/1.1\r\nHost: attacker.example\r\n\r\n");
    if (i % 1000 == 0) {
      EXPECT_TRUE(server.answers(page)) << i;
    }
  }
}

TEST_F(SlowCrowd, OfAThousandAtOnceKeepsTheOwner) {
  std::vector<Client> crowd;
  for (int i = 0; i < 1000; ++i) crowd.emplace_back(server.port()).send("GET / HTTP/1.1\r\nHost: ");
  for (int round = 0; round < 10; ++round) {
    for (const Client& client : crowd) client.send("x");
    EXPECT_TRUE(server.answers(page)) << round;
  }
}

TEST_F(SlowCrowd, OfPagesThatDoNotReadIsBounded) {
  // Each has a message on its way and a queue that is almost full.
  std::vector<Client> crowd;
  for (int i = 0; i < 20; ++i) {
    crowd.push_back(server.tab(4096));
    for (int k = 0; k < 9; ++k) crowd.back().send(Frame{.payload = "size 1000000"});
  }
  EXPECT_TRUE(server.answers(page));
}

}  // namespace
}  // namespace shelfbeam::test
