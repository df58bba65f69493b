#include "engine/robot/description.h"

namespace pedicel::robot {

namespace {

template <class Items>
int index_of(const Items& items, const std::string& name) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace

int RobotDescription::link(const std::string& link_name) const {
  return index_of(links, link_name);
}

int RobotDescription::joint(const std::string& joint_name) const {
  return index_of(joints, joint_name);
}

}  // namespace pedicel::robot
