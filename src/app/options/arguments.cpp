#include "app/options/arguments.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "app/verbs.hpp"

namespace shelfbeam::app {

CLI::Validator positive_number() {
  const auto check = [](const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool fits = !text.empty() && *end == '\0' && std::isfinite(value) && value > 0;
    return fits ? std::string() : fmt::format("'{}' is not a finite number above 0", text);
  };
  return {check, "POSITIVE"};
}

// CLI11 clamps numbers that are too large to the largest number of the type.
CLI::Validator positive_count() {
  const auto check = [](const std::string& text) {
    std::size_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool fits = error == std::errc() && stop == end && value > 0;
    return fits ? std::string() : fmt::format("'{}' is not a whole number above 0, or is too large", text);
  };
  return {check, "POSITIVE"};
}

CLI::Validator a_path() {
  return {[](const std::string& text) { return std::string(text.empty() ? "the name is empty" : ""); }, ""};
}

std::string HelpFormatter::make_group(std::string name, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  const std::string text = CLI::Formatter::make_group(name, is_positional, std::move(options));
  return is_positional || name == "Options" ? text : text.substr(1);  // CLI11 adds a second blank line
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  return option->get_option_text().empty() ? std::string() : " " + option->get_option_text();
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  constexpr std::size_t width = 84;
  const std::string description = option->get_description();
  if (description.find('\n') != std::string::npos) return description;
  std::istringstream words(description);
  std::string text, word;
  for (std::size_t length = 0; words >> word; length += word.size() + 1) {
    if (length + word.size() > width) {
      text += '\n';
      length = 0;
    } else if (length > 0) {
      text += ' ';
    }
    text += word;
  }
  return text;
}

std::string choices(const std::vector<std::string>& names) {
  return fmt::format("{{{}}}", fmt::join(names, ","));
}

CLI::Option* add_path(CLI::App& verb, const std::string& name, std::filesystem::path& path,
                      const std::string& help) {
  return verb.add_option(name, path, help)->check(a_path())->option_text("PATH");
}

void add_common_options(CLI::App& verb, CommonOptions& options) {
  verb.add_option("--seed", options.seed, fmt::format("Seed of the random numbers; default {}", options.seed))
      ->option_text("N")
      ->group(group::runs);
  verb.add_option("--threads", options.threads, "Number of threads; default: one per core")
      ->check(CLI::Range(0U, 256U))
      ->option_text("N")
      ->group(group::runs);
  verb.add_flag("--quiet", options.quiet, "Print errors only")->group(group::runs);
  verb.add_flag("--json", options.json, "Print the summary as JSON")->group(group::runs);
}

void protect_input(const std::filesystem::path& output, const std::filesystem::path& input) {
  std::error_code missing;
  if (std::filesystem::equivalent(output, input, missing))
    throw InputError(output.string(), "is also the input and would be overwritten",
                     "choose another name for the output");
}

void expect_writable(const std::filesystem::path& output) {
  const AtomicFile probe(output);
}

}  // namespace shelfbeam::app
