#include "serve/live/warning_finder.hpp"

#include <utility>

#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::serve {

WarningFinder::WarningFinder(std::filesystem::path file, std::string program)
    : file_(std::move(file)), program_(std::move(program)) {}

void WarningFinder::restart(Clock::time_point now) {
  child_.reset();
  begin_ = now + quiet;
}

std::optional<nlohmann::ordered_json> WarningFinder::poll(Clock::time_point now) {
  if (begin_ && now >= *begin_) {
    begin_.reset();
    child_.emplace(std::vector<std::string>{program_, "inspect", file_.string(), "--json", "--no-links"},
                   memory_limit());
  }
  jobs::ChildEnd end;
  if (!child_ || !child_->has_ended(end)) return {};
  child_.reset();
  const auto found = nlohmann::ordered_json::parse(end.out, nullptr, false);
  if (!found.is_object())
    return nlohmann::ordered_json{
        {{"code", "not_checked"},
         {"path", ""},
         {"sentence",
          file_.string() + ": the search for warnings has failed; 'shelfbeam inspect' prints the reason"}}};
  return found.contains("findings") ? found["findings"] : nlohmann::ordered_json::array();
}

}  // namespace shelfbeam::serve
