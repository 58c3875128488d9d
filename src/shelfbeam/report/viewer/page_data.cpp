#include "shelfbeam/report/viewer/page_data.hpp"

#include <array>
#include <bit>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>
#include <zlib.h>

namespace shelfbeam {

namespace {

template <std::size_t size>
using Bits =
    std::conditional_t<size == 1, std::uint8_t,
                       std::conditional_t<size == 2, std::uint16_t,
                                          std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), 6) != Z_OK)
    throw std::runtime_error("zlib cannot compress the data of the page");
  out.resize(size);
  return out;
}

std::string to_base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    const std::size_t present = std::min<std::size_t>(3, bytes.size() - at);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < present ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= present ? digits[group >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
  }
  return out;
}

}  // namespace

template <class Value>
void PageData::add_planes(std::string_view name, std::string_view type, std::span<const Value> values) {
  arrays_ += fmt::format("{}{{\"name\":\"{}\",\"type\":\"{}\",\"count\":{}}}", arrays_.empty() ? "" : ",",
                         name, type, values.size());
  for (unsigned plane = 0; plane < sizeof(Value); ++plane)
    for (const Value& value : values)
      bytes_ += static_cast<char>(std::bit_cast<Bits<sizeof(Value)>>(value) >> (8U * plane) & 255U);
}

void PageData::add(std::string_view name, std::span<const std::uint8_t> values) {
  add_planes(name, "u8", values);
}
void PageData::add(std::string_view name, std::span<const std::uint16_t> values) {
  add_planes(name, "u16", values);
}
void PageData::add(std::string_view name, std::span<const std::uint32_t> values) {
  add_planes(name, "u32", values);
}
void PageData::add(std::string_view name, std::span<const float> values) {
  add_planes(name, "f32", values);
}
void PageData::add(std::string_view name, std::span<const double> values) {
  add_planes(name, "f64", values);
}

std::string PageData::base64(std::string_view about) const {
  const std::string header = fmt::format("{{\"arrays\":[{}],\"about\":{}}}", arrays_, about);
  std::string all;
  for (unsigned k = 0; k < 4; ++k)
    all += static_cast<char>(static_cast<std::uint32_t>(header.size()) >> (8U * k) & 255U);
  return to_base64(deflated(all + header + bytes_));
}

}  // namespace shelfbeam
