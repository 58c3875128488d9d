#include "serve/errands/errand.hpp"

#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::serve {

void Errand::start(const Request& request, std::vector<std::string> words, Json names) {
  if (child_) throw InputError(what_, "is running already", "wait for its end");
  words.insert(words.begin(), program_);
  words.emplace_back("--json");
  child_.emplace(std::move(words), memory_limit());
  tab_ = request.tab;
  id_ = request.json.value("id", Json());
  names_ = std::move(names);
}

std::optional<LateReply> Errand::poll() {
  jobs::ChildEnd end;
  if (!child_ || !child_->has_ended(end)) return {};
  child_.reset();
  Json answer = Json::parse(end.out, nullptr, false);
  if (end.exit_code == 0 && answer.is_object()) {
    answer.update(names_);
    return LateReply{tab_, {{"id", id_}, {key_, std::move(answer)}}};
  }
  std::string message = end.err.substr(0, end.err.find('\n'));
  if (constexpr std::string_view mark = "error: "; message.starts_with(mark)) message.erase(0, mark.size());
  if (message.empty()) message = fmt::format("{} has failed", what_);
  return LateReply{tab_, {{"id", id_}, {"error", {{"message", message}}}}};
}

}  // namespace shelfbeam::serve
