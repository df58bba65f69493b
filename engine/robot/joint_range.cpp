#include "engine/robot/joint_range.h"

#include <cmath>
#include <numbers>

#include "engine/io/csv.h"

namespace pedicel::robot {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double millimetre = 1e-3;

/// "degrees? 90 degrees are 1.571 rad"
std::string other_unit(const KinematicModel& model, int dof, double value) {
  const bool slides = model.joint_type(dof) == JointType::prismatic;
  const double meant = value * (slides ? millimetre : degree);
  if (meant < model.lower()[dof] || meant > model.upper()[dof]) return "";
  const std::string unit = slides ? "millimetres" : "degrees";
  return "; " + unit + "? " + io::format_number(value, 4) + " " + unit + " are " +
         io::format_number(meant, 4) + (slides ? " m" : " rad");
}

}  // namespace

std::optional<std::string> outside_range(const KinematicModel& model, int dof, double value,
                                         double slack) {
  const double low = model.lower()[dof], high = model.upper()[dof];
  if (value >= low - slack && value <= high + slack) return {};
  return model.joint_names()[static_cast<std::size_t>(dof)] + " = " + io::format_number(value) +
         ", expected " + io::format_number(low) + " to " + io::format_number(high) +
         (model.joint_type(dof) == JointType::prismatic ? " m" : " rad") +
         other_unit(model, dof, value);
}

std::optional<std::string> many_turns(const KinematicModel& model, int dof, double value) {
  constexpr double turn = 2.0 * std::numbers::pi;
  if (model.joint_type(dof) == JointType::prismatic || std::abs(value) < 2.0 * turn) return {};
  if (std::isfinite(model.lower()[dof]) && std::isfinite(model.upper()[dof])) return {};
  return model.joint_names()[static_cast<std::size_t>(dof)] + " = " + io::format_number(value) +
         " rad are " + io::format_number(std::abs(value) / turn, 3) + " turns" +
         other_unit(model, dof, value);
}

}  // namespace pedicel::robot
