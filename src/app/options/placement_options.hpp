#pragma once

#include <CLI/CLI.hpp>

#include "shelfbeam/placement/answer/placement.hpp"

#include "app/text/placement_text.hpp"

namespace shelfbeam::app {

/// The options that choose the placement question; `place`, `plan` and `export` take them.
void add_question_options(CLI::App& verb, Question& question);

/// How the question is answered; `place` and `plan` take them.
void add_solver_options(CLI::App& verb, PlaceOptions& options);

/// How sure a certificate must be, and what it may take; `plan` and `verify` take them.
struct CertificateFlags {
  double confidence = 0.99;
  double budget_s = 600;
};

void add_certificate_options(CLI::App& verb, CertificateFlags& flags);

/// done, answer_is_no or stopped_early.
int exit_code(Status status);

}  // namespace shelfbeam::app
