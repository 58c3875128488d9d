#pragma once

#include <CLI/CLI.hpp>

namespace shelfbeam::app {

/// How sure a certificate must be, and what it may take; `plan` and `verify` take them.
struct CertificateFlags {
  double confidence = 0.99;
  double budget_s = 600;
};

void add_certificate_options(CLI::App& verb, CertificateFlags& flags);

}  // namespace shelfbeam::app
