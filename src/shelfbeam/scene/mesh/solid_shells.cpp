#include "shelfbeam/scene/mesh/solid_shells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "shelfbeam/scene/mesh/shell_crossings.hpp"
#include "shelfbeam/scene/mesh/welded_corners.hpp"

namespace shelfbeam {

namespace {

using Indices = std::vector<std::uint32_t>;

/// Disjoint sets of numbers. Each number is as its set, or turned against it.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count), is_turned_(count, false) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  struct Member {
    std::uint32_t set;
    bool is_turned;
  };
  Member find(std::uint32_t number) {
    bool turned = false;
    std::uint32_t root = number;
    for (; parent_[root] != root; root = parent_[root]) turned = turned != is_turned_[root];
    const Member member{root, turned};
    while (parent_[number] != root && number != root) {
      const bool step = is_turned_[number];
      is_turned_[number] = turned;
      turned = turned != step;
      number = std::exchange(parent_[number], root);
    }
    return member;
  }
  /// Unites the sets of two numbers. False if they are in one set and turned otherwise.
  bool unite(std::uint32_t a, std::uint32_t b, bool is_turned) {
    const Member one = find(a), other = find(b);
    const bool between = (one.is_turned != other.is_turned) != is_turned;
    if (one.set == other.set) return !between;
    parent_[std::max(one.set, other.set)] = std::min(one.set, other.set);
    is_turned_[std::max(one.set, other.set)] = between;
    return true;
  }

 private:
  Indices parent_;
  std::vector<bool> is_turned_;
};

struct Edge {
  std::uint32_t low, high, triangle;
  bool ascends;  ///< in the triangle, from its lower to its higher corner

  bool joins_same(const Edge& other) const { return low == other.low && high == other.high; }
};

/// A closed shell. A patch consists of triangles that are joined by edges of exactly two triangles.
struct Shell {
  Indices triangles;
  bool is_one_patch = true;
};

class Solids {
 public:
  explicit Solids(const std::vector<SolidTriangle>& triangles)
      : triangles_(triangles),
        corners_(welded(triangles)),
        patches_(triangles.size()),
        facings_(triangles.size(), Facing::outwards),
        shell_of_(triangles.size(), none),
        patch_of_(triangles.size(), none) {}

  std::optional<std::vector<Facing>> facings() {
    Indices all(triangles_.size());
    std::iota(all.begin(), all.end(), 0U);
    Indices open = find_shells(std::move(all));
    std::erase_if(open, [&](std::uint32_t t) { return !triangles_[t].has_area; });
    for (const std::uint32_t t : find_shells(std::move(open))) facings_[t] = Facing::open;
    for (std::uint32_t s = 0; s < shells_.size(); ++s)
      for (const std::uint32_t t : shells_[s].triangles) shell_of_[t] = s;
    const bool is_simple = shells_.size() <= 1 && (shells_.empty() || shells_[0].is_one_patch);
    if (!is_simple) crossings_.emplace(triangles_, 2 * corners_.rounding);
    for (const Shell& shell : shells_)
      if (!(shell.is_one_patch ? face_outwards(shell) : face_by_crossings(shell))) return {};
    tallies_.resize(shells_.size());
    std::vector<const Shell*> cavities;
    if (shells_.size() > 1)
      for (const Shell& shell : shells_) {
        const auto depth = depth_of(shell);
        if (!depth) return {};
        if (*depth % 2 == 1) cavities.push_back(&shell);
      }
    for (const Shell* cavity : cavities)
      for (const std::uint32_t t : cavity->triangles) turn(t);
    return std::move(facings_);
  }

 private:
  static constexpr std::uint32_t none = ~0U;

  void turn(std::uint32_t t) {
    facings_[t] = facings_[t] == Facing::outwards ? Facing::inwards : Facing::outwards;
  }

