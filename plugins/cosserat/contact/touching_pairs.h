#pragma once

#include <cstdint>

#include "plugins/cosserat/contact/capsules.h"
#include "plugins/cosserat/lanes/lanes.h"
#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

/// Eight measured pairs of a plant's capsules a and b, and how they touch.
struct alignas(64) TouchingRow {
  int a[lane_count] = {}, b[lane_count] = {};
  std::int64_t element_a[lane_count] = {}, element_b[lane_count] = {};
  Lanes at_a, at_b;      // 1, as measured
  Lanes back_a, back_b;  // m, of these places
  // Set by touch().
  Lanes radius_a, radius_b;  // m, there
  Lanes normal[3];           // unit, W, from b to a
  Lanes gap;                 // m
  Lanes motion[3];           // m, W, over the step, of the middle between the surfaces
  Lanes apart;               // m, how far the surfaces moved against each other
};

/// What touches how, with the capsules where they were and are and the plant's states there. Axes
/// that went through each other since are still on their own sides.
void touch(const Capsules& were, const Capsules& are, const RodState& start, const RodState& state,
           TouchingRow& row);

}  // namespace pedicel::cosserat
