#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <string_view>

#include <unistd.h>

#include "shelfbeam/base/error.hpp"

#include "app/text/pipe.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/preview/light_job.hpp"

namespace shelfbeam::app {

namespace {

constexpr std::size_t max_job = std::size_t{1} << 32;

// Each message with its length before it.
void print_frame(std::string_view frame) {
  std::string bytes;
  for (unsigned k = 0; k < 4; ++k)
    bytes += static_cast<char>(static_cast<std::uint32_t>(frame.size()) >> (8U * k) & 255U);
  bytes += frame;
  if (!write_at_once(bytes)) throw OutputError("standard output", "cannot be written");
}

}  // namespace

void add_light(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("light", "Compute the light of a shop for the planner");
  verb->callback([&chosen] {
    chosen = [] {
      // The planner answers first.
      [[maybe_unused]] const int priority = ::nice(10);
      jobs::LightJob job;
      try {
        job = jobs::light_job_of(standard_input(max_job, "pass the job of a planner"));
      } catch (const InputError&) {
        throw;
      } catch (const std::exception&) {
        throw InputError("standard input", "is no job of a planner", "open the shop with 'shelfbeam serve'");
      }
      jobs::run_light(job, print_frame, {0, &cancel_on_signal(), nullptr});
      return static_cast<int>(done);
    };
  });
}

}  // namespace shelfbeam::app
