#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

InputError::InputError(const std::string& where, const std::string& problem, const std::string& suggestion,
                       Setting setting)
    : std::runtime_error((where.empty() ? "" : where + ": ") + problem +
                         (suggestion.empty() ? "" : "; " + suggestion)),
      where_(where),
      setting_(setting) {}

InputError::InputError(const InputError& error, const std::string& addition, Setting setting)
    : std::runtime_error(error.what() + ("; " + addition)), where_(error.where_), setting_(setting) {}

OutputError::OutputError(const OutputError& error, const std::string& addition, Setting setting)
    : InputError(static_cast<const InputError&>(error), addition, setting) {}

}  // namespace shelfbeam
