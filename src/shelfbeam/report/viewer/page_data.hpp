#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace shelfbeam {

/// Numbers for the scripts of a page: named arrays behind a JSON header, deflated and in base64.
///
///   base64(zlib(u32 length of the header, header, arrays one after the other))
///
/// The header is {"arrays": [{"name", "type", "count"}, ...], "about": ...}; everything is little-endian. The
/// bytes of an array stand in planes, first the lowest byte of every element, then the next: what is alike in
/// neighbours (exponents, the high bytes of small numbers) comes together, which deflate likes.
class PageData {
 public:
  void add(std::string_view name, std::span<const std::uint8_t> values);
  void add(std::string_view name, std::span<const std::uint16_t> values);
  void add(std::string_view name, std::span<const std::uint32_t> values);
  void add(std::string_view name, std::span<const float> values);
  void add(std::string_view name, std::span<const double> values);

  /// `about` is JSON.
  std::string base64(std::string_view about) const;

 private:
  template <class Value>
  void add_planes(std::string_view name, std::string_view type, std::span<const Value> values);

  std::string arrays_;  ///< JSON objects, separated by commas
  std::string bytes_;
};

}  // namespace shelfbeam
