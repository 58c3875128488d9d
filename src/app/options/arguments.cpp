#include "app/options/arguments.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "app/verbs.hpp"

namespace shelfbeam::app {

CLI::Validator positive_number() {
  const auto check = [](const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool fits = !text.empty() && *end == '\0' && std::isfinite(value) && value > 0;
    return fits ? std::string() : fmt::format("'{}' is no finite number above 0", text);
  };
  return {check, "POSITIVE"};
}

// CLI11 reads what does not fit as the largest number that does.
CLI::Validator positive_count() {
  const auto check = [](const std::string& text) {
    std::size_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool fits = error == std::errc() && stop == end && value > 0;
    return fits ? std::string() : fmt::format("'{}' is no whole number above 0, or too large a one", text);
  };
  return {check, "POSITIVE"};
}

CLI::Validator a_path() {
  return {[](const std::string& text) { return std::string(text.empty() ? "the name is empty" : ""); }, ""};
}

CLI::Option* add_path(CLI::App& verb, const std::string& name, std::filesystem::path& path,
                      const std::string& help) {
  return verb.add_option(name, path, help)->check(a_path());
}

void add_common_options(CLI::App& verb, CommonOptions& options) {
  verb.add_option("--seed", options.seed, "Seed of the random numbers")->capture_default_str();
  verb.add_option("--threads", options.threads, "Threads to use; 0 is one a core")
      ->check(CLI::Range(0U, 256U))
      ->capture_default_str();
  verb.add_flag("--quiet", options.quiet, "Print nothing but errors");
  verb.add_flag("--json", options.json, "Print the summary as JSON");
}

void keep_input(const std::filesystem::path& output, const std::filesystem::path& input) {
  std::error_code missing;
  if (std::filesystem::equivalent(output, input, missing))
    throw InputError(output.string(), "is the input, which would be lost",
                     "choose another name for the output");
}

void expect_writable(const std::filesystem::path& output) {
  const AtomicFile probe(output);
}

}  // namespace shelfbeam::app
