#include "shelfbeam/transport/run/batch_driver.hpp"

namespace shelfbeam::detail {

bool BatchDriver::sample(std::uint32_t item, std::uint32_t batch, BatchValues& values) {
  values.clear();
  values.rays = 0;
  values.shadow_rays = {};
  if (!estimator_.sample(item, batch, control_.cancel, values)) return false;
  expect_numbers(scene_, estimator_.block(item), values);
  rays_.fetch_add(values.rays, std::memory_order_relaxed);
  {
    const std::scoped_lock lock(shadow_rays_mutex_);
    shadow_rays_ += values.shadow_rays;
  }
  batches_.fetch_add(1, std::memory_order_relaxed);
  sampled_();
  return true;
}

}  // namespace shelfbeam::detail
