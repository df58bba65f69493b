#pragma once

#include <string>
#include <vector>

#include "app/session/document/document.h"

/// What a scene says of things by their names: the robot's program goes to a fruit, a load pulls
/// it, an expectation is about it, a camera follows it, a tie holds it, a cut takes it off.
namespace pedicel::app {

/// Names that the scene speaks of and the document has not (any more): "truss/fruit_5", "tray".
std::vector<std::string> broken_references(const Document& document);

/// Whether there is "PLANT/STEM" or "PLANT/FRUIT"; plants of a grid are NAME_0, NAME_1, ...
bool has_organ(const Document& document, const std::string& organ);

/// What speaks of a thing, for people: "the robot's program, 2 expectations"; empty: nothing. A
/// plant's name stands for its fruits, too.
std::string references_to(const Document& document, const std::string& name);

/// Takes what speaks of a thing out of the scene: the program as a whole, since its ways begin
/// where the one before ends; loads; expectations. A camera that followed it stands still, its
/// place as seen from the origin.
void clear_references(Document& document, const std::string& name);

enum class ThingKind { plant, body, camera };
/// Says a new name wherever the scene says the old one.
void rename_references(Document& document, ThingKind kind, const std::string& name,
                       const std::string& to);
/// The same of a plant's stem or fruit, in every plant of its grid.
void rename_organ_references(Document& document, const std::string& plant, const std::string& name,
                             const std::string& to);

}  // namespace pedicel::app
