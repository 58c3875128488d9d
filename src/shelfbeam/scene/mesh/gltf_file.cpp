#include "shelfbeam/scene/mesh/gltf_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

namespace shelfbeam {

namespace {

constexpr const char* repair = "repair the mesh in the program that wrote it";
constexpr std::int64_t max_integer = std::int64_t{1}
                                     << 50;  // bytes or numbers: beyond any file, exact as a double

template <class T>
T value_at(std::string_view bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

template <class T>
double number_at(std::string_view bytes, std::size_t at) {
  return value_at<T>(bytes, at);
}

// The number types in a buffer.
struct Component {
  std::size_t bytes;
  double (*at)(std::string_view bytes, std::size_t at);
  double largest = 0;  // represents 1 in normalized numbers; 0: never normalized
};
constexpr std::int64_t first_component = 5120;
constexpr std::array<Component, 7> component_types{{{1, number_at<std::int8_t>, 127},
                                                    {1, number_at<std::uint8_t>, 255},
                                                    {2, number_at<std::int16_t>, 32767},
                                                    {2, number_at<std::uint16_t>, 65535},
                                                    {},
                                                    {4, number_at<std::uint32_t>},
                                                    {4, number_at<float>}}};

const Component& component_of(std::int64_t type) {
  return component_types[static_cast<std::size_t>(type - first_component)];
}

struct Chunks {
  std::string_view json, binary;
};

// A GLB file is a header of 12 bytes and chunks, each after its length and type. A .gltf file is plain JSON.
Chunks chunks_of(std::string_view text, const std::string& name) {
  if (!text.starts_with("glTF")) return {text, {}};
  const auto fail = [&](const char* problem) {
    throw InputError(name, problem, "it is truncated or corrupt: export it again");
  };
  constexpr std::uint32_t json_type = 0x4E4F534A, binary_type = 0x004E4942;
  if (text.size() < 20) fail("ends within its header");
  if (value_at<std::uint32_t>(text, 4) != 2) fail("is not glTF version 2");
  if (value_at<std::uint32_t>(text, 8) != text.size()) fail("does not have the length stated in its header");
  Chunks chunks;
  for (std::size_t at = 12; text.size() - at >= 8;) {
    const std::size_t length = value_at<std::uint32_t>(text, at);
    const auto type = value_at<std::uint32_t>(text, at + 4);
    at += 8;
    if (length > text.size() - at) fail("ends within a chunk");
    if (type == json_type && chunks.json.empty()) chunks.json = text.substr(at, length);
    if (type == binary_type && chunks.binary.empty()) chunks.binary = text.substr(at, length);
    at += length;
  }
  return chunks;
}

std::string from_base64(std::string_view text, const JsonCursor& place) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t group = 0;
  int bits = 0;
  while (text.ends_with('=')) text.remove_suffix(1);
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == digits.npos) place.fail("is not base64", "export the file again");
    group = group << 6 | static_cast<std::uint32_t>(digit);
    if ((bits += 6) < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 0xff);
  }
  return bytes;
}

// "a%20b.bin" -> "a b.bin"
std::string without_percent(std::string_view uri) {
  std::string name;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    unsigned char byte = 0;
    const char* const hex = uri.data() + k + 1;
    if (uri[k] == '%' && k + 2 < uri.size() && std::from_chars(hex, hex + 2, byte, 16).ptr == hex + 2) {
      name += static_cast<char>(byte);
      k += 2;
    } else {
      name += uri[k];
    }
  }
  return name;
}

std::size_t count_at(const JsonCursor& object, std::string_view key, std::int64_t otherwise) {
  const auto found = object.find(key);
  return static_cast<std::size_t>(found ? found->integer(0, max_integer) : otherwise);
}

// Indices are never normalized.
bool is_normalized(const JsonCursor& accessor) {
  const auto normalized = accessor.find("normalized");
  return normalized && normalized->boolean() && accessor["type"].text() != "SCALAR";
}

