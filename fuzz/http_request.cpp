// What a stranger sends to the planner's server.

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "shelfbeam/base/error.hpp"

#include "reader.hpp"
#include "served_bytes.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_http_request(std::string_view bytes) {
  serve::http::Server* server = nullptr;
  serve::http::Handlers handlers;
  handlers.get = [](std::string_view name) -> std::optional<serve::http::Document> {
    for (const char c : name)
      if (c < ' ' || c > '~' || c == '\\' || c == '%') throw std::logic_error("a name has a wrong character");
    if (name.starts_with("..") || name.find("//") != std::string_view::npos)
      throw std::logic_error("a wrong name");
    return std::nullopt;
  };
  std::string what;
  handlers.failed = [&](std::string_view error) { what = error; };
  const std::string answer = served_bytes(bytes, {}, std::move(handlers), server);
  if (!what.empty()) throw std::logic_error(what);
  if (!answer.empty() && !answer.starts_with("HTTP/1."))
    throw std::logic_error("the server does not answer in HTTP");
  if (!answer.starts_with("HTTP/1.1 200 ")) throw InputError("request", "is refused");
}

std::vector<std::string> http_request_seeds() {
  const std::string good = "GET /0123456789abcdef/page.txt HTTP/1.1\r\nHost: localhost:8080\r\n";
  const std::string old_socket =
      "GET /0123456789abcdef/socket HTTP/1.1\r\nHost: localhost:8080\r\nOrigin: http://localhost:8080\r\n"
      "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 8\r\nSec-WebSocket-Key: x\r\n\r\n";
  return {
      good + "\r\n",
      good + "Accept-Encoding: gzip;q=0.5, br\r\n\r\n" + good + "Connection: close\r\n\r\n",
      good + "If-None-Match: W/\"0\"\r\nSec-Fetch-Site: same-origin\r\nOrigin: http://127.0.0.1:8080\r\n\r\n",
      good + "Content-Length: 3\r\n\r\nabc",
      good + "Transfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n0\r\n\r\n",
      good + "Host: attacker.example\r\n\r\n",
      "HEAD /0123456789abcdef/a%20b/../%2e HTTP/1.0\r\nhost: localhost:8080\r\n\r\n",
      old_socket};
}

}  // namespace

extern const Reader http_request;
const Reader http_request{"http_request", fuzz_http_request, http_request_seeds};

}  // namespace shelfbeam::fuzz
