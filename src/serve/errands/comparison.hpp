#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

/// The command that compares measured signals with those of the newest plan in the folder of a project.
struct ComparisonCommand {
  std::vector<std::string> words;
  Json names;  ///< `plan` and `output`, the names of folders of the project
};

/// `file`: a CSV file in the folder; `of_pairs`: it names a transceiver for every signal. Throws InputError
/// without the file, and without a plan.
ComparisonCommand comparison_command(const std::filesystem::path& folder, const std::string& file,
                                     bool of_pairs);

}  // namespace shelfbeam::serve
