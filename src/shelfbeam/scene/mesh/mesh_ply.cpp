#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/mesh/mesh_formats.hpp"

namespace shelfbeam {

namespace {

constexpr double max_counted = 4294967295;  // uint is the widest type for counts

enum class Kind { signed_integer, unsigned_integer, real };

struct Type {
  Kind kind;
  std::size_t bytes;
};

struct Property {
  Type type;
  std::optional<Type> count = {};  ///< type of the count of a list
  std::optional<std::size_t> axis = {};
  bool is_corners = false;
};

struct Element {
  std::uint64_t count;
  bool is_vertex, is_face;
  std::vector<Property> properties = {};

  bool has_axis(std::size_t axis) const {
    return std::any_of(properties.begin(), properties.end(),
                       [&](const Property& p) { return p.axis == axis; });
  }
};

struct Header {
  std::string format;
  std::vector<Element> elements;
  double vertices = 0;
};

Type expect_type(const MeshLines& lines, std::string_view name) {
  using enum Kind;
  if (name == "char" || name == "int8") return {signed_integer, 1};
  if (name == "uchar" || name == "uint8") return {unsigned_integer, 1};
  if (name == "short" || name == "int16") return {signed_integer, 2};
  if (name == "ushort" || name == "uint16") return {unsigned_integer, 2};
  if (name == "int" || name == "int32") return {signed_integer, 4};
  if (name == "uint" || name == "uint32") return {unsigned_integer, 4};
  if (name == "float" || name == "float32") return {real, 4};
  if (name == "double" || name == "float64") return {real, 8};
  lines.fail("a property has an unknown type");
}

Property read_property(const MeshLines& lines, const Element& element) {
  const auto& words = lines.words();
  const std::string_view name = words.back();
  if (words.size() == 5 && words[1] == "list") {
    const Type count = expect_type(lines, words[2]);
    if (count.kind == Kind::real) lines.fail("the length of a list is not a whole number");
    return {.type = expect_type(lines, words[3]),
            .count = count,
            .is_corners = element.is_face && (name == "vertex_index" || name == "vertex_indices")};
  }
  if (words.size() != 3) lines.fail("'property', a type and a name are expected");
  Property property{.type = expect_type(lines, words[1])};
  constexpr std::string_view axes = "xyz";
  if (const std::size_t axis = name.size() == 1 ? axes.find(name) : axes.npos;
      element.is_vertex && axis != axes.npos)
    property.axis = axis;
  return property;
}

Header read_header(MeshLines& lines) {
  Header header;
  if (!lines.next() || (lines.words()[0] != "ply" && lines.words()[0] != "PLY"))
    lines.fail_file("does not begin with 'ply', so it is not a PLY file");
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "end_header") break;
    if (words[0] == "format") {
      header.format = words.size() > 1 ? words[1] : "";
    } else if (words[0] == "element") {
      const auto count = words.size() == 3 ? to_number(words[2]) : std::nullopt;
      if (!count || !(*count >= 0 && *count <= max_counted) || *count != std::floor(*count))
        lines.fail("'element', a name and a count are expected");
      header.elements.push_back(
          {static_cast<std::uint64_t>(*count), words[1] == "vertex", words[1] == "face"});
      if (words[1] == "vertex") header.vertices += *count;
      if (words[1] == "tristrips" && *count > 0)
        lines.fail("triangle strips are not supported; only the element 'face' is read");
    } else if (words[0] == "property") {
      if (header.elements.empty()) lines.fail("a property belongs to no element");
      header.elements.back().properties.push_back(read_property(lines, header.elements.back()));
    }
  }
  if (lines.words().empty() || lines.words()[0] != "end_header")
    lines.fail_file("ends before its 'end_header'");
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.count > 0) lines.fail_file("has an element without properties");
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (element.is_vertex && !element.has_axis(axis)) lines.fail_file("has vertices without x, y and z");
  }
  return header;
}

// Vertex indices of faces count from 0.
std::string index_problem(double index, double vertices) {
  return index >= 0 && index < vertices && index == std::floor(index)
             ? ""
             : fmt::format("a face names vertex {} of {}, counted from 0", index, vertices);
}

bool is_length(double count) {
  return count >= 0 && count <= max_counted && count == std::floor(count);
}

/// Reads the numbers of elements: words of an ASCII file, one element per line, or bytes of a binary file.
class Numbers {
 public:
  Numbers(MeshLines& lines, std::string_view format)
      : lines_(lines),
        bytes_(lines.rest()),
        is_ascii_(format == "ascii"),
        is_little_(format == "binary_little_endian") {}

