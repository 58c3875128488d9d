#pragma once

#include <string_view>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::bench {

struct PreviewShop {
  std::string_view name;
  Scene scene;
};

/// Eight shops that are difficult for previews: white rooms with labels behind a large fixture, a dark room,
/// strips of 5 to 60 cm between fixtures and walls, columns, and shelves turned round.
std::vector<PreviewShop> preview_shops();

}  // namespace shelfbeam::bench
