#include <gtest/gtest.h>

#include <chrono>

#include "discrepancy/reference_trial.h"

namespace pedicel::reference {
namespace {

plant::PlantFile stem(double length, double radius, double E, const Vec3& direction) {
  plant::PlantFile p;
  p.name = "stem";
  p.shape = plant::Shape::rest;
  p.material = {E, 0.35, 700.0, 0.0};
  p.connect = 0.005;
  p.distance = 0.02;
  plant::PlantCurve c;
  c.name = "stem";
  c.interpolation = plant::Interpolation::linear;
  c.points = {Vec3::Zero(), length * direction};
  c.radius = {radius};
  p.curves = {c};
  return p;
}

TEST(Reference, Speed) {
  Subject s{stem(0.6, 0.004, 5e8, Vec3::UnitZ()), {}, {}};
  s.plant.material.damping_time = 0.01;
  TrialPlan t;
  HoldPlan h;
  h.place = {"stem", 0.8, {}};
  h.path = {{0.0, 0.5}, {Vec3(0, 0, 0.48), Vec3(0.03, 0, 0.48)}, {}};
  h.release = 1.0;
  h.stiffness = 150;
  t.holds = {h};
  for (double dt : {0.01, 0.004, 0.002, 0.001, 0.0005}) {
    auto a = std::chrono::steady_clock::now();
    Record r = run_trial(s, t, {{"m", {"stem", 1.0, {}}}}, {0.012, dt});
    double sec = std::chrono::duration<double>(std::chrono::steady_clock::now() - a).count();
    std::printf("dt %g: %.3f s, %d, x %.9f %.9f %.9f\n", dt, sec, r.settled, r.markers(0, 0),
                r.markers(100, 0), r.markers(240, 0));
  }
}

}  // namespace
}  // namespace pedicel::reference
