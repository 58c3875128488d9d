#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"

#include "reader.hpp"
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

// Records follow the first line: length, hash of the content, hash of both and the position, content.
void repair_checkpoint(std::string& bytes) {
  std::size_t at = bytes.find('\n');
  if (at == std::string::npos) return;
  for (++at; bytes.size() - at >= 24;) {
    std::array<std::uint64_t, 3> head{};
    std::memcpy(head.data(), bytes.data() + at, sizeof head);
    const std::size_t left = bytes.size() - at - sizeof head;
    const std::uint64_t length = std::min<std::uint64_t>(head[0], left);
    head[1] = hash64(std::string_view(bytes).substr(at + sizeof head, length));
    // A length beyond the end stays, because a truncated record at the end has one.
    const std::array<std::uint64_t, 3> hashed{head[0], head[1], at};
    head[2] = hash64({reinterpret_cast<const char*>(hashed.data()), sizeof hashed});
    std::memcpy(bytes.data() + at, head.data(), sizeof head);
    at += sizeof head + length;
  }
}

}  // namespace

extern const Reader checkpoint;
const Reader checkpoint{"checkpoint", fuzz_checkpoint, checkpoint_seeds, repair_checkpoint};

}  // namespace shelfbeam::fuzz
