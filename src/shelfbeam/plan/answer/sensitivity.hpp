#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"

namespace shelfbeam {

struct SensitivityOptions {
  double assumed_error = 0.1;  ///< relative, of reflectances without a given range; 0 to 1
  double confidence = 0.99;    ///< of the verdicts at both ends together
};

/// The smallest margin of a selection, as estimated from samples.
struct MinMargin {
  double ratio =
      std::numeric_limits<double>::infinity();  ///< min_i S_i / (gamma_i tau_i); infinite without labels
  double standard_error = 0;                    ///< of this margin
  LabelId label;                                ///< label with this margin, the first of several
};

/// All reflectances at the same end of their ranges. Verdicts rest on independent samples, with a joint
/// confidence (Sensitivity::confidence); labels in neither list are reached.
struct ReflectanceEnd {
  MinMargin min_margin;
  std::vector<LabelId> missed, undecided;
};

/// One material at one end of its range, all others as given. Estimates at the watched labels, not certified.
struct ReflectanceStep {
  MinMargin min_margin;
  /// Change of that label's margin from the margin as given, with common random numbers.
  double change = 0, change_error = 0;
  double mean_change = 0;        ///< relative change of the labels' signals; labels without signal count 0
  std::size_t labels_short = 0;  ///< labels with an estimate below their requirement
};

struct MaterialSensitivity {
  std::string material;
  double reflectance = 0, lower = 0, upper = 0;
  bool is_assumed = false;  ///< no range given: Sensitivity::assumed_error to both sides
  ReflectanceStep at_lower, at_upper;
};

/// The effect of lower or higher reflectances than in the store file on a placement
/// (docs/methods/certified_plan.md).
struct Sensitivity {
  double confidence = 0.99;    ///< of the verdicts at both ends together
  double assumed_error = 0.1;  ///< relative
  MinMargin as_given;
  ReflectanceEnd low, high;
  std::vector<MaterialSensitivity> materials;  ///< in ascending order of the smallest margin at the lower end
  std::vector<std::string> kept;               ///< materials of the scene without a reflectance parameter
  std::size_t watched =
      0;  ///< labels with the smallest margins at the low end; `as_given` and `materials` refer to these
  std::uint32_t batches = 0;  ///< of each simulation
  double seconds = 0;

  /// Whether all labels are reached anywhere in the ranges. No signal falls where a surface reflects more, so
  /// the low end decides.
  Verdict holds() const {
    if (!low.missed.empty()) return Verdict::missed;
    return low.undecided.empty() ? Verdict::reached : Verdict::undecided;
  }
};

}  // namespace shelfbeam
