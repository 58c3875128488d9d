#include "shelfbeam/transport/operator/light_operator.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/warp.hpp"

#include "physics/bare_scene.hpp"
#include "support/sanitizers.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam {
namespace {

using testing::HasSubstr;

// A room with a box, ten labels and a unit of each kind that emits like a surface.
test::BareScene room_with_box() {
  test::BareScene room;
  room.box(room.material(Lambertian{0.7}), {0, 0, 0}, {6, 5, 3});
  room.box(room.material(Lambertian{0.5}), {2.8, 0.5, 0}, {3.3, 4.5, 1.8});
  for (int k = 0; k < 10; ++k)
    room.label({k < 5 ? 1.2 + 0.2 * k : 4 + 0.2 * k - 1, 1 + 0.33 * k, 0.3 + 0.1 * k}, {0, 0, 1});
  room.unit({1.5, 2.5, 2.9}, {0, 0, -1}, GeneralizedLambertian{1, pi});
  room.unit({4.5, 2.5, 2.9}, {0, 0, -1}, SinTwoTheta{1});
  return room;
}

// A unit of the room, at another place.
Transceiver moved(const Scene& scene, std::size_t unit, const Vec3& position) {
  Transceiver other = scene.transceivers[unit];
  other.position = position;
  return other;
}

constexpr OperatorEffort little{.label_rays = 64, .gather_rays = 8};

TEST(LightOperator, IsLinearInThePower) {
  const test::BareScene bare = room_with_box();
  const World world(bare.scene);
  const LightOperator light(world, 1, little);
  Transceiver unit = moved(bare.scene, 1, {1.9, 3.1, 2.6});
  const Preview whole = light.column(unit);
  unit.relative_power = 0.25;
  const Preview quarter = light.column(unit);
  for (std::size_t i = 0; i < whole.signal.size(); ++i)
    EXPECT_NEAR(quarter.signal[i], whole.signal[i] / 4, 2e-3F * whole.signal[i]) << i;
}

// As responses and thresholds are multiplied by a power of two, so are signals and stated errors. The unit is
// beside a wall, so spots of light count; beyond a reach of 3 m, light is omitted.
TEST(LightOperator, MeasuresInAnyUnit) {
  const auto column = [](double factor) {
    test::BareScene bare = room_with_box();
    for (LabelType& type : bare.scene.label_types) {
      type.threshold = 0.02 * factor;
      type.responsivity = ResponseTable{{{0, 0.7, 1.4}, {0}, {factor, 0.7 * factor, 0.1 * factor}}};
    }
    const World world(bare.scene);
    const LightOperator light(world, 1, {.label_rays = 64, .gather_rays = 8, .reach = 3});
    return light.column(moved(bare.scene, 1, {0.1, 3.1, 2.6}));
  };
  const Preview ordinary = column(1);
  for (const int exponent : {-20, 20}) {
    const Preview other = column(std::ldexp(1.0, exponent));
    for (std::size_t i = 0; i < ordinary.signal.size(); ++i) {
      EXPECT_EQ(std::ldexp(other.signal[i], -exponent), ordinary.signal[i]) << i;
      EXPECT_EQ(std::ldexp(other.error[i], -exponent), ordinary.error[i]) << i;
    }
    EXPECT_EQ(other.doubts, ordinary.doubts);
  }
}

// A table of the intensities takes another path through the code. It is linear between 90 angles.
TEST(LightOperator, KnowsTheBeamsOfAllOrders) {
  test::BareScene bare = room_with_box();
  for (const double order : {1.0, 4.0}) {
    const Emission beam = GeneralizedLambertian{order, 3};
    std::vector<double> angles(91), intensities(91);
    for (std::size_t k = 0; k < angles.size(); ++k) {
      angles[k] = pi / 2 * static_cast<double>(k) / 90;
      intensities[k] = mean_intensity(beam, angles[k]);
    }
    const auto column = [&](const Emission& emission) {
      bare.scene.transceiver_types[0].emission = emission;
      const World world(bare.scene);
      return LightOperator(world, 1, little).column(bare.scene.transceivers[0]).signal;
    };
    const auto signal = column(beam),
               of_table = column(EmissionTable{DirectionTable(angles, {0}, intensities)});
    for (std::size_t i = 0; i < signal.size(); ++i)
      EXPECT_NEAR(signal[i], of_table[i], 5e-3F * signal[i]) << order << ' ' << i;
  }
}

// A label with the cosine response and a unit that emits like a surface of power pi may change places.
TEST(LightOperator, IsReciprocal) {
  const auto signal_with = [](const Vec3& label, const Vec3& label_normal, const Vec3& unit,
                              const Vec3& axis) {
    test::BareScene bare = room_with_box();
    bare.scene.labels[0].position = label;
    bare.scene.labels[0].normal = label_normal;
    const World world(bare.scene);
    Transceiver probe = moved(bare.scene, 0, unit);
    probe.axis = axis;
    const Preview preview = LightOperator(world, 1).column(probe);
    return std::pair(preview.signal[0], preview.error[0]);
  };
  const Vec3 low{1.2, 2.1, 0.6}, high{4.4, 3.3, 2.4}, up{0, 0, 1}, down = normalized({-0.3, 0.1, -1});
  const auto [forth, its_error] = signal_with(low, up, high, down);
  const auto [back, error] = signal_with(high, down, low, up);
  ASSERT_GT(forth, 20 * its_error);
  // At four standard errors, one run in 15,000 would fail.
  EXPECT_NEAR(forth, back, 4 * std::hypot(its_error, error));
  const auto [turned, turned_error] = signal_with(high, down, low, {0, 0, -1});
  EXPECT_GT(std::abs(forth - turned), 4 * std::hypot(its_error, turned_error)) << "control";
}

TEST(LightOperator, DoesNotDependOnThreads) {
  const test::BareScene bare = room_with_box();
  const World world(bare.scene);
  const auto column_with = [&](unsigned threads) {
    const ThreadLimit allowed(threads);
    Preview preview;
    with_threads(threads, [&] {
      const LightOperator light(world, 1, little);
      preview = light.column(bare.scene.transceivers[1]);
    });
    return preview;
  };
  const Preview one = column_with(1), two = column_with(2),
                other = LightOperator(world, 2, little).column(bare.scene.transceivers[1]);
  EXPECT_EQ(one.signal, two.signal);
  EXPECT_EQ(one.error, two.error);
  EXPECT_NE(one.signal, other.signal);
}

TEST(LightOperator, DoesNotDependOnIds) {
  const test::BareScene bare = room_with_box();
  const World world(bare.scene);
  const LightOperator light(world, 1, little);
  Transceiver renamed = bare.scene.transceivers[0];
  renamed.id += " with another name";
  EXPECT_EQ(light.column(bare.scene.transceivers[0]).signal, light.column(renamed).signal);
}

// The errors of a short reach contain the light that it omits.
TEST(LightOperator, StatesWhatIsBeyondItsReach) {
  const test::BareScene bare = room_with_box();
  const World world(bare.scene);
  OperatorEffort far = little, near = little;
  near.reach = 3.5;
  const Preview whole = LightOperator(world, 1, far).column(bare.scene.transceivers[0]),
                part = LightOperator(world, 1, near).column(bare.scene.transceivers[0]);
  std::size_t inside = 0, inside_otherwise = 0;
  for (std::size_t i = 0; i < whole.signal.size(); ++i) {
    const float lost = whole.signal[i] - part.signal[i];
    EXPECT_GT(lost, 0);
    inside += lost <= 1.96F * part.error[i] ? 1 : 0;
    inside_otherwise += lost <= 1.96F * whole.error[i] ? 1 : 0;
  }
  EXPECT_GE(inside, 9U);
  EXPECT_LE(inside_otherwise, 5U) << "control: without the term for the reach";
}

class LightOperatorFile : public testing::Test {
 protected:
  Preview column(const LightOperator& light) const { return light.column(bare_.scene.transceivers[0]); }