  void begin_element() {
    if (is_ascii_ && !lines_.next()) fail_early();
    at_ = 0;
  }
  double coordinate(Type type) { return is_ascii_ ? lines_.coordinate(at_++) : next(type); }
  double next(Type type) {
    if (!is_ascii_) return next_bytes(type);
    const auto value = at_ < lines_.words().size() ? to_number(lines_.words()[at_]) : std::nullopt;
    if (!value) lines_.fail(fmt::format("a number is expected as value {}", at_ + 1));
    ++at_;
    return *value;
  }
  bool is_ascii() const { return is_ascii_; }
  /// Whether the file has more numbers or bytes behind its elements.
  bool continues() const { return is_ascii_ ? lines_.next() : !bytes_.empty(); }
  void bad_length() const {
    if (is_ascii_) lines_.fail(fmt::format("value {} is not the length of a list", at_));
    lines_.fail_file("is corrupt: a list has a negative length");
  }
  void bad_index(const std::string& problem) const {
    if (is_ascii_) lines_.fail(problem);
    lines_.fail_file(fmt::format("is corrupt: {}", problem));
  }

 private:
  [[noreturn]] void fail_early() const {
    lines_.fail_file("ends before the last element that its header counts");
  }
  double next_bytes(Type type) {
    if (type.bytes > bytes_.size()) fail_early();
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < type.bytes; ++k) {
      const std::size_t from = is_little_ ? type.bytes - 1 - k : k;
      bits = bits << 8 | static_cast<unsigned char>(bytes_[from]);
    }
    bytes_.remove_prefix(type.bytes);
    if (type.kind == Kind::real)
      return type.bytes == 8 ? std::bit_cast<double>(bits)
                             : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if (type.kind == Kind::unsigned_integer) return static_cast<double>(bits);
    return type.bytes == 1   ? static_cast<std::int8_t>(bits)
           : type.bytes == 2 ? static_cast<std::int16_t>(bits)
                             : static_cast<std::int32_t>(bits);
  }

  MeshLines& lines_;
  std::string_view bytes_;
  bool is_ascii_, is_little_;
  std::size_t at_ = 0;  ///< the next word
};

class PlyReader {
 public:
  PlyReader(MeshLines& lines, const Header& header)
      : lines_(lines), header_(header), numbers_(lines, header.format) {}

  void read(MeshTriangles& triangles) {
    for (const Element& element : header_.elements)
      for (std::uint64_t k = 0; k < element.count; ++k) read_element(element);
    if (numbers_.continues())
      triangles.note("continues after the last element that its header counts; the rest was ignored");
    triangles.note_single_precision(single_);
    // Faces may precede the vertices that they use.
    std::vector<Vec3> face;
    for (std::size_t begin = 0; begin < corners_.size(); begin += 1 + corners_[begin]) {
      face.clear();
      for (std::size_t k = 1; k <= corners_[begin]; ++k) face.push_back(vertices_[corners_[begin + k]]);
      lines_.require_added(triangles.add_face(face), face.size());
    }
  }

 private:
  void read_element(const Element& element) {
    numbers_.begin_element();
    Vec3 vertex{0, 0, 0};
    bool is_single = false;
    for (const Property& property : element.properties) {
      if (property.count) {
        read_list(property);
      } else if (property.axis) {
        const double value = numbers_.coordinate(property.type);
        if (property.type.kind == Kind::real && property.type.bytes == 4) is_single = !numbers_.is_ascii();
        (*property.axis == 0 ? vertex.x : *property.axis == 1 ? vertex.y : vertex.z) = value;
      } else {
        numbers_.next(property.type);
      }
    }
    if (element.is_vertex) vertices_.push_back(lines_.finite(vertex, vertices_.size()));
    if (is_single) single_.include(vertex);
  }

  void read_list(const Property& property) {
    const double count = numbers_.next(*property.count);
    if (!is_length(count)) numbers_.bad_length();
    const std::size_t begin = corners_.size();
    if (property.is_corners) corners_.push_back(0);
    for (auto left = static_cast<std::uint64_t>(count); left > 0; --left) {
      const double index = numbers_.next(property.type);
      if (!property.is_corners) continue;
      if (const auto problem = index_problem(index, header_.vertices); !problem.empty())
        numbers_.bad_index(problem);
      corners_.push_back(static_cast<std::uint32_t>(index));
      ++corners_[begin];
    }
  }

  const MeshLines& lines_;
  const Header& header_;
  Numbers numbers_;
  std::vector<Vec3> vertices_;
  Bounds single_;                       ///< of the vertices in single precision
  std::vector<std::uint32_t> corners_;  ///< for each face the number of corners, then their vertices
};

}  // namespace

void read_ply(MeshLines& lines, MeshTriangles& triangles) {
  lines.drop_mark();
  const Header header = read_header(lines);
  if (header.format != "ascii" && header.format != "binary_little_endian" &&
      header.format != "binary_big_endian")
    lines.fail_file("has an unknown 'format'; use ascii, binary_little_endian or binary_big_endian");
  PlyReader(lines, header).read(triangles);
}

}  // namespace shelfbeam
