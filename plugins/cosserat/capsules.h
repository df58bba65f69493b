#pragma once

#include <array>
#include <vector>

#include "core/frames.h"
#include "cosserat/parted_loop.h"

namespace pedicel::cosserat {

/// Where two straight axes are nearest: fractions along them, 0 at the near end.
struct NearestFractions {
  double a = 0.5, b = 0.5;
};

/// Minimises |a(s) - b(t)|^2 + e ((s - 1/2)^2 + (t - 1/2)^2) over the unit square, with e = 1e-4
/// times the longer axis' length squared: unique and continuous also for parallel axes, where the
/// bare distance would throw the place from one end to the other. The second term costs at most e/2
/// in distance squared. An axis may be a point. Lengths in m, any frame.
NearestFractions nearest_fractions(const Vec3& start_a, const Vec3& along_a, const Vec3& start_b,
                                   const Vec3& along_b);

/// Capsules (or cones with round ends, or spheres), a structure of arrays: the ends of the axes and
/// the radii there, linear in between.
struct Capsules {
  std::array<std::vector<double>, 3> near, far;  // m, W
  std::vector<double> radius_near, radius_far;   // m

  void resize(std::size_t count);
  std::size_t size() const { return radius_near.size(); }
  Vec3 near_at(int i) const { return {near[0][i], near[1][i], near[2][i]}; }
  Vec3 far_at(int i) const { return {far[0][i], far[1][i], far[2][i]}; }
};

/// Pairs of capsules and, once measured, where their axes are nearest and the gap there.
struct CapsulePairs {
  std::vector<int> a, b;
  std::vector<double> at_a, at_b;  // fractions along the axes
  std::vector<double> gap;         // m, negative where they overlap

  std::size_t size() const { return a.size(); }
  void clear();
  void resize(std::size_t count);
  void add(int first, int second);
  void add(const CapsulePairs& from, std::size_t pair);  // measured: with the gap
  void append(const CapsulePairs& measured);             // likewise
};

/// Sets at_a, at_b and gap of all pairs, several at a time: nearest_fractions() up to rounding.
void measure(const Capsules& capsules, CapsulePairs& pairs, const PartedLoop& loop = {});

/// Makes `kept` those of the measured pairs whose gap is not above `open` + reach[a] + reach[b]
/// (m), in their order, with their gaps.
void sift(const CapsulePairs& from, double open, const std::vector<double>& reach,
          CapsulePairs& kept);

}  // namespace pedicel::cosserat
