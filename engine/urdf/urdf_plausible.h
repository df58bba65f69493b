#pragma once

#include "engine/robot/description.h"
#include "engine/urdf/urdf_remarks.h"
#include "engine/urdf/urdf_xml.h"

namespace pedicel::robot {

/// Remarks on what no real robot has and a slip of units would give: masses, inertias, lengths,
/// meshes and angles that are out of proportion. Nothing is changed.
void remark_implausible(const UrdfXml& xml, const TiXmlElement& root, const RobotDescription& robot,
                        UrdfRemarks& remarks);

}  // namespace pedicel::robot
