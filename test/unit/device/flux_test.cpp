#include "shelfbeam/math/random.hpp"
#include "shelfbeam/stats/moments.hpp"

#include "support/hypothesis.hpp"
#include "support/testing.hpp"
#include "unit/device/profiles.hpp"

namespace shelfbeam::test {
namespace {

// The digits of k mirrored at the radix point: the van der Corput sequence; bases 2 and 3 give Halton's.
double radical_inverse(std::uint32_t k, std::uint32_t base) {
  double result = 0, digit = 1.0 / base;
  for (; k > 0; k /= base, digit /= base) result += digit * (k % base);
  return result;
}

constexpr int shifts = 16;
constexpr std::uint32_t points = 40000;

/// The integral over the sphere by Halton's sequence in (cos theta, phi), randomly shifted: mean and standard
/// error over the shifts. It uses only values of the profile.
template <class Value>
std::pair<double, double> quasi_random_integral(const Value& value) {
  static const auto halton = [] {
    std::vector<std::pair<double, double>> result;
    for (std::uint32_t k = 0; k < points; ++k)
      result.emplace_back(radical_inverse(k, 2), radical_inverse(k, 3));
    return result;
  }();
  Moments moments;
  for (std::uint32_t shift = 0; shift < shifts; ++shift) {
    const auto u = philox({shift, 0, 0, 0}, 5);
    double sum = 0;
    for (const auto& [a, b] : halton) {
      const double z = 2 * std::fmod(a + to_uniform(u[0]), 1.0) - 1,
                   phi = 2 * pi * std::fmod(b + to_uniform(u[1]), 1.0);
      const double across = std::sqrt(1 - z * z);
      sum += value(Vec3{across * std::cos(phi), across * std::sin(phi), z});
    }
    moments.add(4 * pi * sum / points);
  }
  return {moments.mean(), moments.standard_error()};
}

struct Integrals {
  std::vector<std::string> names;
  std::vector<double> claimed, found, errors;

  template <class Value>
  void add(const std::string& name, double claim, const Value& value) {
    const auto [mean, error] = quasi_random_integral(value);
    names.push_back(name);
    claimed.push_back(claim);
    found.push_back(mean);
    errors.push_back(std::max(error, 1e-12 * mean));  // rounding, if the points integrate exactly
  }
  ZTest test() const { return z_test(claimed, found, errors, 1e-3, shifts - 1); }
};

// Joint level 1e-3 (Sidak) over all profiles and responses. The standard errors are below 8e-4 of the
// integrals (of the narrowest lobe; far less for others), so any integral that is 1 % wrong is noticed.
TEST(Flux, OfEveryProfileIsItsQuasiRandomIntegral) {
  Integrals all;
  for (const auto& [name, e] : profiles())
    all.add(name, power(e), [&profile = e](const Vec3& d) { return intensity(profile, d); });
  for (const auto& [name, r] : responses())
    all.add(name, integral(r), [&heard = r](const Vec3& d) { return response(heard, d.z); });
  const ZTest test = all.test();
  EXPECT_TRUE(test.pass) << all.names[test.worst] << ": " << all.claimed[test.worst] << " is not "
                         << all.found[test.worst] << " +- " << all.errors[test.worst];
  for (std::size_t k = 0; k < all.names.size(); ++k) {
    EXPECT_LT(all.errors[k], 8e-4 * all.found[k]) << all.names[k];
    Integrals wrong = all;
    wrong.claimed[k] *= 1.01;
    EXPECT_FALSE(wrong.test().pass) << all.names[k];
  }
}

}  // namespace
}  // namespace shelfbeam::test
