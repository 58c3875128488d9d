#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

InputError::InputError(const std::string& where, const std::string& problem, const std::string& suggestion)
    : std::runtime_error((where.empty() ? "" : where + ": ") + problem +
                         (suggestion.empty() ? "" : "; " + suggestion)),
      where_(where) {}

InputError::InputError(const InputError& error, const std::string& addition)
    : std::runtime_error(error.what() + ("; " + addition)), where_(error.where_) {}

OutputError::OutputError(const OutputError& error, const std::string& addition)
    : InputError(static_cast<const InputError&>(error), addition) {}

}  // namespace shelfbeam
