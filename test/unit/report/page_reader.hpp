#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>
#include <zlib.h>

// Reads the output of PageData, as the page's script does.
namespace shelfbeam::test {

inline std::string from_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  if (text.size() % 4 != 0) throw std::runtime_error("not in groups of four");
  std::string bytes;
  for (std::size_t at = 0; at < text.size(); at += 4) {
    std::uint32_t group = 0;
    std::size_t present = 4;
    for (std::size_t k = 0; k < 4; ++k) {
      const char c = text[at + k];
      if (c == '=')
        present = std::min(present, k);
      else if (digits.find(c) == digits.npos)
        throw std::runtime_error("not base64");
      group = group << 6U | (c == '=' ? 0U : static_cast<std::uint32_t>(digits.find(c)));
    }
    for (std::size_t k = 0; k + 1 < present; ++k)
      bytes += static_cast<char>(group >> (16U - 8U * static_cast<unsigned>(k)) & 255U);
  }
  return bytes;
}

inline std::string inflated(const std::string& bytes) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("zlib");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out;
  int status = Z_OK;
  while (status == Z_OK) {
    std::string piece(1 << 16, '\0');
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    status = inflate(&stream, Z_NO_FLUSH);
    out.append(piece, 0, piece.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("not deflated, or cut off");
  return out;
}

class PageReader {
 public:
  explicit PageReader(std::string_view base64) {
    const std::string all = inflated(from_base64(base64));
    std::uint32_t size = 0;
    std::memcpy(&size, all.data(), sizeof size);
    const auto header = nlohmann::json::parse(all.substr(4, size));
    about = header["about"];
    std::size_t at = 4 + size;
    for (const auto& array : header["arrays"]) {
      const std::string type = array["type"];
      const std::size_t width = type == "u8" ? 1 : type == "u16" ? 2 : type == "f64" ? 8 : 4;
      const std::size_t count = array["count"];
      std::string& bytes = arrays_[array["name"]];
      bytes.resize(width * count);
      for (std::size_t plane = 0; plane < width; ++plane)
        for (std::size_t k = 0; k < count; ++k) bytes[k * width + plane] = all.at(at++);
    }
    if (at != all.size()) throw std::runtime_error("arrays and bytes do not agree");
  }

  template <class Value>
  std::vector<Value> get(const std::string& name) const {
    const std::string& bytes = arrays_.at(name);
    std::vector<Value> values(bytes.size() / sizeof(Value));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  nlohmann::json about;

 private:
  std::map<std::string, std::string> arrays_;
};

}  // namespace shelfbeam::test
