#include "app/verbs.hpp"

namespace shelfbeam::app {

void add_common_options(CLI::App& verb, CommonOptions& options) {
  verb.add_option("--seed", options.seed, "Seed of the random numbers")->capture_default_str();
  verb.add_option("--threads", options.threads, "Threads to use; 0 is one a core")
      ->check(CLI::Range(0U, 256U))
      ->capture_default_str();
  verb.add_flag("--quiet", options.quiet, "Print nothing but errors");
  verb.add_flag("--json", options.json, "Print the summary as JSON");
}

}  // namespace shelfbeam::app