  // Adds the closed shells of these triangles to `shells_`. Returns the other triangles.
  Indices find_shells(Indices active) {
    std::erase_if(active, [&](std::uint32_t t) {
      const auto& [a, b, c] = corners_.numbers[t];
      return a == b || b == c || c == a;
    });
    const std::vector<Edge> edges = edges_of(active);
    Sets shells(triangles_.size());
    patches_ = Sets(triangles_.size());
    Indices faulty;  // triangles of shells that have no inside
    std::vector<bool> is_single(triangles_.size(), false);
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].joins_same(edges[begin])) ++end;
      const Edge &first = edges[begin], &second = edges[end - 1];
      for (std::size_t k = begin + 1; k < end; ++k) shells.unite(first.triangle, edges[k].triangle, false);
      const bool is_fold = end - begin == 2 &&
                           !patches_.unite(first.triangle, second.triangle, first.ascends == second.ascends);
      if ((end - begin) % 2 == 1 || is_fold) faulty.push_back(first.triangle);
      // A shell that is listed once has an edge of two triangles.
      if ((end - begin) % 4 != 0) is_single[first.triangle] = true;
    }
    std::map<std::uint32_t, Shell> found;
    for (const std::uint32_t t : active) found[shells.find(t).set].triangles.push_back(t);
    Indices rest, once;
    for (const std::uint32_t t : faulty)
      if (const auto shell = found.find(shells.find(t).set); shell != found.end()) {
        rest.insert(rest.end(), shell->second.triangles.begin(), shell->second.triangles.end());
        found.erase(shell);
      }
    std::vector<bool> has_single(triangles_.size(), false);
    for (const std::uint32_t t : active)
      if (is_single[t]) has_single[shells.find(t).set] = true;
    for (auto& [set, shell] : found) {
      if (!has_single[set] && drop_copies(shell.triangles)) {
        once.insert(once.end(), shell.triangles.begin(), shell.triangles.end());
        continue;
      }
      const std::uint32_t patch = patches_.find(shell.triangles[0]).set;
      for (const std::uint32_t t : shell.triangles) {
        const auto [set_of_t, is_turned] = patches_.find(t);
        shell.is_one_patch = shell.is_one_patch && set_of_t == patch;
        patch_of_[t] = set_of_t;
        if (is_turned) turn(t);
      }
      shells_.push_back(std::move(shell));
    }
    if (!once.empty()) {
      const Indices more = find_shells(std::move(once));
      rest.insert(rest.end(), more.begin(), more.end());
    }
    return rest;
  }

  std::vector<Edge> edges_of(const Indices& active) const {
    std::vector<Edge> edges;
    edges.reserve(3 * active.size());
    for (const std::uint32_t t : active)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corners_.numbers[t][k], b = corners_.numbers[t][(k + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
      }
    std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) {
      return std::tie(e.low, e.high, e.triangle) < std::tie(f.low, f.high, f.triangle);
    });
    return edges;
  }

  // Removes the second copy of every triangle; false, without a change, unless there are two of each.
  bool drop_copies(Indices& triangles) {
    std::map<std::array<std::uint32_t, 3>, Indices> copies;
    for (const std::uint32_t t : triangles) {
      auto corners = corners_.numbers[t];
      std::sort(corners.begin(), corners.end());
      copies[corners].push_back(t);
    }
    for (const auto& [corners, same] : copies)
      if (same.size() != 2) return false;
    triangles.clear();
    for (const auto& [corners, same] : copies) {
      triangles.push_back(same[0]);
      facings_[same[1]] = Facing::repeated;
    }
    return true;
  }

  // The normal with twice the area as its length, with the facing so far.
  Vec3 normal(std::uint32_t t) const {
    const auto& [a, b, c] = triangles_[t].corners;
    return cross(b - a, c - a) * (facings_[t] == Facing::inwards ? -1 : 1);
  }

  // By the divergence theorem, about a corner of the shell, so that a far origin does not reduce precision.
  bool face_outwards(const Shell& shell) {
    const Vec3 origin = triangles_[shell.triangles[0]].corners[0];
    double volume = 0;
    for (const std::uint32_t t : shell.triangles) volume += dot(triangles_[t].corners[0] - origin, normal(t));
    if (volume < 0)
      for (const std::uint32_t t : shell.triangles) turn(t);
    return true;
  }

  // Parts of the shell touch. A patch is outside where a ray from it crosses the shell an even number of
  // times.
  bool face_by_crossings(const Shell& shell) {
    std::map<std::uint32_t, Indices> patches;
    for (const std::uint32_t t : shell.triangles) patches[patch_of_[t]].push_back(t);
    for (auto& [patch, members] : patches) {
      std::sort(members.begin(), members.end(), [&](std::uint32_t s, std::uint32_t t) {
        const double area = length_squared(normal(s)), other = length_squared(normal(t));
        return area > other || (area == other && s < t);
      });
      constexpr std::size_t max_tries = 16;
      std::optional<bool> must_turn;
      for (std::size_t k = 0; k < std::min(members.size(), max_tries); ++k) {
        const auto sample = sample_of(members[k]);
        if (!sample) return false;
        if (!must_turn || !sample->has_equal) must_turn = sample->must_turn;
        if (!sample->has_equal) break;
      }
      if (*must_turn)
        for (const std::uint32_t t : members) turn(t);
    }
    return true;
  }

  struct Sample {
    bool must_turn = false;
    bool has_equal = false;  ///< another patch coincides with the triangle there
  };
  // Each of several patches that coincide counts as nearer to the start of the ray than later ones.
  // This decides for two equal faces, on both sides of which there is glass.
  std::optional<Sample> sample_of(std::uint32_t triangle) const {
    Sample sample;
    const std::uint32_t patch = patch_of_[triangle];
    bool is_inside = false;
    const bool is_known = crossings_->from(point_in(triangle, 0), [&](std::uint32_t t, bool is_on) {
      if (shell_of_[t] != shell_of_[triangle]) return;
      if (!is_on || patch_of_[t] > patch) is_inside = !is_inside;
      sample.has_equal = sample.has_equal || (is_on && t != triangle);
    });
    const bool is_along = crossings_->faces_along(triangle) == (facings_[triangle] == Facing::outwards);
    sample.must_turn = is_along == is_inside;
    return is_known ? std::optional(sample) : std::nullopt;
  }

  // A point of a triangle, near one of its corners, and on no line of symmetry.
  Vec3 point_in(std::uint32_t t, std::size_t corner) const {
    const auto& corners = triangles_[t].corners;
    return 0.7131 * corners[corner] + 0.1718 * corners[(corner + 1) % 3] + 0.1151 * corners[(corner + 2) % 3];
  }

  // The number of other shells that contain this one. A shell that is partly inside does not count.
  std::optional<std::size_t> depth_of(const Shell& shell) {
    struct Candidate {
      std::uint32_t shell;
      bool has_inside = false;  ///< a point of this shell is inside, not on the surface
    };
    std::vector<Candidate> candidates;
    Indices met;
    const std::uint32_t own = shell_of_[shell.triangles[0]];
    bool is_first = true;
    for (const Vec3& point : extremes(shell)) {
      const bool is_known = crossings_->from(point, [&](std::uint32_t t, bool is_on) {
        const std::uint32_t other = shell_of_[t];
        if (other == none || other == own) return;
        if (tallies_[other].crossings++ == 0) met.push_back(other);
        tallies_[other].is_on = tallies_[other].is_on || is_on;
      });
      if (!is_known) return {};
      if (std::exchange(is_first, false))
        for (const std::uint32_t other : met) candidates.push_back({other});
      std::erase_if(candidates, [&](Candidate& candidate) {
        const Tally& tally = tallies_[candidate.shell];
        candidate.has_inside = candidate.has_inside || !tally.is_on;
        return tally.crossings % 2 == 0 && !tally.is_on;
      });
      for (const std::uint32_t other : std::exchange(met, {})) tallies_[other] = {};
      if (candidates.empty()) return 0;
    }
    return static_cast<std::size_t>(
        std::count_if(candidates.begin(), candidates.end(), [](const Candidate& c) { return c.has_inside; }));
  }

  // Points of the shell that lie far out in each direction along the axes.
  std::vector<Vec3> extremes(const Shell& shell) const {
    std::vector<Vec3> points;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        double farthest = -HUGE_VAL;
        Vec3 point;
        for (const std::uint32_t t : shell.triangles)
          for (std::size_t k = 0; k < 3; ++k)
            if (const double at = sign * triangles_[t].corners[k][axis]; at > farthest) {
              farthest = at;
              point = point_in(t, k);
            }
        points.push_back(point);
      }
    return points;
  }

  struct Tally {
    std::uint32_t crossings = 0;
    bool is_on = false;
  };

  const std::vector<SolidTriangle>& triangles_;
  WeldedCorners corners_;
  Sets patches_;
  std::vector<Facing> facings_;
  Indices shell_of_, patch_of_;
  std::vector<Shell> shells_;
  std::optional<ShellCrossings> crossings_;
  std::vector<Tally> tallies_;  ///< of the present ray, by shell
};

}  // namespace

std::optional<std::vector<Facing>> facings(const std::vector<SolidTriangle>& triangles) {
  return Solids(triangles).facings();
}

}  // namespace shelfbeam
