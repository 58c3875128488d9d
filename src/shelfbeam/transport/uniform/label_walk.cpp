#include <cmath>
#include <limits>
#include <variant>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/transport/uniform/walks.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

namespace {

class LabelWalk {
 public:
  LabelWalk(const World& world, std::size_t i, const PathKey& key, const PathRules& rules, Tally& tally)
      : world_(world),
        label_(i),
        key_(key),
        rules_(rules),
        tally_(tally),
        n_(static_cast<std::uint32_t>(world.emitters.size())) {}

  void run() {
    if (!leave_label()) return;
    for (std::uint32_t step = 1;; ++step) {
      const auto hit = world_.rays.intersect(from_, direction_);
      ++tally_.rays;
      score_sources(hit);
      if (!hit || !scatter(*hit, step)) return;
    }
  }

 private:
  bool leave_label() {
    const Receivers& receivers = world_.receivers;
    const auto random = key_.draw(0);
    from_ = {};
    if (receivers.is_point(label_)) {
      from_ = receivers.point(label_, 0, 0);
    } else {
      const auto place = key_.draw(0, 1);
      from_ = receivers.point(label_, to_uniform(place[2]), to_uniform(place[3]));
    }
    vertex_ = from_.position;
    if (rules_.samples_direct && rules_.strategy != Strategy::walk)
      connect_to_source(
          from_, random[0], 0, [&](const Vec3& to_source) { return receivers.response(label_, to_source); },
          [&](const Vec3& to_source) {
            return pdf(receivers.responsivity(label_), receivers.frame(label_).to_local(to_source));
          });
    const auto drawn = sample(receivers.responsivity(label_), to_uniform(random[1]), to_uniform(random[2]));
    if (!drawn) return false;
    direction_ = receivers.frame(label_).to_world(drawn->direction);
    weight_at_label_ = throughput_ =
        integral(receivers.responsivity(label_));  // R / p, pi for a cosine label
    pdf_ = drawn->pdf;
    return true;
  }

  // Adds the connection and samples the next direction; false if the walk ends.
  bool scatter(const Hit& hit, std::uint32_t step) {
    const Material& material = world_.material(hit);
    const bool is_pane = shelfbeam::is_pane(material);
    if (bounces_ == rules_.max_bounces && !is_pane) return false;
    const Frame frame = Frame::of_surface(hit.point.normal);
    const Vec3 outgoing = frame.to_local(-direction_);
    const auto random = key_.draw(step);

    if (rules_.strategy != Strategy::walk && !has_only_specular(material))
      connect_to_source(
          hit.point, random[0], step,
          [&](const Vec3& to_source) {
            const Vec3 incoming = frame.to_local(to_source);
            return eval(material, outgoing, incoming) * std::abs(incoming.z);
          },
          [&](const Vec3& to_source) { return pdf(material, outgoing, frame.to_local(to_source)); });

    // The random number that chose the source may also choose the lobe, because connection and continuation
    // are terms of a sum.
    const auto next =
        sample(material, outgoing, to_uniform(random[0]), to_uniform(random[1]), to_uniform(random[2]));
    if (!next) return false;
    throughput_ *= next->weight;
    from_ = hit.point;
    if (is_pane && next->direction.z * outgoing.z < 0) {
      passed_ = hit.distance(vertex_, direction_);
      pdf_ *= next->pdf;
    } else {
      if (bounces_ == rules_.max_bounces) return false;
      ++bounces_;
      travelled_ += hit.distance(vertex_, direction_);
      vertex_ = hit.point.position;
      direction_ = frame.to_world(next->direction);
      passed_ = 0;
      pdf_ = next->pdf;
      departure_ = next->specular
                       ? after_specular(departure_, next->direction.z * outgoing.z > 0 &&
                                                        world_.mirrors.contains(hit.point.triangle))
                       : Departure::scattered;
    }
    const double survival = survival_probability(throughput_ / weight_at_label_);
    if (to_uniform(random[3]) >= survival) return false;
    throughput_ /= survival;
    return true;
  }

