#include <algorithm>
#include <cstring>
#include <string_view>

#include "shelfbeam/signal/hdf5/hdf5_io.hpp"

// Texts are of fixed length: nothing in the file points anywhere. Octave reads none that are marked as UTF-8,
// so only those are marked that need it.

namespace shelfbeam::detail {

namespace {

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
}

}  // namespace

void Hdf5Writer::texts(const std::string& path, std::span<const std::string> values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::string padded;
  for (const std::string& value : values) padded += value + std::string(length - value.size(), '\0');
  write(path, {Hdf5Type::text, length, is_ascii(padded)}, {values.size()}, padded.data());
}

void Hdf5Writer::attribute(const std::string& name, const std::string& value) {
  const std::size_t length = std::max<std::size_t>(1, value.size());
  write_attribute(name, {Hdf5Type::text, length, is_ascii(value)}, value.c_str());
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path, std::size_t count) const {
  const Hdf5Type type = type_of(path, Hdf5Type::text, {count});
  std::string padded(type.size * count, '\0');
  read(path, type, padded.data());
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) {
    const char* begin = padded.data() + i * type.size;
    values.emplace_back(begin, strnlen(begin, type.size));
  }
  return values;
}

std::string Hdf5Reader::text_attribute(const std::string& name) const {
  const Hdf5Type type = type_of_attribute(name, Hdf5Type::text);
  std::string value(type.size, '\0');
  read_attribute(name, type, value.data());
  value.resize(strnlen(value.data(), value.size()));
  return value;
}

}  // namespace shelfbeam::detail
