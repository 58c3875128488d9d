#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/fresh_sums.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Fresh batches of one label: means, standard errors and flags (SignalMatrix::flags) by column.
struct FreshRow {
  std::uint32_t label = 0;
  std::vector<double> mean, standard_error;
  std::vector<std::uint8_t> flags;
  std::uint32_t batches = 0;
  std::uint64_t samples = 0;  ///< first rays
};

/// Of a label whose sums k begin with its signals, those of the columns in this order.
FreshRow fresh_row(const FreshSums& fresh, std::size_t k, std::uint32_t label,
                   std::span<const std::uint32_t> order);

/// Samples some labels afresh, for all sources. Throws as `sample_batches`.
std::vector<FreshRow> fresh_rows(const Scene& scene, const std::vector<std::uint32_t>& labels,
                                 const VerificationEffort& effort, const RunControl& control = {});

/// Joins one to its label's row: means and errors become those of all batches together, by samples. An entry
/// is flagged where a part is that has half of the samples or more, or of the error. Parts by bounce and by
/// path length are dropped, and direct parts stay.
void join(const FreshRow& fresh, SignalMatrix& matrix);

/// What joining such rows is going to change of a matrix.
class RowsBefore {
 public:
  /// Takes the parts by bounce and by path length out of the matrix.
  RowsBefore(SignalMatrix& matrix, std::span<const FreshRow> fresh);
  void restore(SignalMatrix& matrix);

 private:
  struct Row {
    std::uint32_t label = 0;
    LabelRow about;
    std::vector<float> mean, standard_error;
    std::vector<std::uint8_t> flags;  ///< empty where the matrix has none
  };
  std::vector<Row> rows_;
  std::vector<SignalLayer> by_bounce_, by_length_;
};

}  // namespace shelfbeam
