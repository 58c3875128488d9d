#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint_identity.hpp"
#include "shelfbeam/transport/operator/label_hits.hpp"
#include "shelfbeam/transport/operator/preview.hpp"
#include "shelfbeam/transport/operator/surface_field.hpp"
#include "shelfbeam/transport/operator/unit_survey.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Numbers of rays, and a distance. The default previews signals within some percent of the requirement.
struct OperatorEffort {
  std::uint32_t label_rays = 256;  ///< first rays per label
  std::uint32_t gather_rays = 12;  ///< two times as many per quadrant of a cell
  double reach = 30;               ///< m; light of a unit on surfaces farther away is omitted

  /// About the memory that is needed to make the operator of a scene, mostly for first hits and for cells.
  double bytes(const Scene& scene) const {
    constexpr double per_ray = 200, per_area = 30e3, while_making = 1.5;
    const Vec3 size = scene.upper - scene.lower;
    return while_making *
           (per_ray * label_rays * static_cast<double>(scene.labels.size()) + per_area * size.x * size.y);
  }
};

/// The signals of all labels from a unit without any reflection, of one of the scene's types: exact between
/// points, sampled for discs and labels with an area. They are those of Preview::direct.
std::vector<float> direct_column(const World& world, const Transceiver& unit, std::uint64_t seed);

/// The usual effort: the default with up to 10,000 labels; then fewer rays per label and a shorter reach, so
/// that memory and time grow little.
inline OperatorEffort usual_effort(std::size_t labels) {
  constexpr std::size_t many = 10000;
  constexpr std::uint32_t least = 64;
  OperatorEffort effort;
  if (labels > many) {
    effort.label_rays = std::max(least, static_cast<std::uint32_t>(effort.label_rays * many / labels));
    effort.reach = 23;
  }
  return effort;
}

/// The effort that takes a sixth of the time, with errors three to four times as large.
inline constexpr OperatorEffort coarse_operator{.label_rays = 20, .gather_rays = 2};

/// The light between the surfaces and labels of a shop, computed once for all units: the signals of any unit
/// are then a matter of milliseconds (docs/methods/light_operator.md). It does not depend on the units of the
/// scene.
class LightOperator {
 public:
  /// Works on the threads of the current arena. `world` must outlive the operator. Throws Interrupted when
  /// cancelled.
  LightOperator(const World& world, std::uint64_t seed, const OperatorEffort& effort = {},
                const RunControl& control = {});

  /// The signals of all labels from a unit anywhere in the shop, of one of the scene's types. The direct part
  /// is exact between points (sampled for discs and labels with an area); the rest is approximate. The result
  /// is the same for any number of threads.
  Preview column(const Transceiver& unit) const;

  /// Writes a file that `load` reads. Throws OutputError; an older file then stays unchanged.
  void save(const std::filesystem::path& path) const;
  /// The operator that a constructor with the same arguments would make, from a file. No value if there is no
  /// such file, or one of another scene, seed, effort or program version. Throws InputError for a damaged
  /// file.
  static std::optional<LightOperator> load(const std::filesystem::path& path, const World& world,
                                           std::uint64_t seed, const OperatorEffort& effort = {});

  const World& world() const { return world_; }
  const SurfaceNodes& nodes() const { return nodes_; }
  /// Where the light of the only unit of `probe` goes first.
  UnitSurvey survey(const World& probe) const;
  std::size_t bytes() const;

 private:
  LightOperator(const World& world, std::uint64_t seed, const OperatorEffort& effort, SurfaceNodes nodes);
  static CheckpointIdentity identity(const World& world, std::uint64_t seed, const OperatorEffort& effort);
  void finish();

  const World& world_;
  std::uint64_t seed_, stream_;
  OperatorEffort effort_;
  float requirement_;
  SurfaceNodes nodes_;
  std::vector<LabelHits> clusters_;
  std::vector<float> common_errors_;  // by cluster
  std::vector<std::uint8_t> seen_;    // by cell: whether rays from labels meet it
};

}  // namespace shelfbeam
