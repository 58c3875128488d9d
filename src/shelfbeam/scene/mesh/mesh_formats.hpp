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

  /// Moves to the next line that is not blank; false at the end.
  bool next();
  /// Like `next`, and joins continuation lines after a backslash at the end.
  bool next_continued();
  const std::vector<std::string_view>& words() const { return words_; }
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
  std::string_view text_;
  const std::filesystem::path& file_;
  const std::string& where_;
  std::size_t at_ = 0, line_ = 0;
  std::vector<std::string_view> words_;
};

// The readers of mesh files, one per format. They check counts against the size of the file. They throw
// InputError for a truncated file, an index beyond the vertices, a coordinate that is not a finite number,
// and more triangles than the memory limit allows.

/// Reads vertices, faces and the names of their materials; ignores everything else.
void read_obj(MeshLines& lines, MeshTriangles& triangles);
/// ASCII or binary. A file is binary if it has the length that its binary header states, whatever its start.
void read_stl(MeshLines& lines, MeshTriangles& triangles);
/// ASCII or binary. Reads the elements `vertex` and `face`.
void read_ply(MeshLines& lines, MeshTriangles& triangles);
/// glTF 2.0, JSON or GLB. Reads the nodes of the default scene, with their transformations. Buffers are in
/// the file or beside it; `name` is the file's name in `folder`.
void read_gltf(MeshLines& lines, const std::filesystem::path& name, const StoreFolder& folder,
               MeshTriangles& triangles);

}  // namespace shelfbeam
