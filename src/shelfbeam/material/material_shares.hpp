#pragma once

#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

/// Shares of the incident light that a surface reflects and transmits; it absorbs the rest.
struct MaterialShares {
  double reflected = 0, transmitted = 0;
};

/// Shares of light at normal incidence.
MaterialShares shares_at_normal(const Material& material);

/// Shares of light with equal radiance from the whole hemisphere (cosine-weighted).
MaterialShares hemispherical_shares(const Material& material);

}  // namespace shelfbeam