// Numbers per element of an accessor.
constexpr std::array<std::pair<std::string_view, std::size_t>, 4> element_types{
    {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};

}  // namespace

GltfFile::GltfFile(std::string_view text, std::filesystem::path name, const StoreFolder& folder)
    : name_(std::move(name)), folder_(folder), root_([&] {
        const auto [json, binary] = chunks_of(text, name_.string());
        json_ = json;
        binary_ = binary;
        return JsonCursor::parse(json_, name_.string(), folder_.memory());
      }()) {
  const std::string version = root_["asset"]["version"].text();
  if (!version.starts_with("2."))
    root_["asset"].fail(fmt::format("is version {}", version), "glTF 2.0 is required");
}

JsonCursor GltfFile::item(std::string_view list, const JsonCursor& number) const {
  const auto found = root_.find(list);
  const std::size_t count = found ? found->size() : 0;
  const auto index = number.integer(0, max_integer);
  if (index >= static_cast<std::int64_t>(count))
    number.fail(fmt::format("is {}, but there are {} {}", index, count, list), "export the file again");
  return found->element(static_cast<std::size_t>(index));
}

double GltfFile::Elements::at(std::size_t index, std::size_t component) const {
  const Component& kind = component_of(type);
  const double value = kind.at(bytes, index * stride + component * kind.bytes);
  return is_normalized && kind.largest > 0 ? std::max(value / kind.largest, -1.0) : value;
}

GltfFile::Elements GltfFile::elements(const JsonCursor& owner, std::size_t count, std::size_t components,
                                      const JsonCursor& kind) {
  Elements elements;
  elements.count = count;
  elements.components = components;
  elements.type = kind.integer(first_component, first_component + 6);
  if (component_of(elements.type).bytes == 0)
    kind.fail("is 5124", "5120 to 5123, 5125 and 5126 are supported");
  const JsonCursor view = item("bufferViews", owner["bufferView"]);
  const std::string& buffer = this->buffer(view["buffer"]);
  const std::size_t begin = count_at(view, "byteOffset", 0), length = count_at(view, "byteLength", 0);
  if (begin > buffer.size() || length > buffer.size() - begin)
    view.fail("extends beyond its buffer", "export the file again");
  const std::size_t size = components * component_of(elements.type).bytes;
  elements.stride = count_at(view, "byteStride", static_cast<std::int64_t>(size));
  const std::size_t offset = count_at(owner, "byteOffset", 0);
  // Elements must not overlap, so that memory for them never exceeds the size of the file.
  if (elements.stride < size || offset > length || size > length - offset ||
      (length - offset - size) / elements.stride < elements.count - 1)
    owner.fail("extends beyond its buffer view", "export the file again");
  elements.bytes = std::string_view(buffer).substr(begin, length).substr(offset);
  return elements;
}

std::vector<double> GltfFile::numbers(const JsonCursor& number, std::string_view type) {
  const JsonCursor accessor = item("accessors", number);
  if (accessor["type"].text() != type)
    accessor["type"].fail("is of another type", fmt::format("'{}' is expected", type));
  const auto known = std::find_if(element_types.begin(), element_types.end(),
                                  [&](const auto& entry) { return entry.first == type; });
  const std::size_t components = known->second;
  const auto count = static_cast<std::size_t>(accessor["count"].integer(1, max_integer));
  const bool is_sparse = accessor.find("sparse").has_value();
  std::vector<double> values;
  if (is_sparse && !accessor.find("bufferView")) {
    if (count > std::min<std::uint64_t>(folder_.memory(), max_mesh_file) / (sizeof(double) * components))
      accessor.fail("has more elements than fit in memory", "simplify the mesh, or raise the memory limit");
    values.resize(count * components);
  } else {
    Elements found = elements(accessor, count, components, accessor["componentType"]);
    found.is_normalized = is_normalized(accessor);
    values.reserve(count * components);
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t c = 0; c < components; ++c) values.push_back(found.at(k, c));
  }
  if (is_sparse) replace_sparse(accessor, components, values);
  return values;
}

