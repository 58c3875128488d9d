#include "app/options/certificate_options.hpp"

#include "app/options/arguments.hpp"

namespace shelfbeam::app {

void add_certificate_options(CLI::App& verb, CertificateFlags& flags) {
  verb.add_option("--confidence", flags.confidence, "Joint confidence of all that is certified")
      ->check(CLI::Range(0.5, 0.999999))
      ->capture_default_str();
  verb.add_option("--budget", flags.budget_s, "Seconds for verification and refinement")
      ->check(positive_number())
      ->capture_default_str();
}

}  // namespace shelfbeam::app
