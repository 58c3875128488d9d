#include "shelfbeam/base/error.hpp"

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

InputError::InputError(const std::string& where, const std::string& problem, const std::string& suggestion,
                       Setting setting)
    : std::runtime_error(printable((where.empty() ? "" : where + ": ") + problem +
                                   (suggestion.empty() ? "" : "; " + suggestion))),
      where_(where),
      setting_(setting) {}

InputError::InputError(const InputError& error, const std::string& addition, Setting setting)
    : std::runtime_error(printable(error.what() + ("; " + addition))),
      where_(error.where_),
      setting_(setting) {}

}  // namespace shelfbeam
