#include "serve/http/token.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <sys/random.h>

namespace shelfbeam::serve::http {

std::string make_token() {
  std::array<unsigned char, 16> bytes{};
  ssize_t got = 0;
  do got = ::getrandom(bytes.data(), bytes.size(), 0);
  while (got < 0 && errno == EINTR);
  // The kernel gives up to 256 bytes at once.
  if (got != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "the kernel gives no random bytes");
  std::string token;
  for (const unsigned char byte : bytes)
    for (const int digit : {byte >> 4, byte & 15}) token += "0123456789abcdef"[digit];
  return token;
}

bool is_secret(std::string_view given, std::string_view secret) {
  if (given.size() != secret.size() || secret.empty()) return false;
  // volatile: a compiler must not end the loop at the first difference.
  volatile int difference = 0;
  for (std::size_t i = 0; i < secret.size(); ++i) difference = difference | (given[i] ^ secret[i]);
  return difference == 0;
}

}  // namespace shelfbeam::serve::http
