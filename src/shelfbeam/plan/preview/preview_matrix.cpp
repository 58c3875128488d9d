#include "shelfbeam/plan/preview/preview_matrix.hpp"

#include <cstddef>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"

namespace shelfbeam {

SignalMatrix preview_matrix(const Scene& scene, const LightOperator& light, std::uint64_t seed,
                            const RunControl& control) {
  SignalMatrix matrix = detail::matrix_head(scene, scene.store_hash, seed, "preview");
  const std::size_t m = matrix.rows(), units = scene.transceivers.size();
  matrix.mean.resize(m * matrix.columns());
  matrix.standard_error.resize(m * matrix.columns());
  matrix.direct.resize(m * matrix.columns());
  for (std::size_t j = 0; j < units; ++j) {
    if (control.cancelled()) throw Interrupted("the signals of the candidates were not previewed completely");
    const Preview column = light.column(scene.transceivers[j]);
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t entry = matrix.at(i, j);
      matrix.mean[entry] = column.signal[i];
      matrix.standard_error[entry] = column.error[i];
      matrix.direct[entry] = column.direct[i];
    }
    control.report(Task::preparing, static_cast<double>(j + 1) / static_cast<double>(units));
  }
  return matrix;
}

}  // namespace shelfbeam
