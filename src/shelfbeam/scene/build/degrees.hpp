#pragma once

namespace shelfbeam {

/// The angle in degrees, 0 to 360, that `radians` turns into just this one, to the bit, if there is one
/// (there is for every angle that came from degrees), else the next larger.
double degrees_of(double angle);

}  // namespace shelfbeam
