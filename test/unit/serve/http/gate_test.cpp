#include "serve/http/gate.hpp"

#include "unit/serve/testing.hpp"

namespace shelfbeam::serve::http {
namespace {

using Fields = std::vector<std::pair<std::string_view, std::string_view>>;

constexpr auto gate_token = "0123456789abcdef";

Gate gate(std::string_view address = "127.0.0.1", std::uint16_t port = 8080,
          const std::vector<std::string>& names = {}) {
  return {{std::string(address)}, port, gate_token, names, 1000};
}

unsigned status(const Gate& gate, Fields fields, std::string_view name = "page",
                std::string_view method = "GET") {
  const std::string target = "/" + std::string(gate_token) + "/" + std::string(name);
  return gate.judge({method, target, std::move(fields)}).refusal;
}

Fields changed(Fields fields, std::size_t field, std::string_view value) {
  fields[field].second = value;
  return fields;
}

Fields with(Fields fields, std::string_view name, std::string_view value) {
  fields.emplace_back(name, value);
  return fields;
}

Fields without(Fields fields, std::size_t field) {
  fields.erase(fields.begin() + static_cast<std::ptrdiff_t>(field));
  return fields;
}

TEST(Gate, LetsInWhatABrowserSends) {
  EXPECT_EQ(status(gate(), {{"Host", "127.0.0.1:8080"}}), 0u);
  EXPECT_EQ(status(gate(), {{"host", "LocalHost:8080"}}), 0u);
  const Fields from_page{{"Host", "localhost:8080"}, {"Sec-Fetch-Site", "same-origin"}};
  EXPECT_EQ(status(gate(), from_page, "page", "HEAD"), 0u);
  const Verdict verdict = gate().judge({"GET", "/0123456789abcdef/a/b", {{"Host", "127.0.0.1:8080"}}});
  EXPECT_TRUE(verdict.has_token);
  EXPECT_EQ(verdict.name, "a/b");
}

TEST(Gate, WantsOneHostOfTheList) {
  for (const std::string_view host :
       {"", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:8080.", "127.0.0.1:08080", "127.1:8080",
        "2130706433:8080", "localhost", "localhost.:8080", "localhost.attacker.example:8080",
        "attacker.example", "attacker.example:8080", "127.0.0.1:8080@attacker.example", "[::1]:8080",
        "0.0.0.0:8080", "127.0.0.1:8080, attacker.example"})
    EXPECT_EQ(status(gate(), {{"Host", host}}), 403u) << host;
  EXPECT_EQ(status(gate(), {}), 403u);
  EXPECT_EQ(status(gate(), {{"Host", "127.0.0.1:8080"}, {"Host", "127.0.0.1:8080"}}), 403u);
  EXPECT_EQ(status(gate(), {{"Host", "attacker.example"}, {"Host", "127.0.0.1:8080"}}), 403u);
  EXPECT_EQ(status(gate(), {{"X-Forwarded-Host", "127.0.0.1:8080"}, {"Host", "attacker.example"}}), 403u);
}

TEST(Gate, KnowsItsAddressAndFurtherNames) {
  EXPECT_EQ(status(gate("[::1]"), {{"Host", "[::1]:8080"}}), 0u);
  EXPECT_EQ(status(gate("192.168.1.5"), {{"Host", "192.168.1.5:8080"}}), 0u);
  EXPECT_EQ(status(gate("192.168.1.5"), {{"Host", "192.168.1.6:8080"}}), 403u);
  EXPECT_EQ(status(gate("[2001:db8::1]"), {{"Host", "[2001:DB8::1]:8080"}}), 0u);
  EXPECT_EQ(status(gate("127.0.0.1", 80), {{"Host", "127.0.0.1"}}), 0u);
  EXPECT_EQ(status(gate("127.0.0.1", 80), {{"Host", "127.0.0.1:80"}}), 0u);
  const Gate named = gate("127.0.0.1", 8080, {"Shop.Example", "tunnel.example:9000", "[fe80::2]"});
  for (const std::string_view host :
       {"shop.example", "shop.example:8080", "tunnel.example:9000", "[fe80::2]", "[fe80::2]:8080"})
    EXPECT_EQ(status(named, {{"Host", host}}), 0u) << host;
  for (const std::string_view host :
       {"shop.example:9000", "tunnel.example", "tunnel.example:8080", "a.shop.example", "[fe80::2]:9000"})
    EXPECT_EQ(status(named, {{"Host", host}}), 403u) << host;
  for (const std::string_view origin : {"https://shop.example", "http://shop.example:8080"})
    EXPECT_EQ(status(named, {{"Host", "shop.example"}, {"Origin", origin}}), 0u) << origin;
}

TEST(Gate, TakesOnlyNamesThatABrowserSends) {
  for (const char* name :
       {"", "*", "*.shop.example", "http://shop.example", "shop.example/", "shop.example:", "shop.example:0",
        "shop.example:65536", "shop.example:x", "a b", "a@b", "::1", "[]", ":80", "sh\xc3\xb6p.example"})
    expect_input_error([&] { gate("127.0.0.1", 8080, {name}); }, "name of a host");
}

TEST(Gate, WantsTheTokenFirst) {
  const Fields fields{{"Host", "127.0.0.1:8080"}};
  for (const std::string_view target :
       {"/", "/page", "/socket", "/0123456789abcde/page", "/0123456789abcdef0/page", "/0123456789abcdeg/page",
        "/0123456789ABCDEF/page", "//page", "/page/0123456789abcdef/", "/page?token=0123456789abcdef",
        "/x/../0123456789abcdef/page", "//0123456789abcdef/page",
        "http://127.0.0.1:8080/0123456789abcdef/page"}) {
    for (const std::string_view method : {"GET", "POST", "OPTIONS"}) {
      const Verdict verdict = gate().judge({method, target, fields});
      EXPECT_EQ(verdict.refusal, 404u) << method << " " << target;
      EXPECT_FALSE(verdict.has_token);
    }
  }
}

TEST(Gate, TakesNoOtherMethodsAndNoBodies) {
  const Fields fields{{"Host", "127.0.0.1:8080"}};
  for (const std::string_view method :
       {"POST", "PUT", "DELETE", "OPTIONS", "CONNECT", "TRACE", "get", "GETT", ""})
    EXPECT_EQ(status(gate(), fields, "page", method), 405u) << method;
  EXPECT_EQ(status(gate(), with(fields, "Content-Length", "0")), 0u);
  for (const std::string_view length : {"1", "00", "-0", "", "0, 5", "18446744073709551616"})
    EXPECT_EQ(status(gate(), with(fields, "Content-Length", length)), 413u) << length;
  EXPECT_EQ(status(gate(), with(fields, "Transfer-Encoding", "chunked")), 413u);
  EXPECT_EQ(status(gate(), with(fields, "transfer-encoding", "identity")), 413u);
}

TEST(Gate, TakesFilesOfItsOwnPages) {
  const Fields good{{"Host", "127.0.0.1:8080"},
                    {"Origin", "http://127.0.0.1:8080"},
                    {"Content-Length", "1000"},
                    {"Sec-Fetch-Site", "same-origin"}};
  const auto put = [](const Fields& fields, std::string_view name = "files/plan.png") {
    return status(gate(), fields, name, "PUT");
  };
  EXPECT_EQ(put(good), 0u);
  EXPECT_EQ(gate().judge({"PUT", std::string("/") + gate_token + "/files/plan.png", good}).upload, 1000U);
  EXPECT_EQ(put(good, "scene"), 405u);
  EXPECT_EQ(put(good, ""), 405u);
  for (const std::string_view name : {"files/plan.png", "socket"})
    EXPECT_EQ(status(gate(), good, name, "POST"), 405u) << name;
  EXPECT_EQ(put(without(good, 1)), 403u) << "no origin";
  for (const std::string_view origin : {"null", "http://attacker.example", "http://127.0.0.1:8081"})
    EXPECT_EQ(put(changed(good, 1, origin)), 403u) << origin;
  EXPECT_EQ(put(without(good, 2)), 411u) << "no length";
  for (const std::string_view length : {"0", "1001", "9223372036854775807"})
    EXPECT_EQ(put(changed(good, 2, length)), 413u) << length;
  for (const std::string_view length : {"", "-1", "+5", "5, 5", "0x10", "18446744073709551616"})
    EXPECT_EQ(put(changed(good, 2, length)), 411u) << length;
  EXPECT_EQ(put(with(good, "Content-Length", "1000")), 411u) << "twice";
  EXPECT_EQ(put(with(good, "Transfer-Encoding", "chunked")), 411u);
  EXPECT_EQ(put(without(good, 3)), 0u) << "an older browser";
  for (const std::string_view site : {"none", "same-site", "cross-site"})
    EXPECT_EQ(put(changed(good, 3, site)), 403u) << site;
}

TEST(Gate, ComparesTheOriginWithTheListAndNotWithTheHost) {
  const auto from = [&](std::string_view origin) {
    return status(gate(), {{"Host", "127.0.0.1:8080"}, {"Origin", origin}});
  };
  EXPECT_EQ(from("http://127.0.0.1:8080"), 0u);
  EXPECT_EQ(from("http://localhost:8080"), 0u);
  for (const std::string_view origin :
       {"null", "", "http://attacker.example", "http://127.0.0.1", "http://127.0.0.1:8081",
        "https://127.0.0.1:8080", "http://127.0.0.1:8080/", "127.0.0.1:8080",
        "http://127.0.0.1:8080.attacker.example", "file://", "chrome-extension://abcdefgh"})
    EXPECT_EQ(from(origin), 403u) << origin;
  EXPECT_EQ(status(gate(), {{"Host", "attacker.example:8080"}, {"Origin", "http://attacker.example:8080"}}),
            403u);
  EXPECT_EQ(status(gate(), {{"Host", "127.0.0.1:8080"},
                            {"Origin", "http://127.0.0.1:8080"},
                            {"Origin", "http://attacker.example"}}),
            403u);
}

TEST(Gate, WantsAnOriginAtTheSocket) {
  const Fields good{{"Host", "127.0.0.1:8080"},
                    {"Origin", "http://127.0.0.1:8080"},
                    {"Connection", "keep-alive, Upgrade"},
                    {"Upgrade", "WebSocket"}};
  const auto ask = [](const Fields& fields) { return status(gate(), fields, "socket"); };
  EXPECT_EQ(ask(good), 0u);
  EXPECT_TRUE(gate().judge({"GET", std::string("/") + gate_token + "/socket", good}).is_socket);
  EXPECT_EQ(ask(without(good, 1)), 403u);
  EXPECT_EQ(ask(changed(good, 1, "http://attacker.example")), 403u);
  EXPECT_EQ(ask(changed(good, 1, "null")), 403u);
  EXPECT_EQ(ask(changed(good, 2, "keep-alive")), 400u);
  EXPECT_EQ(ask(changed(good, 3, "h2c")), 400u);
  EXPECT_EQ(ask({good[0], good[1]}), 400u);
  EXPECT_EQ(status(gate(), good, "socket", "HEAD"), 400u);
  for (const auto& [site, expected] :
       {std::pair{"same-origin", 0u}, {"none", 403u}, {"same-site", 403u}, {"cross-site", 403u}, {"", 403u}})
    EXPECT_EQ(ask(with(good, "Sec-Fetch-Site", site)), expected) << site;
}

TEST(Gate, LetsOtherSitesOnlyLinkToThePage) {
  const auto of = [&](std::string_view name, std::string_view site, std::string_view mode,
                      std::string_view dest) {
    return status(gate(),
                  {{"Host", "127.0.0.1:8080"},
                   {"Sec-Fetch-Site", site},
                   {"Sec-Fetch-Mode", mode},
                   {"Sec-Fetch-Dest", dest}},
                  name);
  };
  EXPECT_EQ(of("page.js", "same-origin", "no-cors", "script"), 0u);
  EXPECT_EQ(of("page.js", "none", "navigate", "document"), 0u);
  for (const std::string_view site : {"same-site", "cross-site"}) {
    EXPECT_EQ(of("", site, "navigate", "document"), 0u);
    EXPECT_EQ(of("", site, "navigate", "iframe"), 403u);
    EXPECT_EQ(of("", site, "no-cors", "image"), 403u);
    EXPECT_EQ(of("", site, "cors", "empty"), 403u);
    EXPECT_EQ(of("page.js", site, "navigate", "document"), 403u);
    EXPECT_EQ(of("page.js", site, "no-cors", "script"), 403u);
  }
  EXPECT_EQ(status(gate(), {{"Host", "127.0.0.1:8080"},
                            {"Sec-Fetch-Site", "same-origin"},
                            {"Sec-Fetch-Site", "cross-site"}}),
            403u);
}

}  // namespace
}  // namespace shelfbeam::serve::http
