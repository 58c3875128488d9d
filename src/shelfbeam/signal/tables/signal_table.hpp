#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

struct SignalMatrix;

/// One non-zero entry of a row.
struct SignalEntry {
  ColumnId transceiver;
  double signal = 0;
};

/// A signal matrix from any source, reduced to the input of placement. Rows contain their non-zero entries in
/// ascending column order. The defaults below apply to sources without requirement or costs.
struct SignalTable {
  struct Label {
    std::string id;
    double requirement = 0;  ///< gamma tau; 0: unknown, must be set (set_requirement)
    /// The signal from which one unit alone reaches the label; equals `requirement` unless the file gives
    /// another value (sparse text: g).
    double single_requirement = 0;
    double link_cost = 0;
    double signal_cost = 0;
    double weight = 1;  ///< in max coverage
  };
  struct Transceiver {
    std::string id;
    double cost = 1;
    bool installed = false;             ///< part of every selection: mounted already, or pinned
    std::optional<Vec3> position = {};  ///< m; from signal files
    bool pinned = false;                ///< the user chose it: installed, but its price is to be spent
  };

  std::vector<Label> labels;
  std::vector<Transceiver> transceivers;
  std::vector<std::string> excluded;  ///< ids of candidates without a column, which other files may name
  std::string currency;               ///< of the costs of transceivers; empty: not given
  /// Groups of columns that are options of one mounting point, of which at most one can be chosen: at least
  /// two each, ascending, without duplicates. Every other column has its own mounting point.
  std::vector<std::vector<ColumnId>> mounts;
  /// Pairs of columns that must not both be chosen (signal/constraints/conflicts.hpp), without those of one
  /// mounting point: smaller column first, ascending, no duplicates, no pairs of installed units.
  std::vector<std::pair<ColumnId, ColumnId>> conflicts;
  double min_spacing =
      0;  ///< m; the distance that pairs of `conflicts` enforce, 0 without one (add_conflicts)
  /// The scenarios of the rows, in order, if they come from several matrices (stack_tables); otherwise empty.
  struct Scenario {
    std::string name;
    std::size_t first = 0;  ///< row
    std::size_t labels = 0;
  };
  std::vector<Scenario> scenarios;
  std::vector<std::size_t> row_begin;  ///< m + 1 offsets into `entries`
  std::vector<SignalEntry> entries;

  std::size_t rows() const { return labels.size(); }
  std::size_t columns() const { return transceivers.size(); }
  std::size_t mounting_points() const {
    std::size_t count = columns();
    for (const auto& mount : mounts) count -= mount.size() - 1;
    return count;
  }
  std::span<const SignalEntry> row(std::size_t label) const {
    return std::span(entries).subspan(row_begin[label], row_begin[label + 1] - row_begin[label]);
  }
};

/// Groups of at least two candidates at the same position (math/distinct_positions.hpp): SignalTable::mounts.
std::vector<std::vector<ColumnId>> shared_mounts(const SignalMatrix& matrix);

/// The table of a simulated matrix (its means, requirements, costs, installed units and mounting points).
/// Throws InputError, which names the matrix as `name`, if two units are installed at one mounting point.
SignalTable make_signal_table(const SignalMatrix& matrix, const std::string& name = "signal matrix");

/// Reads a matrix from HDF5 (this program's signal file), CSV, NPY, sparse text, or an OR-Library `scp` or
/// `rail` file; text may be gzip-compressed. The format is detected from the content, not from the name.
/// Throws InputError with file and location for other or truncated files, NaN, infinite or negative entries,
/// ragged rows and duplicate ids.
SignalTable read_signal_table(const std::filesystem::path& path);

/// Sets the requirement and single requirement of every label.
void set_requirement(SignalTable& table, double requirement);

/// Sets costs from a CSV with header `id,cost` (transceivers) or `id,link_cost,signal_cost` (labels; either
/// cost column is optional). Throws InputError for unknown or duplicate ids and negative or non-finite costs.
void apply_costs(SignalTable& table, const std::filesystem::path& csv);

/// Sets weights of labels from a CSV with header `id,weight`. `scenarios` contains the labels' ids without
/// the name of their scenario, too. Throws InputError for unknown or duplicate ids and negative or non-finite
/// weights.
void apply_weights(SignalTable& table, const std::filesystem::path& csv);

}  // namespace shelfbeam
