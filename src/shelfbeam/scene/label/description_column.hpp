#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam {

class CsvReader;

/// The columns of CSV files with the descriptions of labels, the preferred one first.
inline constexpr auto description_columns = std::to_array<std::string_view>(
    {"description", "name", "article_name", "product_name", "product", "article_description"});

/// The names of the columns of a header, in lower case and with underscores instead of blanks.
std::vector<std::string> column_keys(const CsvReader& header);

/// Throws InputError for a header with several columns of this name.
[[noreturn]] void fail_repeated(const CsvReader& header, std::string_view name);

/// The column of a header with descriptions; `first`: the first column that may be one. Throws InputError.
std::optional<std::size_t> description_column(const CsvReader& header, std::size_t first = 0);

/// A text as a description: in one line, without unprintable characters, and of limited length.
std::string description_of(std::string_view text);

}  // namespace shelfbeam
