#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// Three elements of an array.
inline void append_point(std::vector<float>& values, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(v[axis]));
}

/// Numbers for the scripts of a page: a JSON header and named arrays, deflated and base64-encoded.
///
///   base64(zlib(u32 length of the header, header, arrays one after the other))
///
/// A server sends the same without compression, base64 and byte planes.
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
  /// The length of the header, the header, and the arrays as they are in memory.
  std::string binary(std::string_view about) const;

 private:
  void add(std::string_view name, char kind, std::size_t width, std::span<const std::byte> bytes);

  std::string header(std::string_view about) const;

  std::string arrays_;  ///< JSON objects, separated by commas
  std::string bytes_;
  std::vector<std::pair<std::size_t, std::size_t>> sizes_;  ///< of each array: width and all bytes
};

}  // namespace shelfbeam
