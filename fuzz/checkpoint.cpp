#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

#include <array>
#include <cstdint>
#include <numeric>

#include "shelfbeam/base/file.hpp"

#include "reader.hpp"
#include "records.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

constexpr std::uint32_t items = 3;

CheckpointFile file_at(const std::filesystem::path& path) {
  return {path, {{"store hash", "abc"}, {"seed", "1"}}, items};
}

void fuzz_checkpoint(std::string_view bytes) {
  CheckpointFile file = file_at(scratch().write("signal.h5.checkpoint", bytes));
  double sum = 0;
  file.load([&](std::uint32_t item, const CheckpointState& state) {
    sum += item + std::accumulate(state.values.begin(), state.values.end(), 0.0);
  });
}

std::vector<std::string> checkpoint_seeds() {
  std::vector<std::string> files;
  const std::filesystem::path path = scratch().path() / "seed.checkpoint";
  remove_checkpoint(path);
  CheckpointFile file = file_at(path);
  const std::array<double, 3> values{0.5, 1.5, 2.5};
  for (std::uint32_t batches = 1; batches <= 2; ++batches) {
    file.save(
        [&](std::uint32_t item) { return CheckpointState{batches, std::span(values).first(item + 1)}; });
    files.push_back(read_file(path));
  }
  return files;
}

}  // namespace

extern const Reader checkpoint;
const Reader checkpoint{"checkpoint", fuzz_checkpoint, checkpoint_seeds, repair_records};

}  // namespace shelfbeam::fuzz
