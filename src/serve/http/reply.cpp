#include "serve/http/reply.hpp"

#include <array>
#include <memory>

#include <fmt/format.h>

namespace shelfbeam::serve::http {

namespace {

std::string_view reason(unsigned status) {
  switch (status) {
    case 200:
      return "OK";
    case 201:
      return "Created";
    case 304:
      return "Not Modified";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 411:
      return "Length Required";
    case 413:
      return "Content Too Large";
    case 422:
      return "Unprocessable Content";
    case 431:
      return "Request Header Fields Too Large";
    default:
      return "Internal Server Error";
  }
}

}  // namespace

Reply refusal(unsigned status, std::string_view why) {
  return {.status = status,
          .type = "text/plain; charset=utf-8",
          .body = std::make_shared<const std::string>(
              fmt::format("{} {}{}{}\n", status, reason(status), why.empty() ? "" : ": ", why))};
}

std::span<const std::pair<std::string_view, std::string_view>> security_fields(bool is_report) {
  using Field = std::pair<std::string_view, std::string_view>;
  constexpr Field page{
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; "
      "img-src 'self' blob:; "
      "font-src 'self'; "
      "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"};
  constexpr Field report{
      "Content-Security-Policy",
      "sandbox allow-scripts allow-downloads allow-modals; default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:; frame-ancestors 'none'; base-uri 'none'; "
      "form-action 'none'"};
  constexpr Field sniff{"X-Content-Type-Options", "nosniff"}, referrer{"Referrer-Policy", "no-referrer"},
      opener{"Cross-Origin-Opener-Policy", "same-origin"},
      resource{"Cross-Origin-Resource-Policy", "same-origin"};
  static constexpr std::array of_page{page, sniff, referrer, opener, resource};
  static constexpr std::array of_report{report, sniff, referrer, opener, resource};
  return is_report ? of_report : of_page;
}

std::string head_of(const Reply& reply, bool keep_alive) {
  std::string head = fmt::format("HTTP/1.1 {} {}\r\n", reply.status, reason(reply.status));
  const auto add = [&](std::string_view name, std::string_view value) {
    head += fmt::format("{}: {}\r\n", name, value);
  };
  for (const auto& [name, value] : security_fields(reply.is_report)) add(name, value);
  add("Connection", keep_alive ? "keep-alive" : "close");
  if (reply.etag.empty()) {
    add("Cache-Control", "no-store");
  } else {
    add("Cache-Control", "no-cache");
    add("ETag", reply.etag);
  }
  if (reply.status == 405) add("Allow", "GET, HEAD");
  if (reply.status != 304) {
    if (!reply.type.empty()) add("Content-Type", reply.type);
    if (reply.is_gzip) add("Content-Encoding", "gzip");
    add("Content-Length", std::to_string(reply.body ? reply.body->size() : 0));
  }
  return head + "\r\n";
}

}  // namespace shelfbeam::serve::http
