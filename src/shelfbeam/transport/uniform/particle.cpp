#include <cmath>
#include <limits>
#include <variant>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/transport/uniform/walks.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

namespace {

class Particle {
 public:
  Particle(const World& world, std::size_t j, const PathKey& key, const PathRules& rules, Tally& tally)
      : world_(world), source_(j), key_(key), rules_(rules), tally_(tally) {}

  void run() {
    if (!leave_source()) return;
    for (std::uint32_t step = 1;; ++step) {
      const auto hit = world_.rays.intersect(from_, direction_);
      ++tally_.rays;
      score_labels(hit);
      if (!hit || !scatter(*hit, step)) return;
    }
  }

 private:
  bool leave_source() {
    const auto random = key_.draw(0);
    const auto emitted = world_.emitters.emit(source_, {to_uniform(random[0]), to_uniform(random[1]),
                                                        to_uniform(random[2]), to_uniform(random[3])});
    if (!emitted) return false;
    from_ = {emitted->from.position, emitted->from.normal};
    if (rules_.samples_direct)
      connect_to_labels(from_, 1, 0, [&](const Vec3& to_label) {
        return world_.emitters.intensity(source_, emitted->from, to_label);
      });
    vertex_ = from_.position;
    direction_ = emitted->direction;
    initial_flux_ = flux_ = emitted->flux;
    return true;
  }

  // Connects to the labels and samples the next direction; false if the particle ends.
  bool scatter(const Hit& hit, std::uint32_t step) {
    const Material& material = world_.material(hit);
    const bool is_pane = shelfbeam::is_pane(material);
    if (bounces_ == rules_.max_bounces && !is_pane) return false;
    const Frame frame = Frame::of_surface(hit.point.normal);
    const Vec3 incoming = frame.to_local(-direction_);
    if (!has_only_specular(material))
      connect_to_labels(hit.point, flux_, step, [&](const Vec3& to_label) {
        const Vec3 outgoing = frame.to_local(to_label);
        return eval(material, incoming, outgoing) * std::abs(outgoing.z);
      });

    const auto random = key_.draw(step);
    const auto next =
        sample(material, incoming, to_uniform(random[0]), to_uniform(random[1]), to_uniform(random[2]));
    if (!next) return false;
    flux_ *= next->weight;
    from_ = hit.point;
    if (is_pane && next->direction.z * incoming.z < 0) {
      passed_ = hit.distance(vertex_, direction_);
    } else {
      if (bounces_ == rules_.max_bounces) return false;
      ++bounces_;
      vertex_ = hit.point.position;
      direction_ = frame.to_world(next->direction);
      passed_ = 0;
      specular_ = next->specular;
    }
    const double survival = survival_probability(flux_ / initial_flux_);
    if (to_uniform(random[3]) >= survival) return false;
    flux_ /= survival;
    return true;
  }

  // Next event estimation with every label. `scatter` returns f |cos| towards a direction, in 1/sr (at the
  // source the intensity, W/sr).
  template <class Scatter>
  void connect_to_labels(const SurfacePoint& at, double flux, std::uint32_t step, const Scatter& scatter) {
    const std::uint32_t bounces = step == 0 ? 0 : bounces_ + 1;
    const Receivers& receivers = world_.receivers;
    const auto place = key_.draw(step, 1);
    const double u1 = to_uniform(place[0]), u2 = to_uniform(place[1]);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const Vec3 label = receivers.point(i, u1, u2).position;
      connect(
          world_, at, label,
          bounces < rules_.max_bounces &&
              rules_.uses_images(receivers.is_point(i), world_.emitters.is_transceiver(source_)),
          [&](const Connection& way) {
            const double response = receivers.response(i, way.from_second);
            return response > 0 ? flux * scatter(way.from_first) * response : 0;
          },
          [&](double open, const Connection&) {
            ++tally_.rays;
            tally_.add(bounces, i, open * world_.rays.transmittance(at, label).share);
          },
          [&](double value, const Connection&) {
            tally_.rays += 2;
            tally_.add(bounces + 1, i, value);
          });
    }
  }

  // Adds the rectangles that the particle meets after a mirror or refraction, where no connection finds them.
  void score_labels(const std::optional<Hit>& hit) {
    if (!specular_) return;
    const double farthest =
        hit ? hit->distance(vertex_, direction_) : std::numeric_limits<double>::infinity();
    world_.receivers.each_rectangle(
        world_.rays, vertex_, direction_, passed_, farthest,
        [&](std::size_t i, double signal_per_watt) { tally_.add(bounces_, i, flux_ * signal_per_watt); });
  }

  const World& world_;
  const std::size_t source_;
  const PathKey& key_;
  const PathRules& rules_;
  Tally& tally_;

  SurfacePoint from_;        // origin of the next ray
  Vec3 direction_;           // direction of the next ray
  double flux_ = 0;          // W
  double initial_flux_ = 0;  // W
  std::uint32_t bounces_ = 0;
  Vec3 vertex_;            // the last vertex; a pane passed straight through is not a vertex
  double passed_ = 0;      // distance from this vertex to the origin of the next ray
  bool specular_ = false;  // whether a specular lobe gave the direction
};

}  // namespace

void follow_particle(const World& world, std::size_t j, const PathKey& key, const PathRules& rules,
                     Tally& tally) {
  Particle(world, j, key, rules, tally).run();
}

}  // namespace shelfbeam
