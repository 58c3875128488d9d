#include "shelfbeam/scene/label/description_column.hpp"

#include <algorithm>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

std::vector<std::string> column_keys(const CsvReader& header) {
  std::vector<std::string> names = header.column_names();
  for (std::string& name : names) std::replace(name.begin(), name.end(), ' ', '_');
  return names;
}

std::optional<std::size_t> description_column(const CsvReader& header, std::size_t first) {
  const std::vector<std::string> names = column_keys(header);
  const auto begin = names.begin() + static_cast<std::ptrdiff_t>(std::min(first, names.size()));
  for (const std::string_view known : description_columns)
    if (const auto found = std::find(begin, names.end(), known); found != names.end())
      return static_cast<std::size_t>(found - names.begin());
  return {};
}

std::string description_of(std::string_view text) {
  constexpr std::size_t longest = 200;  // bytes
  std::string line;
  bool is_after_blank = true;
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    const bool is_blank = character.code == ' ' || !character.is_printable;
    if (!is_blank)
      line += text.substr(i, character.bytes);
    else if (!is_after_blank)
      line += ' ';
    is_after_blank = is_blank;
    i += character.bytes;
  }
  return shortened(trim(line), longest);
}

}  // namespace shelfbeam
