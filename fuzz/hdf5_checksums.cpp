#include "hdf5_checksums.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace shelfbeam::fuzz {

namespace {

// Bob Jenkins' lookup3, hashlittle() with the initial value 0: what the HDF5 specification calls for.
std::uint32_t lookup3(std::string_view text) {
  const auto rotate = [](std::uint32_t x, int k) { return std::rotl(x, k); };
  std::uint32_t a = 0xdeadbeef + static_cast<std::uint32_t>(text.size()), b = a, c = a;
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4 && at + k < text.size(); ++k)
      value |= std::uint32_t{static_cast<unsigned char>(text[at + k])} << (8 * k);
    return value;
  };
  if (text.empty()) return c;
  std::size_t at = 0;
  for (; text.size() - at > 12; at += 12) {
    a += word(at), b += word(at + 4), c += word(at + 8);
    a -= c, a ^= rotate(c, 4), c += b;
    b -= a, b ^= rotate(a, 6), a += c;
    c -= b, c ^= rotate(b, 8), b += a;
    a -= c, a ^= rotate(c, 16), c += b;
    b -= a, b ^= rotate(a, 19), a += c;
    c -= b, c ^= rotate(b, 4), b += a;
  }
  a += word(at), b += word(at + 4), c += word(at + 8);
  c ^= b, c -= rotate(b, 14);
  a ^= c, a -= rotate(c, 11);
  b ^= a, b -= rotate(a, 25);
  c ^= b, c -= rotate(b, 16);
  a ^= c, a -= rotate(c, 4);
  b ^= a, b -= rotate(a, 14);
  c ^= b, c -= rotate(b, 24);
  return c;
}

class Checksums {
 public:
  explicit Checksums(std::string& bytes) : bytes_(bytes) {}

  void repair() {
    if (bytes_.size() >= 48) set(0, 44);
    for (std::size_t at = bytes_.find("OHDR"); at != std::string::npos; at = bytes_.find("OHDR", at + 4))
      repair_header(at);
  }

 private:
  std::uint64_t number(std::size_t at, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t k = size; k-- > 0;)
      value = value << 8 | (at + k < bytes_.size() ? static_cast<unsigned char>(bytes_[at + k]) : 0U);
    return value;
  }

  // The checksum of so many bytes, which follows them.
  void set(std::uint64_t at, std::uint64_t length) {
    if (at > bytes_.size() || length > bytes_.size() - at || bytes_.size() - at - length < 4) return;
    const std::uint32_t sum = lookup3(std::string_view(bytes_).substr(at, length));
    std::memcpy(bytes_.data() + at + length, &sum, sizeof sum);
  }

  void repair_header(std::size_t at) {
    const std::uint64_t flags = number(at + 5, 1);
    std::size_t first = at + 6 + ((flags & 0x20) != 0 ? 16 : 0) + ((flags & 0x10) != 0 ? 4 : 0);
    const std::size_t width = std::size_t{1} << (flags & 3);
    const std::uint64_t length = number(first, width);
    first += width;
    if (length > bytes_.size()) return;
    const std::size_t head = (flags & 4) != 0 ? 6 : 4;
    for (std::size_t message = first; message + head <= first + length;
         message += head + number(message + 1, 2)) {
      constexpr std::uint64_t continuation = 0x10;
      if (number(message, 1) != continuation) continue;
      const std::uint64_t size = number(message + head + 8, 8);
      if (size >= 4) set(number(message + head, 8), size - 4);
    }
    set(at, first - at + length);
  }

  std::string& bytes_;
};

}  // namespace

void repair_hdf5_checksums(std::string& bytes) {
  Checksums(bytes).repair();
}

}  // namespace shelfbeam::fuzz
