#include <cmath>

#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/plant_edit_parts.h"

namespace pedicel::plant {

namespace {

/// The place of a fraction of a curve, m.
Vec3 place_on(const PlantFile& plant, int curve, double at) {
  const geometry::Curve drawn = stem_curve(plant, plant.curves[curve].name);
  return drawn.point(at * drawn.length());
}

std::vector<int> with_branches(const std::vector<StemJoint>& tree, int stem) {
  std::vector<int> all = {stem};
  for (const int branch : branches_of(tree, stem)) all.push_back(branch);
  return all;
}

template <typename Item>
void copy_items(PlantFile& plant, std::vector<Item>& items, const std::string& from,
                const std::string& to, const std::function<void(Item&)>& change) {
  const std::size_t count = items.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (items[i].place.curve != from) continue;
    Item copy = items[i];
    copy.place.curve = to;
    if (change) change(copy);
    if constexpr (requires { copy.name; }) copy.name = free_name(plant, copy.name);
    items.push_back(std::move(copy));
  }
}

void copy_organs(PlantFile& plant, const std::string& from, const std::string& to,
                 const Mat3& turn) {
  copy_items<PlantFruit>(plant, plant.fruits, from, to, {});
  copy_items<PlantMass>(plant, plant.masses, from, to, {});
  copy_items<PlantLeaf>(plant, plant.leaves, from, to, [&](PlantLeaf& leaf) {
    leaf.normal = turn * leaf.normal;
    if (leaf.direction) leaf.direction = turn * *leaf.direction;
  });
}

Eigen::Affine3d reflection(const Vec3& point, const Vec3& normal) {
  const Vec3 n = normal.normalized();
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.linear() = Mat3::Identity() - 2.0 * n * n.transpose();
  motion.translation() = point - motion.linear() * point;
  return motion;
}

/// The direction of a stem from its foot, without the part along its parent.
Vec3 direction_across(const PlantFile& plant, int stem, const StemJoint& joint) {
  const PlantCurve& curve = plant.curves[stem];
  const Vec3 foot = joint.foot_first ? curve.points.front() : curve.points.back();
  const Vec3 tip = joint.foot_first ? curve.points.back() : curve.points.front();
  Vec3 along = Vec3::UnitZ();
  if (joint.parent >= 0) {
    const geometry::Curve parent = stem_curve(plant, plant.curves[joint.parent].name);
    along = parent.tangent(joint.parent_at * parent.length());
  }
  const Vec3 way = tip - foot;
  return way - along.dot(way) * along;
}

}  // namespace

void check_fraction(double at) {
  if (!(at >= 0.0 && at <= 1.0))
    throw UsageError("at = " + io::format_number(at) + ", expected a fraction from 0 to 1");
}

BranchesFollow::BranchesFollow(const PlantFile& plant, int stem) : stem_(stem) {
  const std::vector<StemJoint> tree = stem_tree(plant);
  for (std::size_t c = 0; c < tree.size(); ++c) {
    if (!tree[c].joined || tree[c].parent != stem) continue;
    const int curve = static_cast<int>(c);
    branches_.push_back({curve, tree[c].parent_at, place_on(plant, stem, tree[c].parent_at),
                         with_branches(tree, curve)});
  }
}

void BranchesFollow::move(PlantFile& plant) const {
  for (const Branch& branch : branches_) {
    const Vec3 by = place_on(plant, stem_, branch.at) - branch.place;
    if (by.norm() < 1.0e-12) continue;
    for (const int curve : branch.with)
      for (Vec3& point : plant.curves[curve].points) point += by;
  }
}

void copy_stems(PlantFile& plant, const std::vector<int>& curves, const std::string& name,
                const Eigen::Affine3d& motion) {
  check_free(plant, name);
  for (const int index : curves) {
    const PlantCurve original = plant.curves[index];
    PlantCurve copy = original;
    copy.name = index == curves.front() ? name : free_name(plant, original.name);
    for (Vec3& point : copy.points) point = motion * point;
    copy.section.normal = motion.linear() * original.section.normal;
    const std::string copied = copy.name;
    plant.curves.push_back(std::move(copy));
    copy_organs(plant, original.name, copied, motion.linear());
  }
}

std::string mirror_stem(PlantFile& plant, const std::string& stem, const std::string& name,
                        const Vec3& normal) {
  const int index = find_stem(plant, stem);
  const std::vector<StemJoint> tree = stem_tree(plant);
  const StemJoint& joint = tree[index];
  const PlantCurve& curve = plant.curves[index];
  const Vec3 foot = joint.parent >= 0  ? place_on(plant, joint.parent, joint.parent_at)
                    : joint.foot_first ? curve.points.front()
                                       : curve.points.back();
  const Vec3 across = normal.norm() > 0.0 ? normal : direction_across(plant, index, joint);
  if (across.norm() < smallest_gap)
    throw UsageError(stem + " runs along its parent, expected a normal to mirror it by");
  const std::string copy = name.empty() ? free_name(plant, stem) : name;
  copy_stems(plant, with_branches(tree, index), copy, reflection(foot, across));
  return copy;
}

void repeat_stem(PlantFile& plant, const std::string& stem, int count, double spacing,
                 double angle) {
  const int index = find_stem(plant, stem);
  const std::vector<StemJoint> tree = stem_tree(plant);
  const StemJoint& joint = tree[index];
  if (joint.parent < 0) throw UsageError(stem + " has no parent, expected a branch to repeat");
  if (count < 1 || count > 1000)
    throw UsageError(std::to_string(count) + " copies, expected 1 to 1000");
  const geometry::Curve parent = stem_curve(plant, plant.curves[joint.parent].name);
  const double arc = joint.parent_at * parent.length(), last = arc + count * spacing;
  if (last < 0.0 || last > parent.length())
    throw UsageError("the last copy would be " + io::format_number(last, 4) +
                     " m along the parent, expected at most " +
                     io::format_number(parent.length(), 4) + " m");
  const std::vector<int> all = with_branches(tree, index);
  const Vec3 foot = parent.point(arc), along = parent.tangent(arc);
  for (int i = 1; i <= count; ++i) {
    const Vec3 tangent = parent.tangent(arc + i * spacing);
    Eigen::Affine3d motion = Eigen::Translation3d(parent.point(arc + i * spacing)) *
                             Eigen::AngleAxisd(i * angle, tangent) *
                             Quat::FromTwoVectors(along, tangent) * Eigen::Translation3d(-foot);
    copy_stems(plant, all, free_name(plant, stem), motion);
  }
}

}  // namespace pedicel::plant
