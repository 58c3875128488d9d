#include "shelfbeam/scene/store/table_file.hpp"

#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

std::string TableFile::read(std::vector<Finding>& warnings) const {
  DecodedText decoded = decoded_text(file.read(), encoding);
  if (decoded.encoding) {
    const std::string name = file.name();
    const std::string_view code = to_text(*decoded.encoding);
    if (!decoded.is_whole)
      throw InputError(
          name, fmt::format("is not UTF-8{}", encoding ? fmt::format(", nor {}", code) : ""),
          fmt::format("{}, or name its encoding in 'encoding' of the store", save_table_as_utf8));
    if (!encoding)
      warnings.push_back(
          {FindingCode::text_encoding,
           name,
           {std::string(code), decoded.example},
           fmt::format(
               "{}: is not UTF-8; it is read as {}, with words such as {}; if they are wrong, name the "
               "encoding in 'encoding' of the store",
               name, code, in_quotes(decoded.example))});
  }
  return std::move(decoded.text);
}

}  // namespace shelfbeam
