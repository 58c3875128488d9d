#include "shelfbeam/scene/mesh_ply.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/number.hpp"

namespace shelfbeam {

namespace {

enum class Kind { signed_integer, unsigned_integer, real };

struct Type {
  Kind kind;
  std::size_t bytes;
};

std::optional<Type> type_of(std::string_view name) {
  if (name == "char" || name == "int8") return Type{Kind::signed_integer, 1};
  if (name == "uchar" || name == "uint8") return Type{Kind::unsigned_integer, 1};
  if (name == "short" || name == "int16") return Type{Kind::signed_integer, 2};
  if (name == "ushort" || name == "uint16") return Type{Kind::unsigned_integer, 2};
  if (name == "int" || name == "int32") return Type{Kind::signed_integer, 4};
  if (name == "uint" || name == "uint32") return Type{Kind::unsigned_integer, 4};
  if (name == "float" || name == "float32") return Type{Kind::real, 4};
  if (name == "double" || name == "float64") return Type{Kind::real, 8};
  return std::nullopt;
}

struct Property {
  Type type;
  std::optional<Type> count;  ///< of a list
  bool is_coordinate, is_vertex_list;
};

struct Element {
  double count;
  bool is_vertex;
  std::vector<Property> properties;
};

struct Header {
  std::string format;
  std::vector<Element> elements;
  double vertices = 0;
};

Type expect_type(const MeshLines& lines, std::string_view name) {
  const auto type = type_of(name);
  if (!type) lines.fail("the type of a property is not known");
  return *type;
}

Property read_property(const MeshLines& lines, bool is_vertex) {
  const auto& words = lines.words();
  const std::string_view name = words.back();
  if (words.size() == 5 && words[1] == "list") {
    const Type count = expect_type(lines, words[2]);
    if (count.kind == Kind::real) lines.fail("the length of a list is no whole number");
    return {expect_type(lines, words[3]), count, false, name == "vertex_index" || name == "vertex_indices"};
  }
  if (words.size() != 3) lines.fail("'property' and a type and a name are expected");
  return {expect_type(lines, words[1]), std::nullopt,
          is_vertex && (name == "x" || name == "y" || name == "z"), false};
}

Header read_header(MeshLines& lines) {
  Header header;
  if (!lines.next() || (lines.words()[0] != "ply" && lines.words()[0] != "PLY"))
    lines.fail_file("does not begin with 'ply': it is no PLY file");
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "end_header") return header;
    if (words[0] == "format") {
      header.format = words.size() > 1 ? words[1] : "";
    } else if (words[0] == "element") {
      const auto count = words.size() == 3 ? to_number(words[2]) : std::nullopt;
      if (!count || !(*count >= 0 && *count <= 4294967295.0) || *count != std::floor(*count))
        lines.fail("'element' and a name and a count are expected");
      header.elements.push_back({*count, words[1] == "vertex", {}});
      if (words[1] == "vertex") header.vertices = *count;
    } else if (words[0] == "property") {
      if (header.elements.empty()) lines.fail("a property belongs to no element");
      header.elements.back().properties.push_back(read_property(lines, header.elements.back().is_vertex));
    }
  }
  lines.fail_file("ends before its 'end_header'");
}

// Faces count their vertices from 0.
std::string index_problem(double index, double vertices) {
  return index >= 0 && index < vertices && index == std::floor(index)
             ? ""
             : fmt::format("a face names the vertex {} of {}, counted from 0", index, vertices);
}

bool is_length(double count) {
  return count >= 0 && count == std::floor(count);
}

// An element a line.
void check_ascii(MeshLines& lines, const Header& header) {
  for (const Element& element : header.elements)
    for (double k = 0; k < element.count; ++k) {
      if (!lines.next()) lines.fail_file("ends before the last of the elements that its header counts");
      std::size_t at = 0;
      const auto number = [&] {
        const auto value = at < lines.words().size() ? to_number(lines.words()[at]) : std::nullopt;
        if (!value) lines.fail(fmt::format("a number is expected as value {}", at + 1));
        ++at;
        return *value;
      };
      for (const Property& property : element.properties) {
        if (property.is_coordinate) lines.expect_coordinate(at);
        if (!property.count) {
          number();
          continue;
        }
        double left = number();
        if (!is_length(left)) lines.fail(fmt::format("value {} is no length of a list", at));
        for (; left > 0; --left)
          if (const double index = number(); property.is_vertex_list)
            if (const auto problem = index_problem(index, header.vertices); !problem.empty())
              lines.fail(problem);
      }
    }
}

class PlyBytes {
 public:
  PlyBytes(std::string_view bytes, bool is_little) : bytes_(bytes), is_little_(is_little) {}

  bool skip(std::size_t count) {
    if (count > bytes_.size()) return false;
    bytes_.remove_prefix(count);
    return true;
  }
  std::optional<double> next(Type type) {
    if (type.bytes > bytes_.size()) return std::nullopt;
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
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
    return static_cast<double>(static_cast<std::int64_t>((bits ^ sign) - sign));
  }

 private:
  std::string_view bytes_;
  bool is_little_;
};

void check_binary(const MeshLines& lines, const Header& header) {
  PlyBytes bytes(lines.rest(), header.format == "binary_little_endian");
  const auto expect = [&](bool there) {
    if (!there) lines.fail_file("ends before the last of the elements that its header counts");
  };
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.count > 0) lines.fail_file("has an element without properties");
    for (double k = 0; k < element.count; ++k)
      for (const Property& property : element.properties) {
        if (!property.count) {
          expect(bytes.skip(property.type.bytes));
          continue;
        }
        const auto count = bytes.next(*property.count);
        expect(count.has_value());
        if (!is_length(*count)) lines.fail_file("is damaged: a list has a negative length");
        for (double left = *count; left > 0; --left) {
          const auto value = bytes.next(property.type);
          expect(value.has_value());
          if (!property.is_vertex_list) continue;
          if (const auto problem = index_problem(*value, header.vertices); !problem.empty())
            lines.fail_file(fmt::format("is damaged: {}", problem));
        }
      }
  }
}

}  // namespace

void check_ply(MeshLines& lines) {
  const Header header = read_header(lines);
  if (header.format == "ascii")
    check_ascii(lines, header);
  else if (header.format == "binary_little_endian" || header.format == "binary_big_endian")
    check_binary(lines, header);
  else
    lines.fail_file(
        "has a 'format' that is not known; ascii, binary_little_endian and binary_big_endian are");
}

}  // namespace shelfbeam
