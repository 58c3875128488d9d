#include "serve/live/named_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

// Not each of many thousand names.
bool may_be_file(const std::string& text) {
  constexpr std::size_t longest_path = 400, longest_ending = 9;
  const std::size_t dot = text.rfind('.');
  return dot != std::string::npos && dot > 0 && text.size() - dot <= longest_ending &&
         text.size() <= longest_path;
}

void add(const Json& value, const std::filesystem::path& folder, std::string& state) {
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (!may_be_file(text)) return;
    struct stat found{};
    const std::filesystem::path path = folder / text;
    if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return;
    state += fmt::format("{} {} {} {}.{}\n", text, found.st_ino, found.st_size, found.st_mtim.tv_sec,
                         found.st_mtim.tv_nsec);
  } else if (value.is_structured()) {
    for (const auto& [key, part] : value.items())
      if (key != "id" && key != "drawing") add(part, folder, state);
  }
}

}  // namespace

std::string state_of_named_files(const Json& store, const std::filesystem::path& folder) {
  std::string state;
  add(store, folder, state);
  return state;
}

}  // namespace shelfbeam::serve
