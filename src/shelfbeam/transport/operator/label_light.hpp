#pragma once

#include <vector>

#include "shelfbeam/transport/operator/label_hits.hpp"
#include "shelfbeam/transport/operator/surface_field.hpp"
#include "shelfbeam/transport/operator/unit_spots.hpp"

namespace shelfbeam {

/// The reflected light that a unit gives the labels of one cluster, by their order in LabelHits, in parts
/// that differ in their errors.
struct LabelLight {
  std::vector<float> resolved;  ///< by one bounce, from points with shadow rays
  std::vector<float> squares;   ///< of these contributions less their means by cell
  std::vector<float> mean;      ///< from the mean light of cells
  std::vector<float> spots;     ///< from bright spots
};

/// A unit with its light on the surfaces of a shop.
struct LitShop {
  const World& world;
  const std::vector<SurfaceGuide>& guides;
  const UnitBeam& beam;
  const SurfaceField& field;
  const UnitSpots& spots;
  float requirement;  ///< the smallest
};

/// Evaluates the light of the unit on the points of labels: with shadow rays where it is strong and partly
/// hidden.
class LabelLightSum {
 public:
  const LabelLight& of(const LabelHits& hits, const LitShop& shop);

 private:
  void sort_blocks(const LabelHits& hits, const LitShop& shop);
  void add_points(const LabelHits& hits, const LitShop& shop);
  void find_deviations();
  void add_lobes(const LabelHits& hits, const LitShop& shop);

  LabelLight light_;
  std::vector<std::uint32_t> blocks_, points_;  // with the values below
  std::vector<float> block_values_, point_values_, deviations_, irradiance_, shares_;
  std::vector<std::size_t> block_ends_;  // in points_, of blocks with points
  std::vector<std::uint32_t> asked_;     // indices into points_
  std::vector<RayEnd> targets_;
};

}  // namespace shelfbeam
