#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "shelfbeam/signal/signal_matrix.hpp"

// The members of labels and transceivers in a signal file.

namespace shelfbeam::detail {

/// The type in which a member is stored.
template <class T>
using Stored = std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>;

/// Calls use(path, member) for every member of labels, ids first.
template <class Use>
void each_label_member(const Use& use) {
  use("/labels/id", &LabelRow::id);
  use("/labels/type", &LabelRow::type);
  use("/labels/position", &LabelRow::position);
  use("/labels/normal", &LabelRow::normal);
  use("/labels/requirement", &LabelRow::requirement);
  use("/labels/link_cost", &LabelRow::link_cost);
  use("/labels/signal_cost", &LabelRow::signal_cost);
  use("/labels/batches", &LabelRow::batches);
  use("/labels/samples", &LabelRow::samples);
}
template <class Use>
void each_unit_member(const Use& use) {
  use("/transceivers/id", &TransceiverColumn::id);
  use("/transceivers/type", &TransceiverColumn::type);
  use("/transceivers/position", &TransceiverColumn::position);
  use("/transceivers/axis", &TransceiverColumn::axis);
  use("/transceivers/cost", &TransceiverColumn::cost);
  use("/transceivers/installed", &TransceiverColumn::installed);
}

}  // namespace shelfbeam::detail
