#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/frames.h"
#include "plugins/cosserat/contact/capsules.h"
#include "plugins/cosserat/lanes/parted_loop.h"

namespace pedicel::cosserat {

/// Pairs of boxes that overlap, where most boxes lie beside those with the numbers next to theirs,
/// as those along a branch do: eight that follow each other make a group with a box around it, and
/// groups are compared first. In single precision: boxes nearer than some 1e-6 of how far they are
/// from the origin may count as overlapping, too. Does not allocate once warm.
class OverlappingBoxes {
 public:
  static constexpr std::size_t group_size = 8;

  /// How many boxes there are; all are empty, and no pair is left out.
  void resize(std::size_t count);
  /// Pairs (a, b), a < b, ascending, each once, that are not looked for.
  void leave_out(const std::vector<std::pair<int, int>>& pairs);

  /// Sets a box (m). What is not finite is empty, and overlaps nothing. Different boxes may be set
  /// at once.
  void set(std::size_t box, const Vec3& low, const Vec3& high);
  /// Makes the groups' boxes, from the box `first`, a multiple of group_size, to the box `end`.
  void close_groups(std::size_t first, std::size_t end);

  /// take(part, pairs) for some pairs (a, b), a < b, at a time, perhaps at once for different
  /// parts. Returns the number of parts. The pairs of part after part are ascending, however many
  /// parts there are.
  template <class Take>
  int find(const PartedLoop& loop, const Take& take) {
    const int parts = loop.parts(count_, grain_size);
    const auto begins = share_out(parts);
    loop.each(parts, [&](int part) {
      if (parts > 1) fetch_from(begins[part] * at_a_time);
      for (std::size_t stretch = begins[part]; stretch < begins[part + 1]; ++stretch) {
        const std::size_t first = stretch * at_a_time;
        compare(first, std::min(count_, first + at_a_time), scratch_[part]);
        work_[stretch] = work_of(scratch_[part]);
        take(part, scratch_[part].pairs);
      }
    });
    return parts;
  }

  /// Adds all pairs (a, b), a < b, of which `box` is one.
  void find_with(std::size_t box, CapsulePairs& pairs);

  /// Eight boxes (m), by coordinate; empty ones are inside out.
  struct alignas(64) Group {
    float low[3][group_size], high[3][group_size];
  };
  /// As many as the arrays hold, and a vector's worth of empty ones beyond the last.
  struct Boxes {
    std::array<std::vector<float>, 3> low, high;
  };
  /// What is compared.
  struct Groups {
    std::vector<Group> boxes;
    Boxes around;
    std::vector<std::uint32_t> near_left_out;  // by box: bit k is its pair with the (k + 1)-th next
    std::vector<std::pair<int, int>> far_left_out;  // the others, ascending
    std::vector<int> first_far_left_out;            // by box, where its pairs begin there
  };
  struct Scratch {
    CapsulePairs pairs;
    std::vector<int> groups;  // that the box of one group overlaps
    Boxes around;             // their boxes
    std::vector<int> met;     // those of them that one box overlaps
    std::size_t all_met = 0;  // how many they were, of all boxes that were compared
  };

 private:
  static constexpr std::size_t grain_size = 128, at_a_time = 64;  // boxes, whole groups
  // As many pairs are found and taken in the time of comparing at_a_time boxes with the groups'
  // boxes, and with the boxes of one group that one of them overlaps.
  static constexpr double with_groups = 30.0, with_group = 1.2;

  static double work_of(const Scratch& scratch) {
    return with_groups + with_group * static_cast<double>(scratch.all_met) +
           static_cast<double>(scratch.pairs.size());
  }
  void make_room(Scratch& scratch) const;
  void fetch_from(std::size_t first) const;
  std::array<std::size_t, PartedLoop::most_parts + 1> share_out(int parts) const;
  void compare(std::size_t first, std::size_t end, Scratch& scratch) const;

  std::size_t count_ = 0;
  Groups groups_;
  std::vector<double> work_;  // by stretch of boxes, when they were compared last
  std::array<Scratch, PartedLoop::most_parts> scratch_;
};

}  // namespace pedicel::cosserat
