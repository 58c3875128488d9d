#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::detail {

class MatrixReader;

/// A file with a part of a simulation (docs/formats/signal.md, "Parts").
class SignalPart {
 public:
  /// Throws InputError as `read_signal_file`, and if the file contains a whole matrix.
  explicit SignalPart(const std::filesystem::path& path);
  ~SignalPart();
  SignalPart(SignalPart&&) noexcept;
  SignalPart& operator=(SignalPart&&) noexcept;

  const std::filesystem::path& path() const { return path_; }
  const MatrixPart& share() const { return share_; }
  /// The part without the signals of its states. Throws as `read_signal_file`.
  StoredSignals matrix() const;
  /// Whether it has standard errors of states, for a plan.
  bool serves_plan() const;
  /// The signals of all labels in the part's state `k`, from 0, with their errors if it serves a plan. Throws
  /// the same.
  SignalLayer state(std::uint32_t k, std::size_t labels, std::size_t units) const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<MatrixReader> reader_;
  MatrixPart share_;
};

}  // namespace shelfbeam::detail
