#include "plugins/simulation/plants/plant_info.h"

namespace pedicel::simulation {

std::string worst_residual(const std::vector<PlantInfo>& plants) {
  const PlantInfo* worst = nullptr;
  for (const PlantInfo& plant : plants)
    if (plant.residual && (!worst || plant.residual->largest > worst->residual->largest))
      worst = &plant;
  return worst ? worst->residual_text : "";
}

}  // namespace pedicel::simulation
