#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/question/partial_question.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "jobs/exit_code.hpp"

namespace shelfbeam::jobs {

/// A question about a table of signals.
struct PlacementQuestion {
  PlacementProblem problem;
  PartialQuestion partial = {};  ///< instead of a selection that reaches all labels
  bool curve = false;            ///< labels that fewer transceivers reach
};

/// The answer to any question.
struct PlacementAnswer {
  Status status = Status::stopped;
  bool has_selection = false;
  Selection selected;
  std::size_t reached = 0;  ///< labels that the selection reaches
  double value = 0;         ///< objective_value, number of units, or reached labels or weight
  double bound = 0;         ///< proven on the value: from below, or for reached labels from above
  std::string json, text;   ///< placement.json, and the same in a few lines
  ExitCode code = done;
  std::vector<SearchStep> steps = {};
  double seconds = 0;
};

/// Throws InputError as `place` and check_question.
PlacementAnswer answer(const SignalTable& table, const PlacementQuestion& question,
                       const PlaceOptions& options, const RunControl& control = {});

/// A selection with which a search begins: with the installed units. `name` is its source in errors. Throws
/// InputError if it does not answer the question.
Selection start_of(Selection selected, const SignalTable& table, const PlacementQuestion& question,
                   const std::string& name);

}  // namespace shelfbeam::jobs
