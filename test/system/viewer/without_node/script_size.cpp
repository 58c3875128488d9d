// Prints the size of the embedded script of the 3-D view in bytes, and the number of embedded files of the
// planner.

#include <array>
#include <iostream>
#include <span>
#include <string_view>

namespace shelfbeam::embedded {
extern const std::string_view viewer_script;
extern const std::span<const std::array<std::string_view, 4>> planner_files;
}  // namespace shelfbeam::embedded

int main() {
  std::cout << shelfbeam::embedded::viewer_script.size() << ' ' << shelfbeam::embedded::planner_files.size()
            << '\n';
}
