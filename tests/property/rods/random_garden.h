#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/random.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::plain {

/// Some plants in one system, with everything that happens to them; all of it follows from a seed.
struct Garden {
  struct Plant {
    std::string shape;  ///< "comb of 312"
    cosserat::RodModel model;
    cosserat::RodState start;  ///< bent, moving, perhaps with parts that are off
    std::vector<cosserat::Load> loads;
    bool self_contact = false;
    Pose clamp_motion;  ///< m and rotation of its clamp, a step
  };
  std::uint64_t seed = 0;
  std::vector<Plant> plants;
  cosserat::RodSettings settings;
  double dt = 0.0;  ///< s
  Vec3 gravity = Vec3::Zero();
  int steps = 1;

  int elements() const;
};

/// `most` bounds the number of elements (1 to 20,000).
Garden draw_garden(std::uint64_t seed, int most = 20000);

/// One line that says what it is.
std::string describe(const Garden& garden);

/// Parents of the elements of a random tree, -1 at a clamp, each before its children.
struct Shape {
  std::string name;
  std::vector<int> parents;
  std::vector<int> organs = {};
  bool leafy = false;  ///< leaves come on top, whose rims close loops
};
Shape draw_shape(Random& random, int elements);

}  // namespace pedicel::plain
