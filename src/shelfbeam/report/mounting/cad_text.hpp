#pragma once

#include <string>
#include <string_view>

namespace shelfbeam {

/// `text`, in UTF-8, as a value of a drawing in DXF, in ASCII. Letters beyond ASCII, backslashes, blanks at
/// the ends and control characters become "\U+00FC", with two of these for characters beyond U+FFFF. "%%" and
/// "^" begin codes of CAD programs. A space without width stands between two percent signs, because some
/// programs read codes after the letters, and do not know the code for a percent sign; a caret becomes "^ ".
/// Different texts remain different.
std::string cad_text(std::string_view text);

}  // namespace shelfbeam
