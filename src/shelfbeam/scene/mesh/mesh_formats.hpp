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

/// The lines of a mesh file as words, and the errors that its readers have in common.
class MeshLines {
 public:
  /// All three are kept by reference.
  MeshLines(std::string_view text, const std::filesystem::path& file, const std::string& where)
      : text_(text), file_(file), where_(where) {}

  /// The next line that is not blank.
  bool next();
  /// The same with the lines that follow a backslash at the end.
  bool next_continued();
  const std::vector<std::string_view>& words() const { return words_; }
  /// The line from the word of this number to its last.
  std::string_view from(std::size_t word) const;
  /// What follows the line.
  std::string_view rest() const { return text_.substr(std::min(at_, text_.size())); }

  /// Where the store file names the mesh.
  const std::string& where() const { return where_; }

  /// The word of this number. Throws InputError unless it is a coordinate.
  double coordinate(std::size_t word) const;
  /// The vertex of this number, from 0. Throws InputError unless it is finite.
  Vec3 finite(const Vec3& vertex, std::size_t number) const;
  /// Throws InputError where the triangles of a face with so many corners were not taken.
  void expect_taken(bool taken, std::size_t corners) const;
  /// InputError at the line.
  [[noreturn]] void fail(const std::string& problem) const;
  /// InputError about the whole file.
  [[noreturn]] void fail_file(const std::string& problem) const;

 private:
  std::string_view text_;
  const std::filesystem::path& file_;
  const std::string& where_;
  std::size_t at_ = 0, line_ = 0;
  std::vector<std::string_view> words_;
};

// The readers of mesh files, one a format. A count of a file is believed only as far as its bytes go. All
// throw InputError: for a file that ends early, an index beyond its vertices, a coordinate that is no finite
// number, and more triangles than the memory holds.

/// Vertices, faces and the names of their materials; all else is passed over.
void read_obj(MeshLines& lines, MeshTriangles& triangles);
/// ASCII or binary: a file that is as long as a binary one says is one, however it begins.
void read_stl(MeshLines& lines, MeshTriangles& triangles);
/// ASCII or binary: the elements `vertex` and `face`.
void read_ply(MeshLines& lines, MeshTriangles& triangles);
/// glTF 2.0, JSON or GLB: the nodes of the default scene, in place. Buffers lie in the file or beside it;
/// `name` is the file's in `folder`.
void read_gltf(MeshLines& lines, const std::filesystem::path& name, const StoreFolder& folder,
               MeshTriangles& triangles);

}  // namespace shelfbeam
