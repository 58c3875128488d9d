#include "app/text/simulation_text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam::app {

namespace {

// The minimum number of batches exceeds the requested samples by more than one batch.
bool exceeds_requested_samples(const SimulationSummary& summary) {
  return summary.requested_samples && summary.max_batches == min_batches &&
         summary.max_samples >= *summary.requested_samples + summary.max_samples / summary.max_batches;
}

}  // namespace

std::string describe(const SimulationSummary& summary, bool follows_decision) {
  const std::string samples = summary.min_samples == summary.max_samples
                                  ? fmt::format("{}", summary.min_samples)
                                  : fmt::format("{} to {}", summary.min_samples, summary.max_samples);
  std::string text = fmt::format(
      "{} labels x {} candidates, {} samples per label in {:.1f} s ({:.2f} million rays per "
      "second)",
      summary.labels, summary.candidates, samples, summary.seconds,
      static_cast<double>(summary.rays) / summary.seconds / 1e6);
  if (exceeds_requested_samples(summary))
    text +=
        fmt::format("\n{} samples per label instead of {}: at least {} batches are needed to estimate errors",
                    samples, *summary.requested_samples, min_batches);
  if (summary.resumed_batches > 0)
    text += fmt::format("\ncontinued from the checkpoint, which contained {} of the {} batches",
                        summary.resumed_batches, summary.batches);
  for (const ErrorQuantiles& errors : summary.errors) {
    if (errors.entries == 0)
      text += fmt::format("\nno entry exceeds {} of the requirement", errors.above);
    else
      text += fmt::format(
          "\nrelative standard error of the {} entries above {} of the requirement: median {:.1f} %, "
          "90 % below {:.1f} %, 99 % below {:.1f} %",
          errors.entries, errors.above, 100 * errors.median, 100 * errors.p90, 100 * errors.p99);
    if (errors.flagged > 0) text += fmt::format("; {} of them flagged", errors.flagged);
  }
  if (std::any_of(summary.errors.begin(), summary.errors.end(),
                  [](const ErrorQuantiles& errors) { return errors.flagged > 0; }))
    text += fmt::format(
        "\nflagged: few batches found most of the light, so the error is not reliable{}. '/flags' in "
        "the signal file marks these entries",
        follows_decision ? "" : "; use more samples");
  if (summary.unmet_error) {
    text += fmt::format(
        "\n{2} entries have not reached a relative error of {0:g} %, and {1} of these require more than "
        "--max-samples; the largest errors:",
        100 * *summary.unmet_error, summary.out_of_reach, summary.unmet);
    for (const UnmetEntry& entry : summary.worst_unmet)
      text += fmt::format("\n  label '{}' from '{}': {:.1f} %{}{}", entry.label, entry.source,
                          100 * entry.relative_error, entry.is_flagged ? ", flagged" : "",
                          entry.is_out_of_reach ? ", requires more than --max-samples" : "");
  }
  return text + (follows_decision ? "\nthe certificate takes more samples only where they decide; all other "
                                    "entries keep these errors"
                                  : fmt::format("\nhalving these errors would take another {:.0f} s",
                                                summary.seconds_to_halve));
}

}  // namespace shelfbeam::app
