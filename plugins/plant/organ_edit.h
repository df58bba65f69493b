#pragma once

#include <string>

#include "plugins/plant/plant_file.h"

/// Fruits, leaves, masses and supports of a plant as it is drawn; see plant_edit.h for what all
/// edits have in common.
namespace pedicel::plant {

void add_fruit(PlantFile& plant, PlantFruit fruit);
void add_leaf(PlantFile& plant, PlantLeaf leaf);
/// A fruit or a leaf.
void remove_organ(PlantFile& plant, const std::string& name);
/// Along its stem, or to another one.
void place_organ(PlantFile& plant, const std::string& name, const std::string& stem, double at);

/// A number of a fruit: radius (m), density (kg/m3), stretch (1), bend (rad), force (N), moment,
/// torsion (N m); of a leaf: size (m). Thresholds of 0 are taken away: the fruit never comes off
/// for that cause.
void set_organ(PlantFile& plant, const std::string& name, const std::string& key, double value);
/// The way a leaf's upper face looks, and its midrib points (zero: as it grows by itself).
void turn_leaf(PlantFile& plant, const std::string& name, const Vec3& normal,
               const Vec3& direction);

void add_mass(PlantFile& plant, const std::string& stem, double at, double mass);
void add_support(PlantFile& plant, const std::string& stem, double at);
/// By their numbers in the file, from 0.
void remove_mass(PlantFile& plant, int index);
void remove_support(PlantFile& plant, int index);

/// A number of a stem's material (youngs_modulus, poisson_ratio, density, damping_time), of the
/// plant's with an empty name. A stem's own is taken away with 0 where 0 is no value.
void set_material(PlantFile& plant, const std::string& stem, const std::string& key, double value);
/// connect or distance, m.
void set_sampling(PlantFile& plant, const std::string& key, double value);

}  // namespace pedicel::plant
