#pragma once

#include <filesystem>
#include <string>

namespace shelfbeam::app {

/// Opens the browser of the desktop, if there is one, on a page of this computer. The address goes through a
/// file in `folder` that only this user can read, because other users see the arguments of programs. Throws
/// OutputError if the file cannot be written.
void open_browser(const std::string& address, const std::filesystem::path& folder);

}  // namespace shelfbeam::app
