#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace shelfbeam {

/// Numbers for the scripts of a page: a JSON header and named arrays, deflated and base64-encoded.
///
///   base64(zlib(u32 length of the header, header, arrays one after the other))
///
/// The header is {"arrays": [{"name", "type", "count"}, ...], "about": ...}; everything is little-endian. An
/// array is stored in byte planes: the lowest byte of every element, then the next byte. Planes place similar
/// bytes (exponents, high bytes of small numbers) side by side, which deflate compresses better.
class PageData {
 public:
  /// Value: std::uint8_t, std::uint16_t, std::uint32_t, float or double.
  template <class Value>
  void add(std::string_view name, const std::vector<Value>& values) {
    add(name, std::is_floating_point_v<Value> ? 'f' : 'u', sizeof(Value), std::as_bytes(std::span(values)));
  }

  /// `about` is JSON.
  std::string base64(std::string_view about) const;

 private:
  void add(std::string_view name, char kind, std::size_t width, std::span<const std::byte> bytes);

  std::string arrays_;  ///< JSON objects, separated by commas
  std::string bytes_;
};

}  // namespace shelfbeam
