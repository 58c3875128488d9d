#include "shelfbeam/scene/store/scene_memory.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

void SceneMemory::add(double bytes, const std::string& where) {
  bytes_ += bytes;
  const auto limit = static_cast<double>(limit_);
  if (bytes_ > limit)
    throw InputError(
        where,
        fmt::format("the store up to here requires about {:.3g} GB of memory; the limit is {:.3g} GB",
                    1e-9 * bytes_, 1e-9 * limit),
        "use wider spacings or simpler meshes, or raise the limit", Setting::memory);
}

}  // namespace shelfbeam
