#include "shelfbeam/base/provenance.hpp"

#include <istream>
#include <vector>

#include <fmt/format.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "shelfbeam/version.hpp"

namespace shelfbeam {

std::string_view program_version() {
  return SHELFBEAM_VERSION_STRING;
}

namespace {

std::string digits(XXH128_hash_t hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

std::string content_hash(std::string_view content) {
  return digits(XXH3_128bits(content.data(), content.size()));
}

std::string content_hash(std::istream& content) {
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  std::vector<char> piece(1 << 20);
  while (content) {
    content.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    XXH3_128bits_update(&state, piece.data(), static_cast<std::size_t>(content.gcount()));
  }
  return digits(XXH3_128bits_digest(&state));
}

std::uint64_t hash64(std::string_view text) {
  return XXH3_64bits(text.data(), text.size());
}

}  // namespace shelfbeam
