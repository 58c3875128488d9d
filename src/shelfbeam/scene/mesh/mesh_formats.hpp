#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/mesh/mesh_triangles.hpp"
#include "shelfbeam/scene/store_folder.hpp"

namespace shelfbeam {

/// Reads the lines of a mesh file as words and reports the common errors of all readers.
class MeshLines {
 public:
  /// The arguments are kept by reference.
  MeshLines(std::string_view text, const std::filesystem::path& file, const std::string& where)
      : text_(text), file_(file), where_(where) {}

  /// Removes a byte order mark; for texts, before the first line. Throws InputError for UTF-16 and UTF-32.
  void drop_mark();
  /// Moves to the next line that is not blank; false at the end. Lines end with LF, CR LF or CR.
  bool next();
  /// Like `next`, without comments that begin with '#', and with the lines that continue after a backslash.
  bool next_of_obj();
  const std::vector<std::string_view>& words() const { return words_; }
  /// The number of the current line, from 1.
  std::size_t line() const { return line_; }
  /// The line from this word (index from 0) to the last.
  std::string_view from(std::size_t word) const;
  /// The text after the current line.
  std::string_view rest() const { return text_.substr(std::min(at_, text_.size())); }

  /// The location in the store file that names the mesh.
  const std::string& where() const { return where_; }

  /// This word (index from 0) as a number. Throws InputError unless it is a finite coordinate.
  double coordinate(std::size_t word) const;
  /// Returns `vertex`. Throws InputError unless it is finite; `number` is its index from 0, for the message.
  Vec3 finite(const Vec3& vertex, std::size_t number) const;
  /// Throws InputError if MeshTriangles did not take (`taken`) a face with this number of corners.
  void require_added(bool taken, std::size_t corners) const;
  /// Throws InputError at the current line.
  [[noreturn]] void fail(const std::string& problem) const;
  /// Throws InputError about the whole file.
  [[noreturn]] void fail_file(const std::string& problem) const;

 private:
  /// Moves to the next line; false at the end.
  bool next_line();
  void drop_comment();

  std::string_view text_;
  const std::filesystem::path& file_;
  const std::string& where_;
  std::size_t at_ = 0, line_ = 0;
  bool ends_with_cr_ = false;  ///< the first line
  std::vector<std::string_view> words_;
};

// The readers of mesh files, one per format. They check counts against the size of the file. They throw
// InputError for a truncated file, an index beyond the vertices, a coordinate that is not a finite number,
// and more triangles than the memory limit allows.

/// Reads vertices, faces and the names of their materials; ignores everything else. A word of '#' and digits
/// at the end of a material's name belongs to the name ("Material #25"), any other begins a comment.
void read_obj(MeshLines& lines, MeshTriangles& triangles);
/// ASCII or binary. A file is binary if it has the length that its binary header states, or more,
/// regardless of its start.
void read_stl(MeshLines& lines, MeshTriangles& triangles);
/// ASCII or binary. Reads the elements `vertex` and `face`.
void read_ply(MeshLines& lines, MeshTriangles& triangles);
/// glTF 2.0, JSON or GLB. Reads the visible nodes of the default scene, with their transformations, copies,
/// morph targets and skins. Buffers are in the file or beside it; `name` is the file's name in `folder`.
void read_gltf(MeshLines& lines, const std::filesystem::path& name, const StoreFolder& folder,
               MeshTriangles& triangles);

}  // namespace shelfbeam
