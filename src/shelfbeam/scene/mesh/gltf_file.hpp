#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/store_folder.hpp"

namespace shelfbeam {

/// A glTF 2.0 file, .gltf or .glb, and the bytes of its buffers. Sizes and offsets in the file are checked
/// before use. All members throw InputError.
class GltfFile {
 public:
  /// `text` must outlive the object. `name` is the mesh's name in the store file; buffers are in its folder.
  GltfFile(std::string_view text, std::filesystem::path name, const StoreFolder& folder);

  const JsonCursor& root() const { return root_; }
  /// The object with this index in a list of the file ("meshes").
  JsonCursor item(std::string_view list, const JsonCursor& number) const;

  /// The elements of an accessor of this type ("VEC3"), one after the other, with its sparse values.
  std::vector<double> numbers(const JsonCursor& accessor, std::string_view type);
  /// Whether an accessor stores numbers in single precision.
  bool is_single(const JsonCursor& accessor) const;
  /// The positions of an accessor, which are finite.
  std::vector<Vec3> positions(const JsonCursor& accessor);
  /// The vertex indices of an accessor, each below `vertices`.
  std::vector<std::uint32_t> indices(const JsonCursor& accessor, std::size_t vertices);

 private:
  /// Elements of `components` numbers each in a buffer.
  struct Elements {
    std::string_view bytes;
    std::size_t count = 0, components = 1, stride = 0;
    std::int64_t type = 0;
    bool is_normalized = false;

    double at(std::size_t index, std::size_t component) const;
  };

  /// The elements of an accessor or of a part of a sparse one.
  Elements elements(const JsonCursor& owner, std::size_t count, std::size_t components,
                    const JsonCursor& kind);
  /// Replaces the values that a sparse accessor lists.
  void replace_sparse(const JsonCursor& accessor, std::size_t components, std::vector<double>& values);
  const std::string& buffer(const JsonCursor& number);
  std::string load(const JsonCursor& buffer, bool is_first) const;

  std::string_view json_, binary_;
  std::filesystem::path name_;
  const StoreFolder& folder_;
  JsonCursor root_;
  std::map<std::int64_t, std::string> buffers_;
};

}  // namespace shelfbeam
