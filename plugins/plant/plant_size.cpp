#include "plugins/plant/plant_size.h"

#include <algorithm>
#include <limits>

#include "engine/io/csv.h"

namespace pedicel::plant {

namespace {

constexpr double tallest = 100.0;  ///< m

std::string length_text(double metres) {
  return metres < 0.1 ? io::format_number(1000.0 * metres, 3) + " mm"
                      : io::format_number(metres, 3) + " m";
}

}  // namespace

PlantSize size_of(const PlantFile& plant) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low = Vec3::Constant(infinity), high = -low;
  PlantSize size;
  size.thinnest = infinity;
  for (const PlantCurve& curve : plant.curves) {
    for (const Vec3& point : curve.points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    std::vector<double> widths;
    for (const double radius : curve.radius) widths.push_back(2.0 * radius);
    if (curve.section.kind == SectionKind::rectangle) widths = {curve.section.height};
    for (const double width : widths) {
      size.thinnest = std::min(size.thinnest, width);
      size.thickest = std::max(size.thickest, width);
    }
  }
  if (!(low.x() <= high.x())) return {};
  size.height = high.z() - low.z();
  size.extent = (high - low).maxCoeff();
  if (size.thickest == 0.0) size.thinnest = 0.0;
  return size;
}

std::string size_text(const PlantFile& plant, std::size_t nodes) {
  return length_text(size_of(plant).height) + " tall, " + std::to_string(nodes) +
         (nodes == 1 ? " node" : " nodes");
}

std::string size_doubt(const PlantFile& plant) {
  constexpr double slender = 1000.0;
  const PlantSize size = size_of(plant);
  if (size.extent < slender * size.thickest && size.extent < tallest) return {};
  return " (it is " + length_text(size.extent) + " large and at most " +
         length_text(size.thickest) + " thick: is its unit right?)";
}

void warn_of_size(const PlantFile& plant, Diagnostics& diagnostics) {
  const PlantSize size = size_of(plant);
  const std::string name = "plant \"" + plant.name + "\" is ";
  if (size.extent > tallest)
    diagnostics.warning(plant.where, name + length_text(size.extent) +
                                         " large, expected at most 100 m: are its lengths in mm or "
                                         "cm?");
  else if (size.extent > 0.0 && size.extent < size.thinnest)
    diagnostics.warning(plant.where, name + length_text(size.extent) +
                                         " large and its thinnest stem " +
                                         length_text(size.thinnest) +
                                         " thick, expected a larger plant: are its lengths in m or "
                                         "cm?");
}

}  // namespace pedicel::plant
