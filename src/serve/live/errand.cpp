#include "serve/live/errand.hpp"

#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::serve {

using Json = nlohmann::ordered_json;

void Errand::start(std::vector<std::string> words) {
  if (child_) throw InputError(what_, "is running already", "wait for its end");
  words.insert(words.begin(), program_);
  words.emplace_back("--json");
  child_.emplace(std::move(words), memory_limit());
}

std::optional<Json> Errand::poll() {
  jobs::ChildEnd end;
  if (!child_ || !child_->has_ended(end)) return {};
  child_.reset();
  Json summary = Json::parse(end.out, nullptr, false);
  if (end.exit_code == 0 && summary.is_object()) return summary;
  std::string message = end.err.substr(0, end.err.find('\n'));
  if (constexpr std::string_view mark = "error: "; message.starts_with(mark)) message.erase(0, mark.size());
  return Json{{"message", message.empty() ? fmt::format("{} has failed", what_) : message}};
}

}  // namespace shelfbeam::serve
