// In a closed room of uniform albedo rho the flux Phi that enters is absorbed in the end, so the flux
// incident on all walls, all bounces counted, is Phi / (1 - rho).

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/stats/hypothesis.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

namespace shelfbeam {
namespace {

constexpr double phi = 4 * pi / 3;  // W, of a sin 2 theta unit of 1 W/sr

struct Incident {
  double flux = 0, standard_error = 0, direct = 0;
};

// A room of 5 x 4 x 3 m with labels in the middle of each cell of a fine grid on every wall.
Incident incident_flux(double rho) {
  const Vec3 size{5, 4, 3};
  std::string text =
      fmt::format(R"({{"room": {{"size": [5, 4, 3], "floor": "w", "ceiling": "w", "walls": "w"}},
    "materials": {{"w": {{"type": "lambertian", "reflectance": {}}}}}, "label_types": {{"s": {{"threshold": 1}}}},
    "transceiver_types": {{"u": {{"emission": {{"type": "sin2theta", "peak": 1}}}}}},
    "transceivers": {{"list": [{{"id": "T", "position": [2.2, 1.7, 2.1], "type": "u"}}]}}, "labels": [)",
                  rho);
  std::vector<double> areas;
  const char* comma = "";
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3, across = 24, up = 24;
      for (int i = 0; i < across; ++i)
        for (int k = 0; k < up; ++k) {
          double p[3], n[3] = {0, 0, 0};
          p[axis] = far ? size[axis] - 1e-4 : 1e-4;
          p[a] = (i + 0.5) * size[a] / across;
          p[b] = (k + 0.5) * size[b] / up;
          n[axis] = far ? -1 : 1;
          text += fmt::format(
              R"({}{{"id": "{}", "position": [{}, {}, {}], "normal": [{}, {}, {}], "type": "s"}})", comma,
              areas.size(), p[0], p[1], p[2], n[0], n[1], n[2]);
          areas.push_back(size[a] * size[b] / (across * up));
          comma = ",";
        }
    }
  const SignalMatrix matrix =
      simulate(make_scene(parse_store(text + "]}", "room", ".")), "", {640, DirectLight::exact, 3}).matrix;
  Incident incident;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    incident.flux += areas[i] * matrix.mean[i];
    incident.direct += areas[i] * matrix.direct[i];
    incident.standard_error +=
        std::pow(areas[i] * matrix.standard_error[i], 2);  // labels have streams of their own
  }
  incident.standard_error = std::sqrt(incident.standard_error);
  return incident;
}

// z-test at 0.1 %: a statistical error of about 0.05 %, and that of the midpoint rule, which is 0.07 % of the
// direct flux (whose integral is known: Phi) and less of the smooth rest. The control, an albedo 2 % off,
// changes the flux by 5 %.
TEST(FluxBalance, EverythingThatEntersIsAbsorbed) {
  constexpr double rho = 0.7, midpoint_error = 7e-4;
  const auto agrees = [](const Incident& found, double expected) {
    const double error = std::hypot(found.standard_error, midpoint_error * expected);
    return z_test(std::vector{found.flux}, std::vector{expected}, std::vector{error}, 0.001).pass;
  };
  const Incident found = incident_flux(rho);
  EXPECT_NEAR(found.direct / phi, 1, midpoint_error);
  EXPECT_LT(found.standard_error / found.flux, 2e-3);
  EXPECT_TRUE(agrees(found, phi / (1 - rho))) << found.flux << " +- " << found.standard_error;
  EXPECT_FALSE(agrees(found, phi / (1 - 1.02 * rho)));
  EXPECT_FALSE(agrees(incident_flux(1.02 * rho), phi / (1 - rho)));
}

}  // namespace
}  // namespace shelfbeam
