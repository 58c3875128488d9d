#include "serve/http/listener.hpp"

#include <array>
#include <cerrno>
#include <memory>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

namespace shelfbeam::serve::http {

namespace {

struct Address {
  sockaddr_storage storage{};
  socklen_t size = 0;

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
};

Address address_of(const std::string& text, std::uint16_t port) {
  Address address;
  if (auto* ipv4 = reinterpret_cast<sockaddr_in*>(&address.storage);
      ::inet_pton(AF_INET, text.c_str(), &ipv4->sin_addr) == 1) {
    ipv4->sin_family = AF_INET;
    ipv4->sin_port = htons(port);
    address.size = sizeof *ipv4;
  } else if (auto* ipv6 = reinterpret_cast<sockaddr_in6*>(&address.storage);
             ::inet_pton(AF_INET6, text.c_str(), &ipv6->sin6_addr) == 1) {
    ipv6->sin6_family = AF_INET6;
    ipv6->sin6_port = htons(port);
    address.size = sizeof *ipv6;
  } else {
    throw InputError("address '" + text + "'", "is neither IPv4 nor IPv6", "e.g. 127.0.0.1 or ::1");
  }
  return address;
}

const in_addr& ipv4_of(const sockaddr& address) {
  return reinterpret_cast<const sockaddr_in&>(address).sin_addr;
}

const in6_addr& ipv6_of(const sockaddr& address) {
  return reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
}

std::string host_of(const sockaddr& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address.sa_family == AF_INET) return ::inet_ntop(AF_INET, &ipv4_of(address), text.data(), text.size());
  return fmt::format("[{}]", ::inet_ntop(AF_INET6, &ipv6_of(address), text.data(), text.size()));
}

bool is_any(const sockaddr& address) {
  return address.sa_family == AF_INET ? ipv4_of(address).s_addr == INADDR_ANY
                                      : IN6_IS_ADDR_UNSPECIFIED(&ipv6_of(address));
}

// Browsers cannot name the interface that an address of one link needs.
bool is_usable(const ifaddrs& entry, int family) {
  return entry.ifa_addr != nullptr && entry.ifa_addr->sa_family == family &&
         (entry.ifa_flags & IFF_UP) != 0 && (entry.ifa_flags & IFF_LOOPBACK) == 0 &&
         (family == AF_INET || !IN6_IS_ADDR_LINKLOCAL(&ipv6_of(*entry.ifa_addr)));
}

// The addresses of the computer for others.
std::vector<std::string> own_hosts(int family) {
  std::vector<std::string> hosts;
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return hosts;
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> kept(first, &::freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next)
    if (is_usable(*entry, family)) hosts.push_back(host_of(*entry->ifa_addr));
  return hosts;
}

void switch_on(int descriptor, int level, int option) {
  const int on = 1;
  ::setsockopt(descriptor, level, option, &on, sizeof on);
}

[[noreturn]] void cannot_listen(const std::string& address, std::uint16_t port) {
  const char* remedy = errno == EADDRNOTAVAIL                   ? "choose an address of this computer"
                       : errno == EADDRINUSE || errno == EACCES ? "choose another port"
                                                                : "";
  throw InputError(fmt::format("port {} of {}", port, address),
                   fmt::format("cannot be used ({})", system_reason()), remedy);
}

}  // namespace

Listener::Listener(const std::string& address, std::uint16_t port) {
  Address own = address_of(address, port);
  descriptor_ = Descriptor(::socket(own.storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!descriptor_.is_open()) cannot_listen(address, port);
  // A server that is started again gets its port back, in spite of the old connections that the kernel
  // remembers.
  switch_on(descriptor(), SOL_SOCKET, SO_REUSEADDR);
  if (own.storage.ss_family == AF_INET6) switch_on(descriptor(), IPPROTO_IPV6, IPV6_V6ONLY);
  if (::bind(descriptor(), own.get(), own.size) != 0 || ::listen(descriptor(), SOMAXCONN) != 0 ||
      ::getsockname(descriptor(), own.get(), &own.size) != 0)
    cannot_listen(address, port);
  port_ = ntohs(own.storage.ss_family == AF_INET ? reinterpret_cast<sockaddr_in*>(&own.storage)->sin_port
                                                 : reinterpret_cast<sockaddr_in6*>(&own.storage)->sin6_port);
}

std::vector<std::string> Listener::hosts() const {
  Address own;
  own.size = sizeof own.storage;
  ::getsockname(descriptor(), own.get(), &own.size);
  if (!is_any(*own.get())) return {host_of(*own.get())};
  const int family = own.storage.ss_family;
  std::vector<std::string> hosts = own_hosts(family);
  hosts.insert(hosts.begin(), family == AF_INET ? "127.0.0.1" : "[::1]");
  return hosts;
}

Listener::Accepted Listener::accept(Descriptor& connection) const {
  while (true) {
    connection = Descriptor(::accept4(descriptor(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (connection.is_open()) {
      switch_on(connection.number(), IPPROTO_TCP,
                TCP_NODELAY);  // a message is not held back for a fuller packet
      return Accepted::one;
    }
    if (errno == EAGAIN) return Accepted::none;
    // These errors are of a connection that has ended meanwhile; the next one may be fine.
    if (errno != EINTR && errno != ECONNABORTED && errno != EPROTO) return Accepted::failed;
  }
}

}  // namespace shelfbeam::serve::http
