#include "plugins/simulation/plants/wind_field.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/random.h"

namespace pedicel::simulation {

namespace {

constexpr double pi = 3.14159265358979323846;
// 1, drag coefficients: of a cylinder across the wind between Reynolds numbers of 1e3 and 1e5, of a
// plate across the wind and along it (Hoerner, Fluid-Dynamic Drag, 1965, chapters 3 and 2).
constexpr double cylinder_drag = 1.1, plate_drag = 1.17, plate_friction = 0.03;
// m: what stands within this of a line along the wind shelters what is behind, and over this way
// the wind recovers. About the width of a plant, and ten times that (wakes behind porous plates:
// Castro, J. Fluid Mech. 46, 1971).
constexpr double lane_radius = 0.15, recovery = 1.5;

// The nearest whole number, where that is below 2^51: adding this leaves no bits behind the point.
// Unlike std::round() it is done for several numbers at once.
double nearest_whole(double x) {
  constexpr double no_fraction = 6755399441055744.0;  // 1.5 * 2^52
  return (x + no_fraction) - no_fraction;
}

// cos(2 pi x) within 3e-15: a quarter turn on it is a sine, by its series.
double cosine_of_turns(double x) {
  const double y = 2.0 * pi * (0.25 - std::abs(x - nearest_whole(x)));  // -pi/2 to pi/2
  const double z = y * y;
  double series = -1.0 / 121645100408832000.0;
  series = 1.0 / 355687428096000.0 + z * series;
  series = -1.0 / 1307674368000.0 + z * series;
  series = 1.0 / 6227020800.0 + z * series;
  series = -1.0 / 39916800.0 + z * series;
  series = 1.0 / 362880.0 + z * series;
  series = -1.0 / 5040.0 + z * series;
  series = 1.0 / 120.0 + z * series;
  series = -1.0 / 6.0 + z * series;
  return y + y * z * series;
}

double area_of(const cosserat::RodModel& model, const Blade& blade, Vec3& normal_W) {
  std::array<Vec3, 3> corner;
  for (int i = 0; i < 3; ++i) {
    const cosserat::Element& element = model.elements[blade[i].element];
    corner[i] = element.drawn_position - blade[i].back * (element.drawn_rotation * Vec3::UnitZ());
  }
  const Vec3 twice = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  normal_W = twice.normalized();
  return 0.5 * twice.norm();
}

// m2, with the drag coefficient, against wind of a direction.
double drag_against(const cosserat::RodModel& model, int e, const Vec3& along) {
  const cosserat::SegmentAir& air = model.air[e];
  const cosserat::Element& element = model.elements[e];
  const Vec3 axis = element.drawn_rotation * Vec3::UnitZ();
  double area = air.drag_area * (along - axis * axis.dot(along)).norm();
  if (air.has_plate()) {
    const double facing = std::abs(along.dot(element.drawn_rotation * air.plate));
    area += air.plate_normal * facing + air.plate_tangential * (1.0 - facing);
  }
  return area * element.length;
}

}  // namespace

void expose_to_wind(cosserat::RodModel& model, const std::vector<Blade>& blades) {
  model.air.resize(model.elements.size());
  for (int e = 0; e < model.size(); ++e) {
    const cosserat::Element& element = model.elements[e];
    if (model.air[e].drag_area == 0.0)
      model.air[e].drag_area = cylinder_drag * (element.radius_near + element.radius_far);
  }
  // A third of each triangle's area stands at each of its corners; the plate of a segment faces
  // where its triangles do on average.
  std::map<int, Vec3> faces;  // m2, W
  std::map<int, double> areas;
  for (const Blade& blade : blades) {
    Vec3 normal_W;
    const double third = area_of(model, blade, normal_W) / 3.0;
    for (const BladeCorner& corner : blade) {
      Vec3& face = faces.try_emplace(corner.element, Vec3::Zero()).first->second;
      face += (face.dot(normal_W) < 0.0 ? -third : third) * normal_W;
      areas[corner.element] += third;
    }
  }
  for (const auto& [e, area] : areas) {
    cosserat::SegmentAir& air = model.air[e];
    if (air.has_plate() || faces[e].isZero(0.0)) continue;
    const double width = area / model.elements[e].length;
    air.plate_normal = plate_drag * width;
    air.plate_tangential = plate_friction * width;
    air.plate = model.elements[e].drawn_rotation.conjugate() * faces[e].normalized();
  }
}

WindField::WindField(const world::SceneWind& wind, int seed, cosserat::RodSystem& rods)
    : wind_(wind), rods_(rods) {
  if (wind_.intensity > 0.0) draw_gusts(seed);
  for (int p = 0; p < rods_.size(); ++p) {
    shelter_.emplace_back(rods_.model(p).size(), 1.0);
    rods_.air(p).assign(rods_.model(p).size(), Vec3::Zero());
  }
  if (wind_.shelter) find_shelter();
}

// Waves whose lengths are spread evenly in the logarithm about that of the gusts, in all
// directions, each across its own way, so that the air keeps its volume (Kraichnan, Physics of
// Fluids 13, 1970). Their energy falls with the 5/3rd power of the wave number, as in von Karman's
// spectrum.
void WindField::draw_gusts(int seed) {
  Random random(static_cast<std::uint64_t>(seed) + 1);
  double energy = 0.0;
  for (int i = 0; i < waves; ++i) {
    const double number = 2.0 * pi / wind_.length * std::pow(10.0, -0.5 + 1.5 * i / (waves - 1.0));
    const double scaled = number * wind_.length / (2.0 * pi);
    Vec3 way(random.normal(), random.normal(), random.normal());
    Vec3 side(random.normal(), random.normal(), random.normal());
    way.normalize();
    side = way.cross(side).normalized();
    // Number times spectrum: what a step of the logarithm holds.
    const double share = scaled * scaled / std::pow(1.0 + scaled * scaled, 11.0 / 6.0);
    for (int k = 0; k < 3; ++k) {
      number_[k][i] = number * way[k] / (2.0 * pi);
      amplitude_[k][i] = std::sqrt(share) * side[k];
    }
    phase_[i] = random.uniform(0.0, 2.0 * pi) / (2.0 * pi);
    energy += 0.5 * share / 3.0;  // in one direction
  }
  for (Waves& amplitudes : amplitude_)
    for (double& amplitude : amplitudes) amplitude *= wind_.intensity / std::sqrt(energy);
}

// Frozen turbulence (Taylor, Proc. R. Soc. A 164, 1938): gusts travel with the mean wind.
WindField::Waves WindField::turns_at(double time) const {
  Waves turns;
  const Vec3 way = time * wind_.velocity;
  for (int i = 0; i < waves; ++i) {
    const double there =
        phase_[i] - (number_[0][i] * way.x() + number_[1][i] * way.y() + number_[2][i] * way.z());
    turns[i] = there - nearest_whole(there);
  }
  return turns;
}

Vec3 WindField::velocity(const Vec3& place, double time) const {
  return velocity(place, time, turns_at(time));
}

Vec3 WindField::velocity(const Vec3& place, double time, const Waves& turns) const {
  double profile = 1.0;
  if (wind_.roughness > 0.0)
    profile = std::max(0.0, std::log(std::max(place.z(), wind_.roughness) / wind_.roughness) /
                                std::log(wind_.height / wind_.roughness));
  const double speed = wind_.velocity.norm();
  Vec3 relative = wind_.velocity / speed;
  if (wind_.intensity > 0.0) {
    Waves cosine;
    for (int i = 0; i < waves; ++i)
      cosine[i] = cosine_of_turns(turns[i] + number_[0][i] * place.x() + number_[1][i] * place.y() +
                                  number_[2][i] * place.z());
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < waves; ++i) relative[k] += cosine[i] * amplitude_[k][i];
  }
  const double grown = wind_.rise > 0.0 ? std::min(1.0, time / wind_.rise) : 1.0;
  return grown * profile * speed * relative;
}

