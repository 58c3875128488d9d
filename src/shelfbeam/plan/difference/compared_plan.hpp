#pragma once

#include <string>
#include <vector>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// A plan, or a preview of one, as input of a comparison; small compared with its signal matrix.
struct ComparedPlan {
  std::vector<LabelRow> labels;
  std::vector<TransceiverColumn> transceivers;
  std::vector<double> signals;  ///< received_signal of each label
  CertifiedPlan plan;
  std::string store;                          ///< resolved_store_json of this version of the program
  std::vector<std::string> label_names = {};  ///< for readers, by row; empty: their ids
};

ComparedPlan compared_plan(const SignalMatrix& matrix, CertifiedPlan plan, std::string store);

}  // namespace shelfbeam
