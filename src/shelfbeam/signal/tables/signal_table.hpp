#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

struct SignalMatrix;

/// One non-zero entry of a row.
struct SignalEntry {
  std::uint32_t transceiver = 0;
  double signal = 0;
};

/// A signal matrix from anywhere, reduced to what placement needs; rows hold their non-zero entries in
/// ascending column order. Where a source has no requirement or costs the defaults below stand.
struct SignalTable {
  struct Label {
    std::string id;
    double requirement = 0;  ///< gamma tau; 0: not known, and to be set (set_requirement)
    /// Reach of one unit alone counts from here on; as `requirement` except where a file says otherwise
    /// (sparse text: g).
    double single_requirement = 0;
    double link_cost = 0;
    double signal_cost = 0;
  };
  struct Transceiver {
    std::string id;
    double cost = 1;
    bool installed = false;
    std::optional<Vec3> position = {};  ///< m; from signal files
  };

  std::vector<Label> labels;
  std::vector<Transceiver> transceivers;
  /// Columns that are options of one mounting point, of which at most one can be chosen: two or more each,
  /// ascending, no column twice. Every other column has a point of its own.
  std::vector<std::vector<std::uint32_t>> mounts;
  /// Pairs of columns that must not be chosen together, mounting points aside (signal/constraints/apart.hpp):
  /// the smaller first, ascending, no pair twice, no two installed units.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> apart;
  double min_spacing = 0;  ///< m; the distance that pairs of `apart` stand for, 0 without one (keep_apart)
  /// Where the rows come from several matrices (stack_tables): which, in order; else empty.
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

/// Candidates at the same place (math/places.hpp), two or more each: SignalTable::mounts.
std::vector<std::vector<std::uint32_t>> shared_mounts(const SignalMatrix& matrix);

/// The table of a simulated matrix (its means, requirements, costs, installed units and mounting points).
/// Throws InputError when two units are installed at one point; `name` stands for the matrix in it.
SignalTable make_signal_table(const SignalMatrix& matrix, const std::string& name = "signal matrix");

/// Reads a matrix from HDF5 (this program's signal file), CSV, NPY, sparse text, or an OR-Library `scp` or
/// `rail` file; text may be gzip-compressed. The kind is found from the content, not from the name.
/// Throws InputError with file and place for anything else: truncated, NaN, infinite or negative entries,
/// ragged rows, duplicate ids.
SignalTable read_signal_table(const std::filesystem::path& path);

/// Sets requirement and single requirement of every label.
void set_requirement(SignalTable& table, double requirement);

/// Costs from a CSV with header `id,cost` (transceivers) or `id,link_cost,signal_cost` (labels; either cost
/// column may be left out). Throws InputError for unknown or repeated ids and negative or non-finite costs.
void apply_costs(SignalTable& table, const std::filesystem::path& csv);

}  // namespace shelfbeam
