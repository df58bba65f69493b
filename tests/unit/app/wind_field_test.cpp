// Wind over a scene: its mean, gusts that travel, shelter behind plants, and what it does to a
// stem.
#include "plugins/simulation/plants/wind_field.h"

#include <gmock/gmock.h>

#include <cmath>

#include "engine/core/random.h"
#include "tests/unit/app/contact_cases.h"

namespace pedicel::app {
namespace {

world::SceneWind gusty() {
  world::SceneWind wind;
  wind.velocity = Vec3(4, 0, 0);
  wind.intensity = 0.3;
  wind.length = 2.0;
  wind.rise = 0.0;
  return wind;
}

TEST(WindField, GustsHaveTheirIntensityAndTheMeanStays) {
  cosserat::RodSystem none{cosserat::RodSettings{}};
  Vec3 mean = Vec3::Zero(), squares = Vec3::Zero();
  int count = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const simulation::WindField field(gusty(), seed, none);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 v = field.velocity(Vec3(0.37 * i, 0.11 * i, 2.0 + 0.07 * i), 0.0) - Vec3(4, 0, 0);
      mean += v;
      squares += v.cwiseAbs2();
      ++count;
    }
  }
  EXPECT_LT((mean / count).norm(), 0.05 * 4.0);
  const double rms = std::sqrt(squares.sum() / 3.0 / count);
  EXPECT_NEAR(rms, 0.3 * 4.0, 0.1 * 0.3 * 4.0);
}

TEST(WindField, GustsTravelWithTheMeanWind) {
  cosserat::RodSystem none{cosserat::RodSettings{}};
  const simulation::WindField field(gusty(), 3, none);
  const Vec3 place(0.3, -0.2, 1.1);
  for (const double later : {0.1, 0.7, 3.0})
    EXPECT_LT(
        (field.velocity(place, 1.0) - field.velocity(place + later * gusty().velocity, 1.0 + later))
            .norm(),
        1e-9);
  EXPECT_GT((field.velocity(place, 1.0) - field.velocity(place, 1.5)).norm(), 1e-3);
}

// The same waves, drawn and added up one by one.
Vec3 plain_gusts(const world::SceneWind& wind, int seed, const Vec3& place, double time) {
  constexpr int waves = 24;
  constexpr double turn = 2.0 * 3.14159265358979323846;
  Random random(static_cast<std::uint64_t>(seed) + 1);
  Vec3 sum = Vec3::Zero();
  double energy = 0.0;
  for (int i = 0; i < waves; ++i) {
    const double scaled = std::pow(10.0, -0.5 + 1.5 * i / (waves - 1.0));
    Vec3 way(random.normal(), random.normal(), random.normal());
    Vec3 side(random.normal(), random.normal(), random.normal());
    way.normalize();
    side = way.cross(side).normalized();
    const double share = scaled * scaled / std::pow(1.0 + scaled * scaled, 11.0 / 6.0);
    const double phase = random.uniform(0.0, turn);
    const Vec3 carried = place - time * wind.velocity;
    sum +=
        std::sqrt(share) * std::cos(turn / wind.length * scaled * way.dot(carried) + phase) * side;
    energy += 0.5 * share / 3.0;
  }
  return wind.velocity.norm() * wind.intensity / std::sqrt(energy) * sum;
}

TEST(WindField, SumsItsWavesAsOneByOne) {
  cosserat::RodSystem none{cosserat::RodSettings{}};
  world::SceneWind wind = gusty();
  wind.roughness = 0.0;
  for (int seed = 0; seed < 20; ++seed) {
    const simulation::WindField field(wind, seed, none);
    Random random(seed);
    for (int i = 0; i < 200; ++i) {
      const Vec3 place(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(0, 3));
      const double time = random.uniform(0.0, 600.0);
      EXPECT_LT((field.velocity(place, time) - wind.velocity - plain_gusts(wind, seed, place, time))
                    .norm(),
                1e-10)
          << seed;
    }
  }
}

TEST(WindField, TheAirKeepsItsVolume) {
  cosserat::RodSystem none{cosserat::RodSettings{}};
  const simulation::WindField field(gusty(), 5, none);
  const double h = 1e-4;
  for (int i = 0; i < 20; ++i) {
    const Vec3 place(0.3 * i, 0.2 * i, 1.0 + 0.1 * i);
    double divergence = 0.0, size = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 slope = (field.velocity(place + h * Vec3::Unit(k), 0.0) -
                          field.velocity(place - h * Vec3::Unit(k), 0.0)) /
                         (2.0 * h);
      divergence += slope[k];
      size += slope.norm();
    }
    EXPECT_LT(std::abs(divergence), 1e-5 * size);
  }
}

