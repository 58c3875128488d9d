// Requests that another website, or a user of this computer, could send.

#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/serve/http/attacked_server.hpp"

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
  expect_refused(with(good(), own_host(), "Host: attacker.example"), "403");
  expect_refused(with(good(), own_host(), fmt::format("Host: attacker.example:{}", server.port())), "403");
  expect_refused(with(good(), own_host() + "\r\n", ""), "403");
  expect_refused(with(good(), own_host(), own_host() + "\r\n" + own_host()), "403");
  expect_refused(with(good(), own_host(), own_host() + "\r\nHost: attacker.example"), "403");
  expect_refused(with(good(), own_host(), "X-Host: " + server.host()), "403");
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
  for (const std::string& other :
       {std::string(), std::string("Origin: null\r\n"), std::string("Origin: file://\r\n"),
        std::string("Origin: http://attacker.example\r\n"),
        fmt::format("Origin: http://127.0.0.1:{}\r\n", server.port() - 1),
        fmt::format("Origin: https://{}\r\n", server.host()), origin + origin})
    expect_refused(with(server.handshake(), origin, other), "403");
  expect_refused(server.request("page.txt", "Origin: http://attacker.example\r\n"), "403");
  expect_let_in(server.handshake("Sec-Fetch-Site: same-origin\r\n"), "101");
  for (const std::string_view site : {"cross-site", "same-site", "none", "same-origin, cross-site"})
    expect_refused(server.handshake(fmt::format("Sec-Fetch-Site: {}\r\n", site)), "403");
  expect_refused(server.request("page.txt", "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: no-cors\r\n"),
                 "403");
}

TEST_F(AddressAttack, WithoutTheTokenLearnsNothing) {
  const std::string path = fmt::format("/{}/page.txt", test_token);
  std::string answer = server.ask(server.request("none.txt"));
  answer = with(answer, "keep-alive", "close");
  for (const std::string_view other :
       {"/", "/page.txt", "/none.txt", "/socket", "/favicon.ico", "//page.txt", "/0123456789abcdef/page.txt",
        "/0123456789abcdef0123456789abcdee/page.txt", "/0123456789ABCDEF0123456789ABCDEF/page.txt",
        "/0123456789abcdef0123456789abcdef", "/0123456789abcdef0123456789abcdef0/page.txt",
        "/page.txt?token=0123456789abcdef0123456789abcdef", "/page.txt/0123456789abcdef0123456789abcdef"}) {
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
  for (const std::string_view name : {"../page.txt",
                                      "../../etc/passwd",
                                      "%2e%2e/page.txt",
                                      "%2e%2e%2fpage.txt",
                                      "%252e%252e/page.txt",
                                      "..%5cpage.txt",
                                      "..\\page.txt",
                                      "./page.txt",
                                      "/page.txt",
                                      "page.txt/",
                                      "page.txt%00",
                                      "page.txt%00.js",
                                      "page%2etxt%2500",
                                      "%c0%ae%c0%ae/page.txt",
                                      "%uff0e%uff0e/page.txt",
                                      "page.txt?",
                                      "page.txt;x",
                                      "PAGE.TXT",
                                      "page.txt%20",
                                      "page.txt.",
                                      "/etc/passwd",
                                      "%2fetc%2fpasswd",
                                      "page.txt#x"}) {
    const std::string answer = server.ask(with(good(), path, root + std::string(name)));
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 404 ")) << name;
  }
  expect_refused(with(good(), path, "http://" + server.host() + path), "404");
  expect_refused(with(good(), path, "http://attacker.example" + path), "404");
  expect_refused(with(good(), path, "/../" + root + "page.txt"), "404");
  expect_refused(with(good(), path, server.host()), "404");
  expect_refused(with(good(), path, path + std::string(1, '\0')), "400");
}

TEST_F(AddressAttack, ByAnotherMethodIsRefused) {
  for (const std::string_view method :
       {"POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "PROPFIND", "get"}) {
    const std::string answer = server.ask(with(good(), "GET", method));
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 405 ")) << method;
    EXPECT_THAT(answer, testing::Not(testing::HasSubstr("Access-Control"))) << method;
  }
  // What a browser asks before another site's request with fields of its own.
  const std::string preflight = server.request(
      "page.txt", "Origin: http://attacker.example\r\nAccess-Control-Request-Method: PUT\r\n", "OPTIONS");
  expect_refused(preflight, "405");
}

}  // namespace
}  // namespace shelfbeam::test
