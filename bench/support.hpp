#pragma once

#include <chrono>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam::bench {

/// The path of a store file, or of a store of examples/ given by its name.
inline std::filesystem::path store_file(const std::string& name) {
  const std::filesystem::path example =
      std::filesystem::path(SHELFBEAM_SOURCE_DIR) / "examples" / name / "store.json";
  return std::filesystem::exists(example) ? example : std::filesystem::path(name);
}

inline Scene open_scene(const std::string& name) {
  return make_scene(read_store(store_file(name)));
}

/// The words of a command line, one after the other.
class Words {
 public:
  Words(int argc, char** argv) : words_(argv + 1, argv + argc) {}

  bool any_left() const { return at_ < words_.size(); }
  const std::string& next() { return words_[at_++]; }
  /// The word after an option. Throws std::invalid_argument if there is none.
  const std::string& value() {
    if (!any_left()) throw std::invalid_argument(words_[at_ - 1] + " needs a value");
    return next();
  }

 private:
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

/// The CPU time of some work, all threads together, in s.
template <class Work>
double cpu_seconds(const Work& work) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

/// The wall time of some work, in s.
template <class Work>
double wall_seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace shelfbeam::bench