TEST(WindField, TheMeanGrowsWithTheLogarithmOfTheHeight) {
  cosserat::RodSystem none{cosserat::RodSettings{}};
  world::SceneWind wind = gusty();
  wind.intensity = 0.0;
  wind.roughness = 0.1;
  const simulation::WindField field(wind, 0, none);
  EXPECT_NEAR(field.velocity(Vec3(1, 2, 2), 1.0).x(), 4.0, 1e-12);
  EXPECT_NEAR(field.velocity(Vec3(1, 2, 0.5), 1.0).x(), 4.0 * std::log(5.0) / std::log(20.0),
              1e-12);
  EXPECT_EQ(field.velocity(Vec3(1, 2, 0.05), 1.0).x(), 0.0);
}

// What three stems in a row take from each other, by hand.
TEST(WindField, StemsBehindEachOtherGetLess) {
  const SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0]", "[0, 0, 0.5]", 0.005, 1.0e9));
  const auto sim = files.simulation(
      "plants:\n  - {name: row, file: stem.plant.yaml, repeat: {count: [3, 1], spacing: [0.5, "
      "0.5]}}\n  - {name: beside, file: stem.plant.yaml, position: [0.5, 1, 0]}\n"
      "wind: {velocity: [3, 0, 0]}\n");
  world::SceneWind wind = gusty();
  const simulation::WindField field(wind, 0, sim->rods());
  const int middle = sim->rods().model(0).size() / 2;
  EXPECT_EQ(field.shelter(0, middle), 1.0);
  EXPECT_EQ(field.shelter(3, middle), 1.0);
  const double first = field.shelter(1, middle), second = field.shelter(2, middle);
  EXPECT_LT(second, first);
  // The part of a stem within 0.15 m above and below, 0.5 m upwind.
  const double drag = 1.1 * 0.01 * 0.3 * std::exp(-0.5 / 1.5);
  EXPECT_NEAR(first, std::exp(-0.5 * drag / (3.14159265 * 0.15 * 0.15)), 0.002);
}

// A vertical cantilever in a steady wind: q L^4 / (8 E I) at its tip, with q = 1/2 rho C d U^2.
TEST(WindField, AStemLeansAsABeamUnderItsDrag) {
  const SceneCase files;
  const double radius = 0.003, length = 0.5, modulus = 2.0e9, speed = 6.0;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0]", "[0, 0, 0.5]", radius, modulus));
  const auto sim = files.simulation(
      "plants:\n  - {name: stem, file: stem.plant.yaml}\ngravity: [0, 0, 0]\n"
      "wind: {velocity: [6, 0, 0]}\n");
  for (int i = 0; i < 1200; ++i) sim->step();
  const double load = 0.5 * 1.2 * 1.1 * 2.0 * radius * speed * speed;
  const double bending = modulus * 3.14159265 * std::pow(radius, 4) / 4.0;
  const double lean = load * std::pow(length, 4) / (8.0 * bending);
  EXPECT_NEAR(sim->rods().state(0).position.back().x(), lean, 0.03 * lean);
}

TEST(WindField, BladesAreExposedAsPlates) {
  cosserat::RodModel model;
  cosserat::add_element(model, -1, Vec3(0.1, 0, 0),
                        cosserat::circle_section(0.001, cosserat::Material{}));
  cosserat::add_element(model, 0, Vec3(0.2, 0, 0),
                        cosserat::circle_section(0.001, cosserat::Material{}));
  cosserat::add_element(model, 0, Vec3(0.1, 0.1, 0),
                        cosserat::circle_section(0.001, cosserat::Material{}));
  cosserat::finish(model);
  simulation::expose_to_wind(
      model, {simulation::Blade{simulation::BladeCorner{0, 0.0}, simulation::BladeCorner{1, 0.0},
                                simulation::BladeCorner{2, 0.0}}});
  // The triangle has 5e-3 m2, a third of it at each corner, over a length of 0.1 m.
  for (int e = 0; e < 3; ++e) {
    EXPECT_NEAR(model.air[e].plate_normal, 1.17 * 5e-3 / 3.0 / 0.1, 1e-12);
    const Vec3 normal = model.elements[e].drawn_rotation * model.air[e].plate;
    EXPECT_NEAR(std::abs(normal.z()), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace pedicel::app