  test::BareScene bare_ = room_with_box();
  World world_{bare_.scene};
  LightOperator light_{world_, 1, little};
  test::TempFolder folder_;
  std::filesystem::path path_ = folder_ / "operator";
};

TEST_F(LightOperatorFile, KeepsEveryBit) {
  EXPECT_FALSE(LightOperator::load(path_, world_, 1, little));
  light_.save(path_);
  const auto loaded = LightOperator::load(path_, world_, 1, little);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(column(*loaded).signal, column(light_).signal);
  EXPECT_EQ(column(*loaded).error, column(light_).error);
  EXPECT_EQ(column(*loaded).direct, column(light_).direct);
  EXPECT_EQ(column(*loaded).doubts, column(light_).doubts);
  EXPECT_EQ(loaded->bytes(), light_.bytes());
}

TEST_F(LightOperatorFile, BelongsToItsSceneSeedAndEffort) {
  light_.save(path_);
  EXPECT_FALSE(LightOperator::load(path_, world_, 2, little));
  EXPECT_FALSE(LightOperator::load(path_, world_, 1, coarse_operator));
  test::BareScene other = room_with_box();
  other.scene.labels[3].position.z += 0.01;
  const World changed(other.scene);
  EXPECT_FALSE(LightOperator::load(path_, changed, 1, little));
  test::BareScene without_units = room_with_box();
  without_units.scene.transceivers.pop_back();
  const World fewer(without_units.scene);
  EXPECT_TRUE(LightOperator::load(path_, fewer, 1, little));
}

TEST_F(LightOperatorFile, DetectsDamage) {
  light_.save(path_);
  const std::string whole = read_file(path_);
  const auto error_of = [&](const std::string& content) -> std::string {
    write_file(path_, content);
    try {
      LightOperator::load(path_, world_, 1, little);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  for (const double place : {0.05, 0.5, 0.99}) {
    std::string damaged = whole;
    damaged[static_cast<std::size_t>(place * static_cast<double>(whole.size()))] ^= 4;
    EXPECT_THAT(error_of(damaged), HasSubstr("is corrupt")) << place;
  }
  EXPECT_THAT(error_of(whole.substr(0, whole.size() / 2)), HasSubstr("is corrupt"));
  EXPECT_EQ(error_of(whole), "none");
}

// Whenever a process that saves is killed, a complete file remains.
TEST_F(LightOperatorFile, SurvivesAKilledWriter) {
  if (test::has_thread_sanitizer) GTEST_SKIP() << "no fork";
  light_.save(path_);
  for (int attempt = 0; attempt < 5; ++attempt) {
    const pid_t child = fork();
    if (child == 0)
      for (;;) light_.save(path_);
    std::this_thread::sleep_for(std::chrono::milliseconds(3 + 4 * attempt));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    ASSERT_TRUE(LightOperator::load(path_, world_, 1, little)) << attempt;
  }
}

TEST(LightOperator, CanBeCancelled) {
  const test::BareScene bare = room_with_box();
  const World world(bare.scene);
  CancelToken cancel;
  cancel.request();
  EXPECT_THROW(LightOperator(world, 1, {}, {.cancel = &cancel}), Interrupted);
}

}  // namespace
}  // namespace shelfbeam
