#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Verdicts on labels, made in rounds of more and more batches.
class LabelRounds {
 public:
  LabelRounds(const Scene& scene, std::vector<LabelVerdict>& labels) : scene_(scene), labels_(labels) {}

  /// Verifies some labels at the units that are selected (verification.hpp). `planned`: their signals on the
  /// matrix, row by row.
  void verify(const std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& selected,
              const Question& question, std::span<const float> planned, Rounds& rounds, double level,
              const RunControl& control);

  /// Takes more batches from now on.
  void grow() { batches_ = Rounds::more(batches_); }

  std::uint32_t batches() const { return batches_; }
  /// Of the budget, as all that follows.
  double cost_of_next() const { return Rounds::growth * took_; }
  /// Until all is decided, if the means are where the truth is; endless where one is its requirement.
  double cost_to_decide() const;

 private:
  const Scene& scene_;
  std::vector<LabelVerdict>& labels_;
  std::uint32_t batches_ = least_verifying_batches;
  double took_ = 0;
};

/// "the next round would have taken about 40 s, and 12 s were left", or the like: why another round of a
/// certificate is not worth its time; empty where it is. `cost_of_next` is that of the whole round.
std::string why_no_more(const Rounds& rounds, const LabelRounds& labels, double cost_of_next);

}  // namespace shelfbeam
