#include "discrepancy/cause_names.h"

#include <map>

namespace pedicel::discrepancy {

Vanishes vanishing(const std::string& cause, const std::string& parameter) {
  static const std::map<std::string, Vanishes> by_parameter = {
      {"mass", Vanishes::at_zero},          {"gradient", Vanishes::at_zero},
      {"stiffness", Vanishes::at_infinity}, {"factor", Vanishes::at_one},
      {"coefficient", Vanishes::at_zero},   {"rate", Vanishes::at_zero},
      {"loss_factor", Vanishes::at_zero},   {"fraction", Vanishes::at_zero},
      {"drag_area", Vanishes::at_zero},     {"delay", Vanishes::at_zero},
      {"offset", Vanishes::at_zero},        {"rotation", Vanishes::at_zero},
      {"gain", Vanishes::at_one},           {"distance", Vanishes::at_zero}};
  if (parameter == "ratio") return cause == "anisotropy" ? Vanishes::at_one : Vanishes::at_zero;
  if (cause == "yield") return Vanishes::at_infinity;
  const auto found = by_parameter.find(parameter);
  return found == by_parameter.end() ? Vanishes::never : found->second;
}

const std::vector<std::pair<std::string, std::string>>& special_cases() {
  static const std::vector<std::pair<std::string, std::string>> pairs{
      {"leaf_drag", "wind"}, {"leaf_drag", "gust"}, {"wind", "gust"}};
  return pairs;
}

const std::vector<Limit>& limits() {
  static const std::vector<Limit> all{{"relaxation", "time", true, "creep"},
                                      {"creep", "time", false, "relaxation"},
                                      {"weak_segment", "length", false, "base_compliance"},
                                      {"weak_segment", "length", false, "attachment_compliance"}};
  return all;
}

std::string unit_of(const std::string& cause, const std::string& parameter) {
  static const std::map<std::string, std::string> units = {
      {"mass", "kg"},    {"rate", "1/s"},     {"time", "s"},           {"curvature", "1/m"},
      {"k0", "1/m"},     {"velocity", "m/s"}, {"drag_area", "m2/m"},   {"frequency", "Hz"},
      {"distance", "m"}, {"delay", "s"},      {"length", "m"},         {"rotation", "rad"},
      {"moment", "N m"}, {"heading", "rad"},  {"stiffness", "N m/rad"}};
  if (parameter == "stiffness" && cause == "grip_compliance") return "N/m";
  if (parameter == "offset") return cause == "force_gain" ? "N" : "m";
  const auto found = units.find(parameter);
  return found == units.end() ? "1" : found->second;
}

std::string plain_name(const std::string& cause) {
  static const std::map<std::string, std::string> names = {
      {"youngs_modulus", "another modulus"},
      {"density", "another density"},
      {"damping_time", "another internal damping"},
      {"extra_mass", "a mass that the model lacks"},
      {"mass_distribution", "mass spread otherwise along the curves"},
      {"base_compliance", "a root that turns elastically"},
      {"attachment_compliance", "a branch whose junction gives"},
      {"weak_segment", "a weak stretch"},
      {"stiffness_gradient", "a modulus that changes along the curves"},
      {"material_nonlinearity", "a material that is not linear"},
      {"anisotropy", "bending that is softer in one direction than across it"},
      {"mass_damping", "damping proportional to mass"},
      {"structural_damping", "damping that does not depend on the rate"},
      {"internal_friction", "friction inside the stem"},
      {"relaxation", "stress that relaxes"},
      {"creep", "slow creep"},
      {"yield", "bending that stays (yield)"},
      {"stiffness_drift", "a stiffness that drifts with the clock"},
      {"wind", "a steady wind"},
      {"gust", "a gusting wind"},
      {"leaf_drag", "air drag of the leaves"},
      {"grip_compliance", "a soft grip"},
      {"grip_slip", "a grip that slipped"},
      {"detachment_law", "another law of detachment"},
      {"latency", "markers that come late"},
      {"marker_offset", "a marker that sits elsewhere"},
      {"frame_rotation", "a measuring frame that is turned"},
      {"marker_scale", "a measuring scale that is off"},
      {"force_gain", "a force sensor that is off"},
      {"outliers", "samples that are wrong"}};
  const auto found = names.find(cause);
  return found == names.end() ? cause : found->second;
}

bool is_moment(const std::string& cause, const std::string& parameter) {
  return (cause == "latency" && parameter == "delay") ||
         (cause == "grip_slip" && parameter == "time");
}

bool same_family(const std::string& a, const std::string& b) {
  static const std::map<std::string, int> family = {{"mass_damping", 0},
                                                    {"structural_damping", 0},
                                                    {"internal_friction", 0},
                                                    {"relaxation", 0},
                                                    {"creep", 0},
                                                    {"extra_mass", 1},
                                                    {"mass_distribution", 1},
                                                    {"base_compliance", 2},
                                                    {"attachment_compliance", 2},
                                                    {"weak_segment", 2},
                                                    {"stiffness_gradient", 2},
                                                    {"anisotropy", 2},
                                                    {"material_nonlinearity", 3},
                                                    {"yield", 3},
                                                    {"wind", 4},
                                                    {"gust", 4},
                                                    {"leaf_drag", 4},
                                                    {"grip_compliance", 5},
                                                    {"grip_slip", 5},
                                                    {"force_gain", 5},
                                                    {"frame_rotation", 6},
                                                    {"marker_scale", 6},
                                                    {"marker_offset", 6}};
  if (a == b) return true;
  const auto of_a = family.find(a), of_b = family.find(b);
  return of_a != family.end() && of_b != family.end() && of_a->second == of_b->second;
}

}  // namespace pedicel::discrepancy
