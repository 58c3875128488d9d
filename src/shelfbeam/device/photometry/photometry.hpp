#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam {

// Readers of measured profiles; docs/formats/photometry.md lists the accepted and rejected variants. theta of
// the table is the vertical angle (gamma), phi the horizontal angle (C); all symmetries are unfolded. A
// file's absolute values do not apply to infrared: keep only its shape by `with_integral(flux in W)`.
//
// Every reader returns a table with a positive integral or throws InputError with file and line. Counts are
// checked against the file size before memory is allocated.

/// IES LM-63 of 1986, 1991, 1995, 2002 and 2019, photometric types C and B. The values are in cd: the file's
/// values times multiplier, ballast factor and (1986 and 1991) ballast-lamp factor. The integral is the flux
/// in lm. Type B is resampled on a grid of theta and phi.
DirectionTable read_ies(const std::filesystem::path& file);
DirectionTable parse_ies(std::string_view text, const std::string& name);

/// EULUMDAT, symmetries 0 to 4. The values are in cd per 1000 lm of the lamps, times the conversion factor;
/// the integral is 1000 times the light output ratio.
DirectionTable read_eulumdat(const std::filesystem::path& file);
DirectionTable parse_eulumdat(std::string_view text, const std::string& name);

}  // namespace shelfbeam
