#include "shelfbeam/signal/checkpoint/checkpoint_identity.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam::detail {

namespace fs = std::filesystem;

namespace {

// The value of a name in a text from `to_text`.
std::string value_of(std::string_view text, const std::string& name) {
  const std::string begin = name + ": ";
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with(begin)) return std::string(line.substr(begin.size()));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return "unknown";
}

}  // namespace

std::string to_text(const CheckpointIdentity& identity) {
  std::string text;
  for (const auto& [name, value] : identity) text += fmt::format("{}: {}\n", name, value);
  return text;
}

void expect_identity(const CheckpointIdentity& identity, std::string_view found, const fs::path& path) {
  for (const auto& [name, value] : identity)
    if (const std::string theirs = value_of(found, name); theirs != value)
      throw InputError(path.string(),
                       fmt::format("belongs to another simulation: its {} is {} instead of {}", name,
                                   in_quotes(theirs), in_quotes(value)),
                       "resume with the same store and options, or start again without resuming",
                       Setting::resumption);
}

void expect_checkpoint(const fs::path& path, std::string_view line) {
  std::error_code unknown;
  const fs::file_status found = fs::symlink_status(path, unknown);
  if (!fs::exists(found)) return;
  if (!fs::is_regular_file(found) || !read_first_bytes(path, line.size()).starts_with(line))
    throw InputError(path.string(), "is not a checkpoint, although it has the name of one",
                     "move it elsewhere, or choose another output");
}

}  // namespace shelfbeam::detail
