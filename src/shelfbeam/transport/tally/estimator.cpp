#include "shelfbeam/transport/tally/estimator.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace shelfbeam {

void expect_numbers(const Scene& scene, const Estimator::Block& block, const BatchValues& values) {
  for (const BatchValues::Value& value : values.values) {
    if (std::isfinite(value.total) && std::isfinite(value.direct)) continue;
    const std::uint32_t row = block.rows[value.entry / block.columns.size()];
    const std::uint32_t column = block.columns[value.entry % block.columns.size()];
    throw std::runtime_error(fmt::format(
        "the signal of label '{}' from {} came out as {}; please report this with the store",
        scene.labels[row].id,
        column < scene.transceivers.size() ? fmt::format("transceiver '{}'", scene.transceivers[column].id)
                                           : std::string("an emitting surface"),
        std::isfinite(value.total) ? value.direct : value.total));
  }
}

}  // namespace shelfbeam
