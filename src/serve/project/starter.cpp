#include "serve/project/starter.hpp"

#include <algorithm>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/scene/build/decisive_values.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

void start_project(const fs::path& folder) {
  constexpr const char* catalogue = "catalogue.json";
  make_output_folder(folder);
  // A run that was killed here may have left the catalogue alone.
  const auto is_own = [&](const fs::directory_entry& entry) {
    return entry.path().filename() == ".shelfbeam" ||
           (entry.path().filename() == catalogue && fs::is_regular_file(entry.symlink_status()) &&
            entry.file_size() == starter_catalogue().size() &&
            read_file(entry.path()) == starter_catalogue());
  };
  if (!std::all_of(fs::directory_iterator(folder), fs::directory_iterator(), is_own) ||
      fs::exists(folder / ".shelfbeam" / "history.jsonl"))
    return;
  AtomicFolder files(folder);
  files.add(catalogue).write(starter_catalogue());
  files.add("store.json").write(starter_store());
  files.commit({});
}

}  // namespace shelfbeam::serve
