#pragma once

#include "engine/core/frames.h"

namespace pedicel::discrepancy {

/// How an input changes over an interval: x'(s) = constant + linear s + square s^2, s from its
/// beginning.
struct LagInput {
  Vec3 constant = Vec3::Zero();
  Vec3 linear = Vec3::Zero();
  Vec3 square = Vec3::Zero();
};

/// An instrument y' = (x - y) / time (s, > 0) is behind its input by b = x - y, b' = x' - b / time.
/// `before` is b at an interval's beginning; returns b at s (s, >= 0) after it, exactly.
Vec3 lag_behind(const Vec3& before, double time, double s, const LagInput& input);

}  // namespace pedicel::discrepancy
