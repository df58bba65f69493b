#include "plugins/simulation/followed_program.h"

#include <cmath>

namespace pedicel::simulation {

const robot::Trajectory& FollowedProgram::part_at(double world_time) const {
  // The way to the lap is gone once; only the lap comes again.
  const bool leads = lap_.empty() || world_time - start_ <= lead_.duration();
  return leads ? lead_ : lap_;
}

double FollowedProgram::time(double world_time) const {
  const double time = world_time - start_;
  if (&part_at(world_time) == &lead_) return time;
  // The lap ends where it begins, so that the jump in time is none in place.
  return std::fmod(time - lead_.duration(), lap_.duration());
}

void FollowedProgram::sample(double world_time, Eigen::VectorXd& q, Eigen::VectorXd& qd) const {
  part_at(world_time).sample(time(world_time), q, qd);
}

void FollowedProgram::sample_end(Eigen::VectorXd& q, Eigen::VectorXd& qd) const {
  const robot::Trajectory& last = lap_.empty() ? lead_ : lap_;
  last.sample(last.duration(), q, qd);
}

}  // namespace pedicel::simulation
