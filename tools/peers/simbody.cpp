// Simbody: ball joints, O(n) recursion, explicit springs in a semi-explicit Euler step. Its
// implicit integrator (CPodes) factorises a dense Jacobian of all states and is out of the question
// at this size.
#include <Simbody.h>

#include <cmath>

#include "peer.h"

namespace {

using namespace peers;
using SimTK::MobilizedBody;
using SimTK::Vec3;

Vec3 tk(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

SimTK::Rotation tk(const Matrix3d& r) {
  return SimTK::Rotation(SimTK::Mat33(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0),
                                      r(2, 1), r(2, 2)));
}

struct Body {
  MobilizedBody::Ball ball;
  Element element;
};

struct Environment {
  double gravity = 0.0, drag = 0.0;  // m/s2, 1/s
};

// Springs of the joints, gravity, drag.
class Forces : public SimTK::Force::Custom::Implementation {
 public:
  Forces(const std::vector<std::vector<Body>>& plants, const Environment& environment)
      : plants_(plants), environment_(environment) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<Vec3>&, SimTK::Vector& mobility_forces) const override {
    for (const auto& plant : plants_)
      for (const Body& body : plant) {
        const SimTK::Vec4& q = body.ball.getQ(state);
        const Vec3 v(q[1], q[2], q[3]);
        const double sine = v.norm();
        const double share = sine > 1e-12 ? 2.0 * std::atan2(sine, q[0]) / sine : 2.0;
        for (int k = 0; k < 3; ++k)
          body.ball.applyOneMobilityForce(state, k, -body.element.stiffness[k] * share * v[k],
                                          mobility_forces);
        const Vec3 centre(0, 0, 0.5 * body.element.length);
        const Vec3 velocity = body.ball.findStationVelocityInGround(state, centre);
        body.ball.applyForceToBodyPoint(
            state, centre,
            body.element.mass * (Vec3(0, 0, -environment_.gravity) - environment_.drag * velocity),
            body_forces);
      }
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

 private:
  const std::vector<std::vector<Body>>& plants_;
  const Environment& environment_;
};

class SimbodyWorld : public World {
 public:
  SimbodyWorld(const std::vector<Plant>& plants, double dt) : integrator_(system_, dt), dt_(dt) {
    for (const Plant& plant : plants) {
      plants_.emplace_back();
      for (const Element& e : plant) {
        const Vec3 centre(0, 0, 0.5 * e.length);
        const SimTK::Body::Rigid body(SimTK::MassProperties(
            e.mass, centre, SimTK::Inertia(tk(e.inertia)).shiftFromMassCenter(centre, e.mass)));
        MobilizedBody& parent = e.parent < 0 ? static_cast<MobilizedBody&>(matter_.updGround())
                                             : plants_.back()[e.parent].ball;
        const SimTK::Transform joint(tk(e.frame_P), tk(e.start_P));
        plants_.back().push_back({MobilizedBody::Ball(parent, joint, body, SimTK::Transform()), e});
      }
    }
    SimTK::Force::Custom(force_subsystem_, new Forces(plants_, environment_));
    integrator_.setAllowInterpolation(false);
    system_.realizeTopology();
    integrator_.initialize(system_.getDefaultState());
  }
  void set_environment(double gravity, double drag) override { environment_ = {gravity, drag}; }
  void step() override { integrator_.stepTo(++steps_ * dt_); }
  Vector3d end(int plant, int element) const override {
    const SimTK::State& state = integrator_.getState();
    system_.realize(state, SimTK::Stage::Position);
    const Body& body = plants_[plant][element];
    const Vec3 x = body.ball.findStationLocationInGround(state, Vec3(0, 0, body.element.length));
    return {x[0], x[1], x[2]};
  }

 private:
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem force_subsystem_{system_};
  SimTK::SemiExplicitEulerIntegrator integrator_;
  Environment environment_;
  std::vector<std::vector<Body>> plants_;
  double dt_;  // s
  int steps_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, [](const std::vector<Plant>& plants, double dt) {
    return std::make_unique<SimbodyWorld>(plants, dt);
  });
}
