#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace shelfbeam::app {

enum class Style { answer, warning, error };

/// Whether the stream is a terminal that understands escape codes.
bool is_terminal(std::FILE* stream);

/// The text as it is written to this stream: bold (answer), yellow or red on a terminal unless the variable
/// NO_COLOR is set, else unchanged.
std::string styled(Style style, std::string_view text, std::FILE* stream = stdout);

/// A text for standard output whose first line is the answer.
std::string with_answer(std::string_view text);

}  // namespace shelfbeam::app
