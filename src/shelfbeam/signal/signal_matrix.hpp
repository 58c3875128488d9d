#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// Properties of a label besides its row of signals.
struct LabelRow {
  std::string id;
  std::string type;
  Vec3 position;           ///< m
  Vec3 normal;             ///< unit length
  double requirement = 0;  ///< gamma tau, in the signal's unit of measure (3.6); 0 if unknown
  double link_cost = 0;    ///< c_i^E of (3.3)
  double signal_cost = 0;  ///< delta_i of (3.14)
  std::uint32_t batches = 0;
  std::uint64_t samples = 0;  ///< first rays drawn for this label, all batches
  std::uint64_t light = 0;    ///< LightKeys::labels, if Provenance::light_hash is known

  bool operator==(const LabelRow&) const = default;
};

/// Properties of a candidate besides its column of signals.
struct TransceiverColumn {
  std::string id;
  std::string type;
  Vec3 position;    ///< m
  Vec3 axis;        ///< unit length
  double cost = 1;  ///< c_j^T of (3.3)
  bool installed = false;
  bool pinned = false;      ///< not installed, but part of every selection
  std::uint64_t light = 0;  ///< LightKeys::transceivers, if Provenance::light_hash is known

  bool operator==(const TransceiverColumn&) const = default;
};

/// The part of a signal matrix from a subset of the paths.
struct SignalLayer {
  std::vector<float> mean, standard_error;  ///< m n entries, as in SignalMatrix

  bool operator==(const SignalLayer&) const = default;
};

/// The signals of a shop that varies, in some of its states, multiplied by the relative sensitivities of the
/// labels, so that the requirements apply.
struct StateTensor {
  std::uint32_t states = 0;
  /// m n entries: standard deviation between states, with their sampling noise.
  std::vector<float> deviation;
  std::vector<LabelId> hard;  ///< labels whose signals follow, ascending
  std::vector<float> signal;  ///< by state, hard label and transceiver
  std::vector<float> error;   ///< standard errors of `signal`; empty unless the states serve a plan

  bool operator==(const StateTensor&) const = default;
};

/// A share of a simulation that several machines compute: some labels, or all labels in some states.
struct MatrixPart {
  std::uint32_t number = 1, count = 1;  ///< part `number` of `count`, from 1
  std::vector<std::uint32_t> members;   ///< numbers of its labels in the shop, or of its states, ascending
  std::optional<std::uint32_t> hard_labels;  ///< of states: max number of hard labels of all parts together

  bool operator==(const MatrixPart&) const = default;
};

/// The simulated signal matrix M (m labels x n transceivers, row-major) with its labels and transceivers.
struct SignalMatrix {
  std::vector<LabelRow> labels;
  std::vector<TransceiverColumn> transceivers;
  std::vector<std::string> excluded;  ///< ids of candidates that the store excludes: they have no column
  std::vector<float> mean;            ///< m n entries: the signal of label i from transceiver j alone
  std::vector<float> standard_error;  ///< m n entries: of `mean`, from independent batches
  std::vector<float> direct;          ///< m n entries: the part of `mean` without any reflection
  /// m n entries: 1 if the batches are so skewed that `standard_error` is not reliable (PowerSums); empty if
  /// unknown.
  std::vector<std::uint8_t> flags;
  std::vector<SignalLayer> by_bounce;  ///< layer k: k bounces; empty unless requested
  /// Layer k: paths from k to k + 1 times `length_step` long; the last layer also contains all longer paths.
  /// Empty unless requested.
  std::vector<SignalLayer> by_length;
  double length_step = 0;  ///< m
  double wavelength_nm = 940;
  std::string currency;  ///< of the costs of transceivers; empty: not given
  Provenance provenance;

  std::size_t rows() const { return labels.size(); }
  std::size_t columns() const { return transceivers.size(); }
  std::size_t at(std::size_t label, std::size_t transceiver) const { return label * columns() + transceiver; }
  bool is_flagged(std::size_t entry) const { return !flags.empty() && flags[entry] != 0; }
  /// The signal that a label receives from a transceiver. Estimates that are negative because of noise count
  /// as 0 in placements, reports and exported matrices; statistics use `mean`.
  double signal(std::size_t label, std::size_t transceiver) const {
    return std::max(0.0, static_cast<double>(mean[at(label, transceiver)]));
  }
  std::span<const float> mean_row(std::size_t label) const {
    return std::span(mean).subspan(label * columns(), columns());
  }
  bool operator==(const SignalMatrix&) const = default;
};

/// The content of a signal file: the matrix of a shop, or of one that varies, with its states: the mean over
/// these, and the standard error of this mean.
struct StoredSignals : SignalMatrix {
  std::optional<StateTensor> states = {};
  std::optional<MatrixPart> part = {};  ///< the labels are those of the part, or all if it has states

  bool operator==(const StoredSignals&) const = default;
};

}  // namespace shelfbeam
