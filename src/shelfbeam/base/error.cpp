#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

InputError::InputError(const std::string& where, const std::string& problem, const std::string& suggestion)
    : std::runtime_error((where.empty() ? "" : where + ": ") + problem +
                         (suggestion.empty() ? "" : "; " + suggestion)),
      where_(where) {}

}  // namespace shelfbeam
