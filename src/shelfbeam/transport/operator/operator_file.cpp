// The file of a light operator: docs/formats/preview.md.

#include <cstring>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint_records.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"

namespace shelfbeam {

namespace {

using detail::RecordReader;
using detail::RecordWriter;
using detail::SurfaceCells;

constexpr std::string_view operator_line = "shelfbeam light operator 3\n";

// Writes a record for each vector.
struct WriteVector {
  RecordWriter& file;

  template <class T>
  void operator()(const std::vector<T>& values) const {
    static_assert(std::is_trivially_copyable_v<T>);
    file.record({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }
};

struct ReadVector {
  RecordReader& file;

  template <class T>
  void operator()(std::vector<T>& values) const {
    const auto record = file.next();
    if (!record || record->size() % sizeof(T) != 0) file.fail();
    values.resize(record->size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), record->data(), record->size());
  }
};

template <class Parts, class Use>
void each_part(Parts& cells, const Use& use) {
  use(cells.keys);
  use(cells.first);
  use(cells.coordinates);
  use(cells.triangles);
  use(cells.divisions);
  use(cells.planes);
}

}  // namespace

CheckpointIdentity LightOperator::identity(const World& world, std::uint64_t seed,
                                           const OperatorEffort& effort) {
  const LightKeys keys = light_keys(world.scene);
  const std::string_view labels(reinterpret_cast<const char*>(keys.labels.data()),
                                keys.labels.size() * sizeof(keys.labels[0]));
  // The file has numbers of materials, and its random numbers depend on the ids of labels.
  std::string materials, ids;
  for (const MaterialId material : world.scene.mesh.materials)
    for (std::uint32_t rest = material.value, k = 0; k < 4; ++k, rest >>= 8)
      materials += static_cast<char>(rest & 0xFF);
  for (const Label& label : world.scene.labels) ids += label.id + '\n';
  return {{"program version", std::string(program_version())},
          {"light hash", keys.light_hash},
          {"materials", content_hash(materials)},
          {"ids of labels", content_hash(ids)},
          {"labels", content_hash(labels)},
          {"seed", fmt::format("{}", seed)},
          {"rays", fmt::format("{} per label, 2 x {} per quadrant", effort.label_rays, effort.gather_rays)}};
}

void LightOperator::save(const std::filesystem::path& path) const {
  AtomicFile target(path);
  RecordWriter file(target.temporary(), path.string());
  file.line(operator_line);
  file.record(detail::to_text(identity(world_, seed_, effort_)));
  const WriteVector write{file};
  const SurfaceCells::Parts cells = nodes_.cells().parts();
  each_part(cells, write);
  for (const SurfaceLinks& links : nodes_.halves()) SurfaceLinks::each_part(links, write);
  const std::vector<std::uint64_t> count{clusters_.size()};
  write(count);
  for (const LabelHits& hits : clusters_) LabelHits::each_part(hits, write);
  write(common_errors_);
  file.flush();
  target.commit();
}

std::optional<LightOperator> LightOperator::load(const std::filesystem::path& path, const World& world,
                                                 std::uint64_t seed, const OperatorEffort& effort) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  RecordReader file(path, {"delete it; it will be computed again", Setting::none});
  if (!file.line(operator_line)) return std::nullopt;
  const auto head = file.next();
  if (!head) file.fail();
  if (*head != detail::to_text(identity(world, seed, effort))) return std::nullopt;
  const ReadVector read{file};
  SurfaceCells::Parts parts;
  each_part(parts, read);
  if (!parts.fit()) file.fail();
  const auto cells = std::make_shared<const SurfaceCells>(std::move(parts));
  std::array<SurfaceLinks, 2> halves{SurfaceLinks(world, cells), SurfaceLinks(world, cells)};
  for (SurfaceLinks& links : halves) {
    SurfaceLinks::each_part(links, read);
    if (!links.fit(cells->size() * SurfaceCells::quadrants)) file.fail();
  }
  LightOperator result(world, seed, effort, SurfaceNodes(cells, std::move(halves)));
  std::vector<std::uint64_t> count;
  read(count);
  if (count.size() != 1) file.fail();
  std::vector<std::uint32_t> times(world.scene.labels.size());  // of each label in the clusters
  for (std::uint64_t k = 0; k < count[0]; ++k) {
    LabelHits& hits = result.clusters_.emplace_back();
    LabelHits::each_part(hits, read);
    if (!hits.fit(world.scene, cells->size())) file.fail();
    hits.enclose(world);
    for (const LabelId i : hits.labels) times[i] += 1;
  }
  read(result.common_errors_);
  if (result.common_errors_.size() != result.clusters_.size()) file.fail();
  if (std::any_of(times.begin(), times.end(), [](std::uint32_t k) { return k != 1; })) file.fail();
  result.finish();
  return result;
}

}  // namespace shelfbeam
