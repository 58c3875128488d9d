// Prints the size of the embedded script of the 3-D view in bytes.

#include <iostream>
#include <string_view>

namespace shelfbeam::embedded {
extern const std::string_view viewer_script;
}

int main() {
  std::cout << shelfbeam::embedded::viewer_script.size() << '\n';
}
