// Requests that are wrong, too large, too slow or too many.

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/serve/http/attacked_server.hpp"

namespace shelfbeam::test {
namespace {

using std::chrono::milliseconds;

class RequestAttack : public AttackedServer {};

TEST_F(RequestAttack, WithABodyIsRefused) {
  expect_let_in(server.request("page.txt", "Content-Length: 0\r\n"));
  const std::string inner = server.request("page.txt");
  const std::string size = std::to_string(inner.size());
  expect_refused(server.request("page.txt", "Content-Length: " + size + "\r\n") + inner, "413");
  expect_refused(server.request("page.txt", "Transfer-Encoding: chunked\r\n") + "0\r\n\r\n" + inner, "413");
  expect_refused(server.request("page.txt", "Transfer-Encoding: gzip, chunked\r\n") + inner, "413");
  expect_refused(server.request("page.txt", "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n") + inner,
                 "400");
  expect_refused(server.request("page.txt", "Content-Length: 0\r\nContent-Length: " + size + "\r\n") + inner,
                 "400");
  expect_refused(server.request("page.txt", "Content-Length: -1\r\n") + inner, "400");
  expect_refused(server.request("page.txt", "Expect: 100-continue\r\nContent-Length: 5000000\r\n"), "413");
  expect_refused(server.request("page.txt", "Content-Length: 18446744073709551615\r\n") + inner, "413");
  expect_refused(server.request("page.txt", "Content-Length: 99999999999999999999\r\n") + inner, "400");
  expect_refused(server.request("page.txt", "Content-Length: 5000000\r\n", "POST"), "405");
}

TEST_F(RequestAttack, WithALargeBodyIsNotRead) {
  Client client(server.port());
  client.send(server.request("page.txt", "Content-Length: 50000000\r\n"));
  EXPECT_THAT(client.answer(), testing::StartsWith("HTTP/1.1 413 "));
  const std::string piece(1 << 20, 'x');
  int sent = 0;
  while (sent < 50 && client.send(piece)) ++sent;
  EXPECT_LT(sent, 50);
}

TEST_F(RequestAttack, WithABodyIsAnsweredAfterTheBody) {
  Client client(server.port());
  client.send(server.request("page.txt", "Content-Length: 100000\r\n"));
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(client.send(std::string(10'000, 'x'))) << i;
    std::this_thread::sleep_for(milliseconds(2));
  }
  EXPECT_THAT(client.rest(), testing::StartsWith("HTTP/1.1 413 "));
}

TEST_F(RequestAttack, WithALargeHeadIsRefused) {
  const auto field = [](std::size_t size) { return "X: " + std::string(size, 'x') + "\r\n"; };
  expect_let_in(server.request("page.txt", field(7000)));
  expect_refused(server.request("page.txt", field(8'200)), "431");
  expect_refused(server.request("page.txt", field(16'000)), "431");
  std::string many;
  for (int i = 0; i < 4000; ++i) many += "X: y\r\n";
  expect_refused(server.request("page.txt", many), "431");
  expect_refused("GET /" + std::string(16'000, 'x'), "431");
  expect_refused(std::string(1 << 20, 'G'), "431");
}

TEST_F(RequestAttack, ThatIsNotHttpIsRefused) {
  using namespace std::literals;
  for (const std::string& bytes :
       {"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03"s + std::string(200, '\0'),
        "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"s, "GET /\r\n\r\n"s, "\r\n\r\n\r\nGET\r\n\r\n"s,
        "GET / HTTP/9.9\r\n\r\n"s, "GET  /  HTTP/1.1\r\n\r\n"s, "GET / HTTP/1.1\r\nHost\r\n\r\n"s,
        "GET / HTTP/1.1\r\nHost : x\r\n\r\n"s, "GET / HTTP/1.1\r\nA: \x01\r\n\r\n"s,
        "GET / HTTP/1.1\rHost: x\r\r"s + std::string(100, '\0')})
    expect_refused(bytes, "400");
}

TEST_F(RequestAttack, OfManyAtOnceAreAnsweredOneByOne) {
  Client client(server.port());
  constexpr int count = 2000;
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += server.request("page.txt");
  std::thread sender([&] { client.send(bytes); });
  for (int i = 0; i < count; ++i) ASSERT_THAT(client.answer(), testing::EndsWith("the page")) << i;
  sender.join();
}

TEST_F(RequestAttack, BehindAHandshakeIsRefused) {
  expect_let_in(server.handshake(), "101");
  expect_refused(server.handshake() + server.request("page.txt"), "400");
  expect_refused(server.handshake() + Frame{.payload = "early"}.bytes(), "400");
}

class LateRequestAttack : public AttackedServer {
 protected:
  LateRequestAttack()
      : AttackedServer(
            {.head_time = milliseconds(300), .idle = milliseconds(150), .write = milliseconds(300)}) {}

  // Whether the request is answered if its bytes come with pauses.
  static bool is_answered(const RunningServer& by, milliseconds pause) {
    Client client(by.port());
    for (const char byte : by.request("page.txt", "Connection: close\r\n")) {
      if (!client.send(std::string(1, byte))) break;
      std::this_thread::sleep_for(pause);
    }
    return client.rest().ends_with("the page");
  }
};

TEST_F(LateRequestAttack, ByteForByteIsCutOff) {
  EXPECT_FALSE(is_answered(server, milliseconds(10)));
  // Control: a server with more patience answers it.
  EXPECT_TRUE(is_answered(RunningServer(), milliseconds(10)));
}

TEST_F(LateRequestAttack, WithoutARequestIsCutOff) {
  Client silent(server.port()), idle(server.port());
  idle.send(server.request("page.txt"));
  EXPECT_THAT(idle.answer(), testing::EndsWith("the page"));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(idle.rest(), "");
  EXPECT_EQ(silent.rest(), "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(LateRequestAttack, WhoseAnswersAreNotReadIsCutOff) {
  std::vector<Client> clients;
  for (int i = 0; i < 4; ++i) clients.emplace_back(server.port(), 4096).send(server.request("large"));
  EXPECT_TRUE(server.answers(page)) << "meanwhile";
  for (Client& client : clients) {
    // The server has closed the connection when writing to it fails.
    bool is_open = true;
    for (int k = 0; k < 500 && is_open; ++k) {
      std::this_thread::sleep_for(milliseconds(10));
      is_open = client.send("x");
    }
    EXPECT_FALSE(is_open);
  }
  // Control: those who read get it all.
  Client reader(server.port());
  reader.send(server.request("large"));
  EXPECT_GT(reader.answer().size(), std::size_t{32} << 20);
}

}  // namespace
}  // namespace shelfbeam::test
