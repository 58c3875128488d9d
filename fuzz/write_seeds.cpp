#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "shelfbeam/base/file.hpp"

#include "reader.hpp"

// Usage: write_seeds FOLDER READER
// Creates FOLDER and writes the reader's seeds to it.

int main(int count, char** arguments) {
  try {
    const auto* reader = count == 3 ? shelfbeam::fuzz::find_reader(arguments[2]) : nullptr;
    if (reader == nullptr) {
      std::fputs("usage: write_seeds FOLDER READER; the readers are:\n", stderr);
      for (const auto& known : shelfbeam::fuzz::readers())
        std::fprintf(stderr, "%s\n", std::string(known.name).c_str());
      return 2;
    }
    std::filesystem::create_directories(arguments[1]);
    std::size_t number = 0;
    auto seeds = reader->seeds();
    const auto foreign = shelfbeam::fuzz::foreign_texts(seeds.front());
    seeds.insert(seeds.end(), foreign.begin(), foreign.end());
    for (const std::string& seed : seeds)
      shelfbeam::write_file(std::filesystem::path(arguments[1]) / ("seed" + std::to_string(number++)), seed);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
