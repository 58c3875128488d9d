#include "app/text/pipe.hpp"

#include <array>

#include <fmt/format.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam::app {

std::string standard_input(std::size_t limit, const std::string& remedy) {
  std::string text;
  std::array<char, 1 << 16> piece{};
  for (ssize_t got = 1; got > 0 && text.size() <= limit;
       text.append(piece.data(), static_cast<std::size_t>(got))) {
    got = ::read(STDIN_FILENO, piece.data(), piece.size());
    if (got < 0) throw InputError("standard input", "cannot be read", remedy);
  }
  if (text.size() > limit)
    throw InputError("standard input", fmt::format("is larger than {} MiB", limit >> 20), remedy);
  return text;
}

bool write_at_once(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace shelfbeam::app
