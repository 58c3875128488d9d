#include "shelfbeam/scene/store/read_cache.hpp"

#include <cstddef>
#include <utility>

namespace shelfbeam {

const Material& ReadCache::material(const std::string& description, const std::function<Material()>& make) {
  constexpr std::size_t most = 1000;
  if (const auto found = materials_.find(description); found != materials_.end()) return found->second;
  Material made = make();
  if (materials_.size() == most) materials_.clear();
  return materials_.emplace(description, std::move(made)).first->second;
}

}  // namespace shelfbeam
