#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/base/files/descriptor.hpp"

namespace shelfbeam::serve::http {

/// A TCP socket that listens.
class Listener {
 public:
  /// `address`: IPv4 or IPv6. `port`: 0 for any free one. Throws InputError if the address is none, or not of
  /// this computer, or the port is taken.
  Listener(const std::string& address, std::uint16_t port);

  int descriptor() const { return descriptor_.number(); }
  std::uint16_t port() const { return port_; }
  /// The addresses at which it is reached, in the spelling of browsers: "127.0.0.1", "[::1]". If it listens
  /// on all, first that of the computer for itself, then those for other computers, as they are now.
  std::vector<std::string> hosts() const;

  enum class Accepted { one, none, failed };
  /// Accepts a connection without waiting. `failed`: there is one, but descriptors or memory are short; try
  /// later.
  Accepted accept(Descriptor& connection) const;

 private:
  Descriptor descriptor_;
  std::uint16_t port_ = 0;
};

}  // namespace shelfbeam::serve::http
