#include "plugins/effects/registry/effect_start.h"

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

Start::Start(std::string name) {
  effect_.name = std::move(name);
}

Start& Start::parameter(const std::string& name, int component, bool logarithmic, double scale,
                        double low, double high) {
  FreeParameter free;
  free.name = name;
  free.component = component;
  free.logarithmic = logarithmic;
  free.scale = scale;
  free.low = low;
  free.high = high;
  free.unit = unit_of(effect_.name, name);
  if (const EffectParameter* described = find_parameter(effect_.name, name))
    free.vanishes = described->vanishes;
  free_.push_back(free);
  return *this;
}

}  // namespace pedicel::effects
