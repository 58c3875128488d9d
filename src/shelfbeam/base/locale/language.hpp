#pragma once

#include <array>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The language of the texts and numbers of a report.
enum class Language { english, german };

/// ISO 639-1 codes, as in the store file.
template <>
inline constexpr auto names_of<Language> =
    std::to_array<Named<Language>>({{"en", Language::english}, {"de", Language::german}});

}  // namespace shelfbeam
