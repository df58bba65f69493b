#include "plugins/plant/model/plant_model.h"

namespace pedicel::plant {

int PlantFile::curve_index(const std::string& curve) const {
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (curves[i].name == curve) return static_cast<int>(i);
  return -1;
}

}  // namespace pedicel::plant
