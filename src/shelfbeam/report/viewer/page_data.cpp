#include "shelfbeam/report/viewer/page_data.hpp"

#include <bit>
#include <stdexcept>

#include <fmt/format.h>
#include <zlib.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), 6) != Z_OK)
    throw std::runtime_error("zlib cannot compress the data of the page");
  out.resize(size);
  return out;
}

}  // namespace

void PageData::add(std::string_view name, char kind, std::size_t width, std::span<const std::byte> bytes) {
  static_assert(std::endian::native == std::endian::little);
  arrays_ += fmt::format("{}{{\"name\":\"{}\",\"type\":\"{}{}\",\"count\":{}}}", arrays_.empty() ? "" : ",",
                         name, kind, 8 * width, bytes.size() / width);
  bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  sizes_.emplace_back(width, bytes.size());
}

std::string PageData::header(std::string_view about) const {
  const std::string header = fmt::format("{{\"arrays\":[{}],\"about\":{}}}", arrays_, about);
  std::string all;
  for (unsigned k = 0; k < 4; ++k)
    all += static_cast<char>(static_cast<std::uint32_t>(header.size()) >> (8U * k) & 255U);
  return all + header;
}

std::string PageData::binary(std::string_view about) const {
  return header(about) + bytes_;
}

std::string PageData::base64(std::string_view about) const {
  std::string all = header(about);
  all.reserve(all.size() + bytes_.size());
  std::size_t begin = 0;
  for (const auto& [width, size] : sizes_) {
    for (std::size_t plane = 0; plane < width; ++plane)
      for (std::size_t k = plane; k < size; k += width) all += bytes_[begin + k];
    begin += size;
  }
  return to_base64(deflated(all));
}

}  // namespace shelfbeam
