#pragma once

#include <memory>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam::python {

/// A store with its scene, which share their lifetime with all results that need them.
struct Shop {
  Store store;
  Scene scene;
};

}  // namespace shelfbeam::python
