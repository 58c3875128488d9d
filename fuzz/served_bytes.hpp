#pragma once

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

#include "serve/http/server.hpp"

namespace shelfbeam::fuzz {

inline constexpr auto served_token = "0123456789abcdef";

/// What a server of the planner answers to the bytes of one connection. After `first`, it waits until a page
/// is open and sends `later`. Nothing sleeps: the bytes are there before the server looks for them, and then
/// the connection ends.
inline std::string served_bytes(std::string_view first, std::string_view later,
                                serve::http::Handlers handlers, serve::http::Server*& server) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "socketpair");
  const int client = ends[0];
  const auto send = [client](std::string_view bytes, bool is_end) {
    // What does not fit into the buffer of the kernel is left out.
    ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (is_end) ::shutdown(client, SHUT_WR);
  };
  handlers.opened = [&](serve::http::TabId) { send(later, true); };
  serve::http::Options options{.port = 8080, .token = served_token};
  options.assets.emplace("page.txt", serve::http::Asset("text/plain", "the page"));
  options.limits.message = 4096;
  options.limits.queue = 4096;
  serve::http::Server own(std::move(options), std::move(handlers), Descriptor(ends[1]));
  server = &own;
  send(first, later.empty());
  own.run();

  std::string answer;
  char bytes[65536];
  for (ssize_t got = 0; (got = ::recv(client, bytes, sizeof bytes, 0)) > 0;)
    answer.append(bytes, static_cast<std::size_t>(got));
  ::close(client);
  return answer;
}

}  // namespace shelfbeam::fuzz
