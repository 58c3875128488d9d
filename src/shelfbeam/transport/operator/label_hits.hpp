#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/transport/cells/ray_targets.hpp"
#include "shelfbeam/transport/operator/label_rows.hpp"
#include "shelfbeam/transport/operator/surface_field.hpp"
#include "shelfbeam/transport/operator/unit_beam.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// The first hits of rays from a cluster of labels, kept as quadrature points for the radiance that arrives
/// at these labels. All labels that see a point share it (share_point). Weights are of the irradiance of
/// points, and include the albedo of the base (SurfaceGuide) over pi.
struct LabelHits {
  /// The points in one cell.
  struct Block {
    std::uint32_t cell;
    std::uint32_t first_point;
    std::array<float, 4> mix;  ///< shares of the quadrants in the weights
  };
  /// Light besides the base, which belongs to the label whose ray met the point.
  struct Lobe {
    std::array<float, 3> position, normal, outside, outgoing;  ///< as in ChainEnd
    std::uint32_t triangle, node;
    std::uint16_t material, label;  ///< the label in the cluster
    float weight;                   ///< of the radiance from there
    float own_albedo;               ///< for indirect irradiance
  };

  std::vector<LabelId> labels;          ///< neighbours one after the other
  Bounds box;                           ///< around the labels
  std::vector<Block> blocks;            ///< and one more at the end
  LabelRows sums;                       ///< by block: the sums over its points
  BeamPoints points;                    ///< by block
  LabelRows weights;                    ///< by point
  std::vector<std::uint16_t> material;  ///< of the points
  std::vector<Lobe> lobes;
  std::vector<float> unknown;  ///< by label: the share of its rays that meet surfaces without a cell
  std::vector<float> bent;     ///< by label: the share that meet mirrors, glass or metal
  std::vector<float> narrow;   ///< by label: the share that meet cells wider than the way before them

  std::size_t bytes() const;
  /// Calls use(vector) for everything that a file needs.
  template <class Hits, class Use>
  static void each_part(Hits& hits, const Use& use) {
    use(hits.labels);
    use(hits.blocks);
    LabelRows::each_part(hits.sums, use);
    BeamPoints::each_part(hits.points, use);
    LabelRows::each_part(hits.weights, use);
    use(hits.material);
    use(hits.lobes);
    use(hits.unknown);
    use(hits.bent);
    use(hits.narrow);
  }
  /// Whether the parts are those of labels of a scene, and refer to this number of cells.
  bool fit(const Scene& scene, std::size_t cells) const;
  /// Sets the box around the labels.
  void enclose(const World& world);
};

/// Traces `rays` from each label of a cluster (cluster_labels), and further ones to targets in view. Ends
/// early when cancelled. `narrow`: SurfaceNodes::narrow_cells.
LabelHits find_label_hits(const World& world, const SurfaceNodes& nodes,
                          const std::vector<std::uint8_t>& narrow, const std::vector<LabelId>& labels,
                          const RayTargets& targets, std::uint32_t rays, std::uint64_t seed,
                          const RunControl& control);

}  // namespace shelfbeam
