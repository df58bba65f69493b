#include "plugins/cosserat/contact/contact_drive.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pedicel::cosserat {

namespace {

constexpr int most_steps = 100;  // halving alone needs some 60

// d load / d position.
double slope_at(const ContactDrive& drive, std::span<const DriveLoad> loads, double position) {
  double slope = 0.0;
  for (const DriveLoad& load : loads)
    if (load.overlap + load.lever * (position - drive.reference) > 0.0)
      slope += load.lever * load.lever * load.stiffness;
  return slope;
}

// Where the load is `force`, between two positions that have it between them: Newton's method on a
// piecewise linear function that rises, kept in by halving.
double balance(const ContactDrive& drive, std::span<const DriveLoad> loads, double force,
               double low, double high) {
  double position = 0.5 * (low + high);
  for (int i = 0; i < most_steps && low < high; ++i) {
    const double excess = load_at(drive, loads, position) - force;
    if (excess == 0.0) return position;
    (excess > 0.0 ? high : low) = position;
    const double slope = slope_at(drive, loads, position);
    const double next = slope > 0.0 ? position - excess / slope : low - 1.0;
    const double halved = 0.5 * (low + high);
    const double taken = next > low && next < high ? next : halved;
    if (taken == position) return position;
    position = taken;
  }
  return position;
}

}  // namespace

double ContactDrive::force_above(double position) const {
  if (aim >= start) {
    if (position < start) return hold;
    return position < aim ? press : -hold;
  }
  if (position < aim) return hold;
  return position < start ? -press : -hold;
}

double load_at(const ContactDrive& drive, std::span<const DriveLoad> loads, double position) {
  double sum = 0.0;
  for (const DriveLoad& load : loads)
    sum += load.lever * load.stiffness *
           std::max(0.0, load.overlap + load.lever * (position - drive.reference));
  return sum;
}

// The drive's force falls with the position in steps, at the start and at the aim, and the load
// rises: they meet once.
double stand(const ContactDrive& drive, std::span<const DriveLoad> loads) {
  const auto inside = [&](double position) {
    return std::clamp(position, drive.lower, drive.upper);
  };
  const double start = inside(drive.start), aim = inside(drive.aim);
  const std::array<double, 4> ends = {drive.lower, std::min(start, aim), std::max(start, aim),
                                      drive.upper};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double low = ends[i], high = ends[i + 1];
    if (!(low < high)) continue;
    const double force = drive.force_above(0.5 * (low + high));
    if (load_at(drive, loads, low) >= force) return low;
    if (load_at(drive, loads, high) > force) return balance(drive, loads, force, low, high);
  }
  return drive.upper;
}

}  // namespace pedicel::cosserat
