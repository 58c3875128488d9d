#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace shelfbeam::app {

/// Names of files by their paths from the folder of a batch.
inline constexpr auto database_name = "results.sqlite", table_name = "results.csv",
                      page_name = "results.html", tasks_name = "slurm/plan.sh",
                      collection_name = "slurm/collect.sh";

/// The hidden file with the hashes of the files that batches have written.
inline constexpr auto journal_name = ".batch.shelfbeam-record";

/// Prepares files of a batch for `replace_own_files`, which replaces only files that a batch has written.
/// `overwrite`: later, also the present files may be replaced. Throws InputError if one of them was not
/// written by a batch, or was changed since, and OutputError.
void expect_own_files(const std::filesystem::path& folder, const std::vector<std::string>& names,
                      bool overwrite);

/// Writes files of a batch to one of its folders, all or none: name -> content. Throws OutputError, also if a
/// file was not written by a batch, or was changed since.
void replace_own_files(const std::filesystem::path& folder,
                       const std::map<std::string, std::string>& contents);

}  // namespace shelfbeam::app