// What stands in a lane of cross-section S takes momentum out of it: of the speed a drag area C A
// leaves exp(-C A / (2 S)), and the rest recovers along the way.
void WindField::find_shelter() {
  struct Obstacle {
    int plant;
    double along, drag;  // m, m2
    Vec3 across;         // m
  };
  const Vec3 along = wind_.velocity.normalized();
  std::map<std::pair<long, long>, std::vector<Obstacle>> cells;  // of the plane across the wind
  const Vec3 side = along.unitOrthogonal(), up = along.cross(side);
  const auto cell_of = [&](const Vec3& place) {
    return std::pair(std::lround(place.dot(side) / lane_radius),
                     std::lround(place.dot(up) / lane_radius));
  };
  for (int p = 0; p < rods_.size(); ++p)
    for (int e = 0; e < rods_.model(p).size(); ++e) {
      const Vec3& place = rods_.model(p).elements[e].drawn_position;
      cells[cell_of(place)].push_back({p, place.dot(along), drag_against(rods_.model(p), e, along),
                                       place - place.dot(along) * along});
    }
  const double section = pi * lane_radius * lane_radius;
  for (int p = 0; p < rods_.size(); ++p)
    for (int e = 0; e < rods_.model(p).size(); ++e) {
      const Vec3& place = rods_.model(p).elements[e].drawn_position;
      const double here = place.dot(along);
      const Vec3 across = place - here * along;
      double drag = 0.0;
      for (long i = -1; i <= 1; ++i)
        for (long j = -1; j <= 1; ++j) {
          const auto [a, b] = cell_of(place);
          const auto found = cells.find({a + i, b + j});
          if (found == cells.end()) continue;
          for (const Obstacle& one : found->second)
            if (one.plant != p && one.along < here && (one.across - across).norm() < lane_radius)
              drag += one.drag * std::exp((one.along - here) / recovery);
        }
      shelter_[p][e] = std::exp(-0.5 * drag / section);
    }
}

void WindField::act(world::SimWorld& world, world::WorldReport&) {
  // The step that begins is solved at its end.
  const double time = world.time() + world.dt();
  const Waves turns = turns_at(time);
  rods_.each_plant([&](int p) {
    const cosserat::RodState& state = rods_.state(p);
    std::vector<Vec3>& air = rods_.air(p);
    for (int e = 0; e < state.size(); ++e)
      air[e] = shelter_[p][e] * velocity(state.position[e], time, turns);
  });
}

}  // namespace pedicel::simulation
