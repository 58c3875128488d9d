#pragma once

#include <functional>
#include <map>
#include <string>

#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

/// Results of reading a store that take long, for the next reading of the same store. For one thread.
class ReadCache {
 public:
  /// The material with this description: as stored, or made and stored. May throw as `make`.
  const Material& material(const std::string& description, const std::function<Material()>& make);

 private:
  std::map<std::string, Material> materials_;
};

}  // namespace shelfbeam
