#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "shelfbeam/material/material.hpp"
#include "shelfbeam/scene/mesh/mesh_import.hpp"

namespace shelfbeam {

/// Results of reading a store that take long, for the next reading of the same store. For one thread.
class ReadCache {
 public:
  /// The material with this description: as stored, or made and stored. May throw as `make`.
  const Material& material(const std::string& description, const std::function<Material()>& make);

  /// The mesh with this description, if it is stored.
  const ImportedMesh* mesh(const std::string& description) const;
  /// Stores a mesh, unless it is large.
  void store(const std::string& description, const ImportedMesh& mesh);

 private:
  std::map<std::string, Material> materials_;
  std::map<std::string, ImportedMesh> meshes_;
  std::size_t mesh_bytes_ = 0;
};

}  // namespace shelfbeam
