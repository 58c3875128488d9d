#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam {

/// Hashes values, numbers as bytes, because conversion to text would be slow for many. It keeps at most about
/// a megabyte of them.
class ContentBytes {
 public:
  ContentBytes& add(std::string_view text) {
    append(text.size());
    bytes_ += text;
    return *this;
  }
  template <class Number>
    requires std::is_arithmetic_v<Number>
  ContentBytes& add(Number number) {
    append(static_cast<Number>(number + Number{}));  // 0 for -0
    return *this;
  }
  template <class Enum>
    requires std::is_enum_v<Enum>
  ContentBytes& add(Enum value) {
    return add(static_cast<std::underlying_type_t<Enum>>(value));
  }

  std::string hash() const { return content_hash(bytes_); }
  std::uint64_t key() const { return hash64(bytes_); }

 private:
  template <class T>
  void append(const T& value) {
    constexpr std::size_t kept = 1 << 20;
    if (bytes_.size() >= kept) bytes_ = content_hash(bytes_);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }

  std::string bytes_;
};

}  // namespace shelfbeam
