#pragma once

#include "shelfbeam/material/material.hpp"

namespace shelfbeam::app {

/// Where the light that falls on a surface goes; the rest is absorbed.
struct MaterialShares {
  double reflected = 0, transmitted = 0;
};

/// Of light that falls in straight on.
MaterialShares shares_at_normal(const Material& material);

/// Of light that falls in evenly from a hemisphere (cosine-weighted).
MaterialShares hemispherical_shares(const Material& material);

}  // namespace shelfbeam::app