  // Next event estimation with one source. At a surface, the path has one more bounce than the walk so far.
  // For a direction, `scatter` returns f |cos| (R at the label), and `density` the density with which the
  // walk samples it.
  template <class Scatter, class Density>
  void connect_to_source(const SurfacePoint& at, std::uint32_t choice, std::uint32_t step,
                         const Scatter& scatter, const Density& density) {
    const double travelled = travelled_ + length(at.position - vertex_);
    const std::uint32_t bounces = step == 0 ? 0 : bounces_ + 1;
    if (bounces > rules_.max_bounces) return;
    const Emitters& emitters = world_.emitters;
    const std::uint32_t j = to_index(choice, n_);
    const bool is_point = emitters.is_point(j);
    LightPoint light;
    if (is_point) {
      light = emitters.point(j, 0, 0);
    } else {
      const auto place = key_.draw(step, 1);
      light = emitters.point(j, to_uniform(place[0]), to_uniform(place[1]));
    }
    const double weight = n_ * (step == 0 ? 1 : throughput_);
    ++tally_.shadow_rays.connections;

    connect(
        world_, at, light.position,
        bounces < rules_.max_bounces &&
            rules_.uses_images(world_.receivers.is_point(label_), emitters.is_transceiver(j)),
        [&](const Connection& way) {
          const double scattered = weight * scatter(way.from_first);
          return scattered > 0 ? scattered * emitters.intensity(j, light, way.from_second) : 0;
        },
        [&](double open, const Connection& way) {
          const Transmittance transmittance = world_.rays.transmittance(at, light.position);
          ++tally_.rays;
          ++tally_.shadow_rays.traced;
          if (transmittance.share == 0) {
            ++tally_.shadow_rays.occluded;
            return;
          }
          const double share = rules_.strategy == Strategy::mis && !is_point
                                   ? mis_weight(rules_.heuristic, light_pdf(light, at.position) / n_,
                                                density(way.from_first) * transmittance.probability)
                                   : 1;
          tally_.add(bounces, j, open * transmittance.share * share,
                     travelled + std::sqrt(way.length_squared));
        },
        [&](double value, const Connection& way) {
          tally_.rays += 2;
          tally_.add(bounces + 1, j, value, travelled + std::sqrt(way.length_squared));
        });
  }

  // Adds the discs that the walk meets before the next surface, and this surface if it emits.
  void score_sources(const std::optional<Hit>& hit) {
    if (rules_.strategy == Strategy::nee && departure_ == Departure::scattered) return;
    if (bounces_ == 0 && !rules_.samples_direct) return;
    const double farthest =
        hit ? hit->distance(vertex_, direction_) : std::numeric_limits<double>::infinity();
    const bool shared = rules_.strategy == Strategy::mis && departure_ == Departure::scattered;
    const auto score = [&](std::size_t j, const LightPoint& light, double radiance) {
      const double weight = shared ? mis_weight(rules_.heuristic, pdf_, light_pdf(light, vertex_) / n_) : 1;
      tally_.add(bounces_, j, throughput_ * radiance * weight, travelled_ + length(light.position - vertex_));
    };
    if (departure_ != Departure::mirrored || rules_.strategy == Strategy::walk)
      world_.emitters.each_disc(world_.rays, vertex_, direction_, passed_, farthest, score);
    if (!hit) return;
    if (const auto j = world_.emitters.surface_of(hit->material))
      score(*j, {hit->point.position, hit->point.normal, world_.emitters.area(*j)},
            world_.emitters.radiance(*j));
  }

  const World& world_;
  const std::size_t label_;
  const PathKey& key_;
  const PathRules& rules_;
  Tally& tally_;
  const std::uint32_t n_;

  SurfacePoint from_;      // origin of the next ray
  Vec3 direction_;         // direction of the next ray
  double throughput_ = 1;  // beta (2.20), including the weight at the label
  double weight_at_label_ = 1;
  std::uint32_t bounces_ = 0;
  Vec3 vertex_;           // the last vertex; a pane passed straight through is not a vertex
  double passed_ = 0;     // distance from this vertex to the origin of the next ray
  double travelled_ = 0;  // length of the path up to this vertex
  double pdf_ = 0;        // density of the direction sampled there times the probability of passing the panes
  Departure departure_ = Departure::scattered;  // from this vertex
};

}  // namespace

void walk_from_label(const World& world, std::size_t i, const PathKey& key, const PathRules& rules,
                     Tally& tally) {
  LabelWalk(world, i, key, rules, tally).run();
}

}  // namespace shelfbeam
