#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "shelfbeam/placement/answer/placement.hpp"

#include "app/text/placement_text.hpp"

namespace shelfbeam::app {

/// The options that choose the placement question; `place`, `plan` and `export` take them.
struct QuestionFlags {
  std::string model = "cooperative";
  std::string objective = "count";
  bool weighted = false;
  bool lexicographic = false;  ///< the default, for those who want to say it
  double share = 1;
  bool survive_failure = false;

  Question question() const;
};

/// How the question is answered; `place` and `plan` take them.
struct SolverFlags {
  std::string solver = "auto";
  std::string backend;
  double time_limit_s = 60;

  PlaceOptions options(std::uint64_t seed = 1) const;
};

void add_question_options(CLI::App& verb, QuestionFlags& flags);
void add_solver_options(CLI::App& verb, SolverFlags& flags, double default_time_limit_s);

/// done, answer_is_no or stopped_early.
int exit_code(Status status);

}  // namespace shelfbeam::app
