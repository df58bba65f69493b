#include "plugins/plant/model/rod_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::plant {

PlacedPoint RodPlaces::locate(int curve, double at) const {
  const double arc = at * curve_lengths[curve];
  PlacedPoint best;
  double missed = std::numeric_limits<double>::infinity();
  for (const Span& span : spans) {
    if (span.curve != curve) continue;
    const double t = std::clamp((arc - span.arc_near) / (span.arc_far - span.arc_near), 0.0, 1.0);
    const double off = std::abs(span.arc_near + t * (span.arc_far - span.arc_near) - arc);
    if (off >= missed) continue;
    missed = off;
    best = {span.element, (1.0 - t) * span.length};
  }
  return best;
}

}  // namespace pedicel::plant
