#include "serve/project/archive.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <zip.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

bool is_omitted(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with('.') || name.ends_with(".checkpoint");
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::uint64_t bytes = 0;
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (is_omitted(entry->path())) {
      entry.disable_recursion_pending();
    } else if (entry->symlink_status(error).type() == fs::file_type::regular) {
      files.push_back(entry->path().lexically_relative(folder));
      bytes += entry->file_size(error);
    }
    if (error) break;
  }
  if (error) throw InputError(folder.string(), fmt::format("cannot be read: {}", error.message()));
  std::sort(files.begin(), files.end());
  if (bytes > max_archived_bytes)
    throw InputError(folder.string(),
                     fmt::format("has {:.3g} GB of files, which are too many for an archive",
                                 1e-9 * static_cast<double>(bytes)),
                     "move plans that are not needed elsewhere, or pack the folder with another program");
  return files;
}

// HDF5 files, images and meshes hardly shrink.
bool is_compact(const fs::path& file) {
  constexpr std::string_view names[] = {".h5", ".glb", ".png", ".jpg", ".jpeg", ".gz"};
  return std::find(std::begin(names), std::end(names), file.extension().string()) != std::end(names);
}

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};

}  // namespace

ArchiveSize write_archive(const fs::path& project, const fs::path& zip) {
  if (!fs::is_regular_file(project / "store.json"))
    throw InputError(project.string(), "has no store.json", "name the folder of a project");
  const fs::path top = fs::canonical(project).filename();
  int code = 0;
  std::unique_ptr<zip_t, Discard> opened(zip_open(zip.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (!opened) throw OutputError(zip.string(), "cannot be written");
  ArchiveSize size;
  for (const fs::path& file : files_below(project)) {
    zip_source_t* source = zip_source_file(opened.get(), (project / file).c_str(), 0, -1);
    const zip_int64_t index =
        source == nullptr
            ? -1
            : zip_file_add(opened.get(), (top / file).generic_string().c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      throw InputError((project / file).string(), "cannot be added to the archive");
    }
    if (is_compact(file))
      zip_set_file_compression(opened.get(), static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
    ++size.files;
  }
  // Reads the files, and replaces the archive when all are in it.
  if (zip_close(opened.get()) != 0)
    throw OutputError(zip.string(), std::string("cannot be written: ") + zip_strerror(opened.get()));
  static_cast<void>(opened.release());  // zip_close has freed it
  size.bytes = fs::file_size(zip);
  return size;
}

}  // namespace shelfbeam::serve
