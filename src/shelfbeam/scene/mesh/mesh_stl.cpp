#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/mesh/mesh_formats.hpp"

namespace shelfbeam {

namespace {

/// Reads an ASCII file word by word, because line ends have no meaning in it. Unknown words are ignored, but
/// every facet must be complete.
class AsciiStl {
 public:
  AsciiStl(MeshLines& lines, MeshTriangles& triangles) : lines_(lines), triangles_(triangles) {}

  void read() {
    while (advance()) {
      const std::string word = lower_case(lines_.words()[at_]);
      if (word == "solid" || word == "endsolid") {
        if (facet_line_ > 0) fail_open(word);
        is_open_ = word == "solid";
        at_ = lines_.words().size() - 1;  // a name follows
      } else if (word == "facet") {
        if (facet_line_ > 0) fail_open("the next 'facet'");
        facet_line_ = lines_.line();
      } else if (word == "loop") {
        is_loop_ = true;
      } else if (word == "vertex") {
        read_vertex();
      } else if (word == "endloop") {
        end_loop();
      } else if (word == "endfacet") {
        end_facet();
      }
    }
    if (facet_line_ > 0)
      lines_.fail_file(
          fmt::format("ends within the facet that begins in line {}, so it is truncated", facet_line_));
    if (is_open_) lines_.fail_file("ends before 'endsolid', so it is truncated or not an STL file");
  }

 private:
  // Moves to the next word.
  bool advance() {
    if (++at_ < lines_.words().size()) return true;
    at_ = 0;
    return lines_.next();
  }

  [[noreturn]] void fail_open(const std::string& before) const {
    lines_.fail(fmt::format("the facet that begins in line {} has no '{}' before {}", facet_line_,
                            is_loop_ ? "endloop" : "endfacet", before));
  }

  void read_vertex() {
    if (!is_loop_) lines_.fail("a vertex is outside 'outer loop' and 'endloop'");
    if (corners_.size() == 3)
      lines_.fail(fmt::format("the facet that begins in line {} has more than three vertices", facet_line_));
    const std::size_t line = lines_.line();
    double numbers[3];
    for (double& number : numbers) {
      if (!advance() || (lines_.line() != line && !to_number(lines_.words()[at_])))
        lines_.fail(fmt::format("the vertex in line {} has fewer than three coordinates", line));
      number = lines_.coordinate(at_);
    }
    corners_.push_back({numbers[0], numbers[1], numbers[2]});
  }

  void end_loop() {
    if (!is_loop_ || facet_line_ == 0) lines_.fail("'endloop' ends no loop of a facet");
    if (corners_.size() < 3)
      lines_.fail(fmt::format("the facet that begins in line {} has {}, not three", facet_line_,
                              counted(corners_.size(), "vertex", "vertices")));
    lines_.require_added(triangles_.add({corners_[0], corners_[1], corners_[2]}), 3);
    corners_.clear();
    is_loop_ = false;
    has_loop_ = true;
  }

  void end_facet() {
    if (facet_line_ == 0) lines_.fail("'endfacet' ends no facet");
    if (is_loop_) fail_open("'endfacet'");
    if (!has_loop_) lines_.fail(fmt::format("the facet that begins in line {} has no vertices", facet_line_));
    has_loop_ = false;
    facet_line_ = 0;
  }

  MeshLines& lines_;
  MeshTriangles& triangles_;
  std::vector<Vec3> corners_;
  std::size_t at_ = 0, facet_line_ = 0;  ///< the line where the open facet begins; 0: none is open
  bool is_open_ = true, is_loop_ = false, has_loop_ = false;
};

constexpr std::size_t header = 84, facet = 50;

/// The facets of a binary file: a normal, which is ignored, three corners, and the number of bytes of data
/// behind them. Most writers use this number for a colour instead, so that no data follow.
class BinaryStl {
 public:
  BinaryStl(MeshLines& lines, MeshTriangles& triangles)
      : lines_(lines), triangles_(triangles), bytes_(lines.rest()) {}

  // A binary file may begin with the "solid" of ASCII files, so its length is decisive: a text would state
  // more facets in its count than files can have.
  bool is_binary() const { return bytes_.size() >= header && bytes_.size() >= header + facet * count(); }

  bool is_truncated() const {
    return bytes_.size() >= header && bytes_.substr(0, header + facet).find('\0') != bytes_.npos &&
           bytes_.find("endsolid") == bytes_.npos;
  }

  void read() {
    read_facets();
    triangles_.note_single_precision(bounds_);
  }

 private:
  void read_facets() {
    const std::size_t plain = header + facet * count(), behind = bytes_.size() - plain;
    if (behind > 0 && has_data()) {
      for (std::size_t at = header; at < bytes_.size(); at += facet + data_at(at)) read_facet(at);
      return;
    }
    // A program that writes while it scans may not return to the count.
    const bool is_uncounted = count() == 0 && behind > 0 && behind % facet == 0;
    if (behind >= facet && !is_uncounted)
      lines_.fail_file(fmt::format("states {} in its header, but is long enough for {}",
                                   counted(count(), "facet"), grouped((bytes_.size() - header) / facet)));
    if (behind > 0)
      triangles_.note(
          is_uncounted
              ? fmt::format("states no facets in its header, but contains {}, which were read",
                            grouped(behind / facet))
              : fmt::format("has {} behind its facets, which were ignored", counted(behind, "byte")));
    const std::size_t end = is_uncounted ? bytes_.size() : plain;
    for (std::size_t at = header; at < end; at += facet) read_facet(at);
  }

  std::size_t count() const {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes_.data() + header - sizeof count, sizeof count);
    return count;
  }

  std::size_t data_at(std::size_t at) const {
    std::uint16_t bytes = 0;
    std::memcpy(&bytes, bytes_.data() + at + facet - sizeof bytes, sizeof bytes);
    return bytes;
  }

  // Whether the facets with their data fill the file.
  bool has_data() const {
    std::size_t at = header;
    for (std::size_t left = count(); left > 0; --left) {
      if (at > bytes_.size() || bytes_.size() - at < facet) return false;
      at += facet + data_at(at);
    }
    return at == bytes_.size();
  }

  void read_facet(std::size_t at) {
    float numbers[9];
    std::memcpy(numbers, bytes_.data() + at + 12, sizeof numbers);
    MeshTriangles::Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = lines_.finite({numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]}, vertex_++);
      bounds_.include(triangle[k]);
    }
    lines_.require_added(triangles_.add(triangle), 3);
  }

  MeshLines& lines_;
  MeshTriangles& triangles_;
  std::string_view bytes_;
  std::size_t vertex_ = 0;
  Bounds bounds_;
};

}  // namespace

void read_stl(MeshLines& lines, MeshTriangles& triangles) {
  BinaryStl binary(lines, triangles);
  if (binary.is_binary()) {
    binary.read();
    return;
  }
  lines.drop_mark();
  if (binary.is_truncated()) lines.fail_file("ends before the last facet that its binary header counts");
  AsciiStl(lines, triangles).read();
}

}  // namespace shelfbeam
