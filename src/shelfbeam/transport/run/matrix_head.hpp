#pragma once

#include <cstdint>
#include <string>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/signal_rows.hpp"

namespace shelfbeam::detail {

/// A matrix without entries: what is known of labels and sources.
SignalMatrix matrix_head(const Scene& scene, const std::string& store_hash, std::uint64_t seed,
                         const std::string& estimator);

/// The same with its entries.
SignalMatrix filled(SignalMatrix head, const SignalRows& rows);

}  // namespace shelfbeam::detail