void GltfFile::replace_sparse(const JsonCursor& accessor, std::size_t components,
                              std::vector<double>& values) {
  const JsonCursor sparse = accessor["sparse"], places = sparse["indices"];
  const auto count = static_cast<std::size_t>(sparse["count"].integer(1, max_integer));
  const Elements indices = elements(places, count, 1, places["componentType"]);
  Elements replaced = elements(sparse["values"], count, components, accessor["componentType"]);
  replaced.is_normalized = is_normalized(accessor);
  const std::size_t size = values.size() / components;
  for (std::size_t k = 0; k < count; ++k) {
    const double index = indices.at(k, 0);
    if (!(index >= 0 && index < static_cast<double>(size)) || index != std::floor(index))
      places.fail(fmt::format("names element {} of {}, counted from 0", index, size), repair);
    for (std::size_t c = 0; c < components; ++c)
      values[static_cast<std::size_t>(index) * components + c] = replaced.at(k, c);
  }
}

bool GltfFile::is_single(const JsonCursor& accessor) const {
  return item("accessors", accessor)["componentType"].integer(0, max_integer) == first_component + 6;
}

std::vector<Vec3> GltfFile::positions(const JsonCursor& accessor) {
  const std::vector<double> values = numbers(accessor, "VEC3");
  std::vector<Vec3> positions;
  positions.reserve(values.size() / 3);
  for (std::size_t k = 0; k < values.size(); k += 3) {
    positions.push_back({values[k], values[k + 1], values[k + 2]});
    if (!is_finite(positions.back()))
      accessor.fail(fmt::format("has a position that is not finite, vertex {} (counted from 0)", k / 3),
                    repair);
  }
  return positions;
}

std::vector<std::uint32_t> GltfFile::indices(const JsonCursor& accessor, std::size_t vertices) {
  std::vector<std::uint32_t> indices;
  for (const double index : numbers(accessor, "SCALAR")) {
    if (!(index >= 0 && index < static_cast<double>(vertices)) || index != std::floor(index))
      accessor.fail(fmt::format("names vertex {} of {}, counted from 0", index, vertices), repair);
    indices.push_back(static_cast<std::uint32_t>(index));
  }
  return indices;
}

const std::string& GltfFile::buffer(const JsonCursor& number) {
  const JsonCursor buffer = item("buffers", number);
  const auto index = number.integer(0, max_integer);
  const auto found = buffers_.find(index);
  if (found != buffers_.end()) return found->second;
  return buffers_.emplace(index, load(buffer, index == 0)).first->second;
}

std::string GltfFile::load(const JsonCursor& buffer, bool is_first) const {
  const auto uri = buffer.find("uri");
  std::string bytes;
  if (!uri) {
    if (const auto extensions = buffer.find("extensions"))
      for (const auto& [extension, value] : extensions->members())
        if (extension.ends_with("meshopt_compression"))
          value.fail("is the only form of the data, and is not supported", "export the file without it");
    if (!is_first || binary_.empty())
      buffer.fail("has no 'uri', and the file has no binary chunk", "export it again");
    bytes = binary_;
  } else {
    const std::string text = uri->text();
    if (text.starts_with("data:")) {
      constexpr std::string_view marker = ";base64,";
      const auto begin = text.find(marker);
      if (begin == std::string::npos) uri->fail("is not base64", "export the file again");
      bytes = from_base64(std::string_view(text).substr(begin + marker.size()), *uri);
    } else {
      bytes = folder_.find(name_.parent_path() / without_percent(text), uri->where(), "buffer")
                  .read(max_mesh_file);
    }
  }
  const auto length = static_cast<std::size_t>(buffer["byteLength"].integer(0, max_integer));
  if (length > bytes.size())
    buffer.fail(fmt::format("has {} bytes instead of {}", bytes.size(), length), "export the file again");
  bytes.resize(length);
  return bytes;
}

}  // namespace shelfbeam
