#include "serve/http/gate.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

#include "serve/http/target.hpp"
#include "serve/http/token.hpp"

namespace shelfbeam::serve::http {

namespace {

bool contains(const std::vector<std::string>& list, std::string_view value) {
  return std::ranges::find(list, lower_case(value)) != list.end();
}

// The name without its port; nothing is checked of a port but that it is a number.
void check_name(std::string_view name) {
  const std::string_view digits = "0123456789";
  std::string_view host = name;
  if (const std::size_t colon = name.rfind(':'); colon != std::string_view::npos && name.back() != ']') {
    const auto port = to_whole_number(name.substr(colon + 1), 65535);
    host = port && *port > 0 ? name.substr(0, colon) : std::string_view{};
  }
  const bool is_ipv6 = host.starts_with('[') && host.ends_with(']') && host.size() > 4;
  if (is_ipv6) host = host.substr(1, host.size() - 2);
  const std::string known =
      fmt::format("{}{}", digits, is_ipv6 ? "abcdef:." : "abcdefghijklmnopqrstuvwxyz-_.");
  if (host.empty() || lower_case(host).find_first_not_of(known) != std::string::npos)
    throw InputError("host " + in_quotes(name), "is not a name of a host, with or without a port",
                     "write it as the browser shows it, e.g. shop.example or shop.example:8080");
}

bool has_body(const Request& request) {
  const auto lengths = request.values("content-length");
  return !request.values("transfer-encoding").empty() ||
         std::ranges::any_of(lengths, [](std::string_view length) { return length != "0"; });
}

// The bytes of a body whose length is given once; nothing for another body, and for none.
std::optional<std::uint64_t> body_size(const Request& request) {
  const auto lengths = request.values("content-length");
  if (lengths.size() != 1 || !request.values("transfer-encoding").empty()) return {};
  return to_whole_number(lengths[0], std::numeric_limits<std::int64_t>::max());
}

// Whether the browser says that the request comes from another site. Older browsers do not say.
bool comes_from_elsewhere(const Request& request, const Verdict& verdict) {
  const auto is = [&](std::string_view field, std::string_view value) {
    return request.values(field) == std::vector{value};
  };
  if (request.values("sec-fetch-site").empty() || is("sec-fetch-site", "same-origin")) return false;
  if (verdict.is_socket || verdict.upload > 0) return true;
  if (is("sec-fetch-site", "none")) return false;
  return !(verdict.name.empty() && is("sec-fetch-mode", "navigate") && is("sec-fetch-dest", "document"));
}

}  // namespace

Gate::Gate(std::vector<std::string> own, std::uint16_t port, std::string token,
           const std::vector<std::string>& names, std::uint64_t max_upload)
    : token_(std::move(token)), max_upload_(max_upload) {
  own.insert(own.end(), {"127.0.0.1", "localhost"});
  for (const std::string& host : own) {
    add(fmt::format("{}:{}", host, port));
    if (port == 80) add(host);  // browsers leave out the default port
  }
  for (const std::string& given : names) {
    check_name(given);
    const std::string name = lower_case(given);
    add(name);
    origins_.push_back("https://" + name);  // of a proxy in front of the server
    if (name.back() == ']' || name.find(':') == std::string::npos) add(fmt::format("{}:{}", name, port));
  }
}

void Gate::add(const std::string& host) {
  hosts_.push_back(host);
  origins_.push_back("http://" + host);
}

Verdict Gate::judge(const Request& request) const {
  const auto hosts = request.values("host");
  if (hosts.size() != 1 || !contains(hosts_, hosts[0]))
    return {.refusal = 403, .why = "this host name is not allowed; allow it when you start the program"};
  std::optional<Target> target = parse_target(request.target);
  if (!target || !is_secret(target->token, token_)) return {.refusal = 404};

  Verdict verdict{
      .has_token = true, .is_socket = target->name == socket_name, .name = std::move(target->name)};
  const auto refused = [&](unsigned status) {
    verdict.refusal = status;
    return verdict;
  };
  const bool is_put = request.method == "PUT" && verdict.name.starts_with(file_names);
  if (!is_put && request.method != "GET" && request.method != "HEAD") return refused(405);
  if (is_put) {
    const auto size = body_size(request);
    if (!size) return refused(411);
    if (*size == 0 || *size > max_upload_) {
      verdict.why = *size == 0 ? "the file is empty"
                               : fmt::format("the file has {} bytes; the maximum is {} MiB", grouped(*size),
                                             max_upload_ >> 20);
      return refused(413);
    }
    verdict.upload = *size;
  } else if (has_body(request)) {
    return refused(413);
  }
  const auto origins = request.values("origin");
  if (origins.size() > 1 || ((verdict.is_socket || is_put) && origins.empty())) return refused(403);
  if (!origins.empty() && !contains(origins_, origins[0])) return refused(403);
  if (comes_from_elsewhere(request, verdict)) return refused(403);
  if (verdict.is_socket && !(request.method == "GET" && request.lists("connection", "upgrade") &&
                             request.lists("upgrade", "websocket")))
    return refused(400);
  return verdict;
}

}  // namespace shelfbeam::serve::http
