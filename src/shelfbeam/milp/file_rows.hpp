#pragma once

#include <span>
#include <string>
#include <vector>

#include "shelfbeam/milp/model.hpp"

namespace shelfbeam::milp::detail {

enum class Sense { at_least, at_most, equal };

/// A row as the file formats know it: one sense, one right-hand side, a safe name.
struct FileRow {
  std::string name;
  Sense sense = Sense::at_least;
  double bound = 0;
  std::span<const Entry> entries;
};

/// The rows of `model` in order; see model_file.hpp for what becomes of two-sided and unbounded ones. The
/// result refers to the model's entries.
std::vector<FileRow> file_rows(const Model& model);

std::vector<std::string> file_column_names(const Model& model);

}  // namespace shelfbeam::milp::detail
