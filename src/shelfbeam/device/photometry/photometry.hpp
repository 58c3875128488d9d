#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam {

// Readers of measured profiles; docs/formats/photometry.md says what is read and what is refused. theta of
// the table is the vertical angle (gamma), phi the horizontal angle (C), all symmetries unfolded. What a file
// emits in absolute numbers is of no use in the infrared: take its shape with `with_integral(flux in W)`.
//
// Every reader returns a table whose integral is positive or throws InputError with file and line. Counts are
// compared with what the file has before memory is taken for them.

/// IES LM-63 of 1986, 1991, 1995, 2002 and 2019, photometric types C and B. Values in cd: the file's times
/// multiplier, ballast factor and (1986 and 1991) ballast-lamp factor, so the integral is the flux in lm.
/// Type B is resampled on a grid of theta and phi.
DirectionTable read_ies(const std::filesystem::path& file);
DirectionTable parse_ies(std::string_view text, const std::string& name);

/// EULUMDAT, symmetries 0 to 4. Values in cd for 1000 lm of the lamps, times the conversion factor: the
/// integral is 1000 times the light output ratio.
DirectionTable read_eulumdat(const std::filesystem::path& file);
DirectionTable parse_eulumdat(std::string_view text, const std::string& name);

}  // namespace shelfbeam
