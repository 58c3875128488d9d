// Requests that another website, or a user of this computer, could send, and requests that are wrong, too
// large, too slow or too many. The tests of gate and targets have more of the first kind.

#include "unit/serve/http/test_server.hpp"

namespace shelfbeam::test {
namespace {

// The text with a part replaced.
std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class AddressAttack : public AttackedServer {
 protected:
  std::string good() const { return server.request("page.txt"); }
  std::string own_host() const { return "Host: " + server.host(); }
};

TEST_F(AddressAttack, ByAnotherHostIsRefused) {
  expect_let_in(good());
  expect_refused(with(good(), own_host(), fmt::format("Host: attacker.example:{}", server.port())), "403");
  expect_refused(with(good(), own_host() + "\r\n", ""), "403");
  expect_refused(with(good(), own_host(), own_host() + "\r\nHost: attacker.example"), "403");
  // A folded line: to some readers one Host of two lines, to others two.
  expect_refused(with(good(), own_host(), own_host() + "\r\n attacker.example"), "403");
}

TEST_F(AddressAttack, ByRebindingIsRefused) {
  const auto rebound = [](std::string request, const RunningServer& of) {
    request = with(request, "Host: " + of.host(), fmt::format("Host: attacker.example:{}", of.port()));
    return with(request, "http://" + of.host(), fmt::format("http://attacker.example:{}", of.port()));
  };
  const std::string fetch = server.request("page.txt", "Origin: http://" + server.host() + "\r\n");
  expect_let_in(fetch);
  expect_refused(rebound(fetch, server), "403");
  expect_let_in(server.handshake(), "101");
  expect_refused(rebound(server.handshake(), server), "403");
  // Control: a server that takes the name is open to the attack.
  const RunningServer open({}, {"attacker.example"});
  EXPECT_THAT(open.ask(rebound(open.handshake(), open)), testing::StartsWith("HTTP/1.1 101 "));
}

TEST_F(AddressAttack, ByAnotherOriginIsRefused) {
  const std::string origin = "Origin: http://" + server.host() + "\r\n";
  for (const std::string& other : {std::string(), std::string("Origin: null\r\n"), origin + origin})
    expect_refused(with(server.handshake(), origin, other), "403");
  expect_refused(server.request("page.txt", "Origin: http://attacker.example\r\n"), "403");
  expect_let_in(server.handshake("Sec-Fetch-Site: same-origin\r\n"), "101");
  expect_refused(server.handshake("Sec-Fetch-Site: same-origin, cross-site\r\n"), "403");
  expect_refused(server.request("page.txt", "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: no-cors\r\n"),
                 "403");
}

TEST_F(AddressAttack, WithoutTheTokenLearnsNothing) {
  const std::string path = fmt::format("/{}/page.txt", test_token);
  const std::string answer = with(server.ask(server.request("none.txt")), "keep-alive", "close");
  for (const std::string_view other :
       {"/", "/page.txt", "/none.txt", "/socket", "/0123456789abcdef0123456789abcdee/page.txt",
        "/0123456789abcdef0123456789abcdef", "/page.txt?token=0123456789abcdef0123456789abcdef"}) {
    const std::string request = with(good(), path, other);
    EXPECT_EQ(server.ask(request), answer) << other;
    EXPECT_EQ(server.ask(with(request, "GET", "POST")), answer) << other;
    expect_refused(request, "404");
  }
  for (const std::string_view place : {"Cookie: token={0}\r\n", "Authorization: Bearer {0}\r\n",
                                       "X-Token: {0}\r\n", "Referer: http://x/{0}/\r\n"}) {
    const std::string field = fmt::format(fmt::runtime(place), test_token);
    expect_refused(with(with(good(), path, "/page.txt"), "\r\n\r\n", "\r\n" + field + "\r\n"), "404");
  }
  const std::string handshake = with(server.handshake(), test_token, "0123456789abcdef0123456789abcdee");
  EXPECT_EQ(server.ask(handshake), answer);
}

TEST_F(AddressAttack, ByPathIsRefused) {
  const std::string path = fmt::format("/{}/page.txt", test_token), root = fmt::format("/{}/", test_token);
  expect_let_in(with(good(), path, root + "%70age.txt"));
  for (const std::string_view name :
       {"../page.txt", "../../etc/passwd", "%2e%2e/page.txt", "..\\page.txt", "/etc/passwd", "page.txt%00.js",
        "page.txt?", "page.txt;x", "PAGE.TXT", "page.txt%20", "page.txt."})
    EXPECT_THAT(server.ask(with(good(), path, root + std::string(name))),
                testing::StartsWith("HTTP/1.1 404 "))
        << name;
  for (const std::string& other : {"http://" + server.host() + path, "http://attacker.example" + path,
                                   "/../" + root + "page.txt", server.host()})
    expect_refused(with(good(), path, other), "404");
  expect_refused(with(good(), path, path + std::string(1, '\0')), "400");
}

TEST_F(AddressAttack, ByAnotherMethodIsRefused) {
  for (const std::string_view method : {"POST", "PUT", "OPTIONS", "PROPFIND"}) {
    const std::string answer = server.ask(with(good(), "GET", method));
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 405 ")) << method;
    EXPECT_THAT(answer, testing::Not(testing::HasSubstr("Access-Control"))) << method;
  }
  // What a browser asks before another site's request with fields of its own.
  const std::string preflight = server.request(
      "page.txt", "Origin: http://attacker.example\r\nAccess-Control-Request-Method: PUT\r\n", "OPTIONS");
  expect_refused(preflight, "405");
}

class RequestAttack : public AttackedServer {};

TEST_F(RequestAttack, WithABodyIsRefused) {
  expect_let_in(server.request("page.txt", "Content-Length: 0\r\n"));
  const std::string inner = server.request("page.txt"), size = fmt::format("{}", inner.size());
  for (const auto& [fields, status] : {std::pair("Content-Length: " + size, "413"),
                                       {"Transfer-Encoding: chunked", "413"},
                                       {"Transfer-Encoding: gzip, chunked", "413"},
                                       {"Content-Length: 5\r\nTransfer-Encoding: chunked", "400"},
                                       {"Content-Length: 0\r\nContent-Length: " + size, "400"},
                                       {"Content-Length: -1", "400"},
                                       {"Content-Length: 18446744073709551615", "413"},
                                       {"Content-Length: 99999999999999999999", "400"}})
    expect_refused(server.request("page.txt", fmt::format("{}\r\n", fields)).append(inner), status);
  expect_refused(server.request("page.txt", "Expect: 100-continue\r\nContent-Length: 5000000\r\n"), "413");
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
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(10));
}

TEST_F(LateRequestAttack, WhoseAnswersAreNotReadIsCutOff) {
  std::vector<Client> clients;
  for (int i = 0; i < 4; ++i) clients.emplace_back(server.port(), 4096).send(server.request("large"));
  EXPECT_TRUE(server.answers(page)) << "meanwhile";
  for (Client& client : clients) {
    // The server has closed the connection when writing to it fails.
    EXPECT_TRUE(becomes_true([&] { return !client.send("x"); }));
  }
  // Control: those who read get it all.
  Client reader(server.port());
  reader.send(server.request("large"));
  EXPECT_GT(reader.answer().size(), std::size_t{32} << 20);
}

}  // namespace
}  // namespace shelfbeam::test
