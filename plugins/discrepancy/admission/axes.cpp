#include "plugins/discrepancy/admission/axes.h"

#include <algorithm>
#include <array>

namespace pedicel::discrepancy {

namespace {

constexpr std::array names = {"x", "y", "z"};

// Columns that are not read as they stand. A mistake touches few of them: somebody exchanges two
// names, or forgets a sign.
int changed(const Mat3& read) {
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) count += read(axis, axis) == 1.0 ? 0 : 1;
  return count;
}

std::string mistake(const Mat3& read) {
  // Named from the commonest mistake to the rarest: a sign, two columns, another axis up.
  const bool plain = read.minCoeff() == 0.0;  // no sign is turned
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    // Only where nothing else is wrong: with two signs turned it is a frame that was turned by half
    // a circle.
    if (changed(read) == 1 && read(a, a) == -1.0)
      return std::string(names[a]) + " of the opposite sign";
    // With a sign besides it would be a turn, which has another reason.
    if (plain && read(a, b) == 1.0 && read(b, a) == 1.0)
      return std::string(names[std::min(a, b)]) + " and " + names[std::max(a, b)] + " exchanged";
  }
  // What stands up is what people notice. Programs for films and games have y there.
  if (read(2, 1) == 1.0) return "y up in place of z";
  if (read(2, 0) == 1.0) return "x up in place of z";
  if (read(2, 2) == -1.0) return "z down in place of up";
  // Last of those that are known: a mirror image has no up that is wrong.
  if (read.determinant() < 0.0) return "a left-handed frame";
  return "a frame turned about z";
}

std::vector<Axes> all_others() {
  std::vector<Axes> all;
  // Sorted, or next_permutation() would leave some out.
  std::array order = {0, 1, 2};
  do {
    // All 48 ways in which three columns can be read, but for the right one.
    for (int signs = 0; signs < 8; ++signs) {
      Mat3 read = Mat3::Zero();
      for (int axis = 0; axis < 3; ++axis) read(axis, order[axis]) = signs >> axis & 1 ? -1.0 : 1.0;
      if (!read.isIdentity()) all.push_back({read, mistake(read)});
    }
  } while (std::ranges::next_permutation(order).found);
  std::ranges::stable_sort(all, {}, [](const Axes& axes) {
    // The fewer columns are wrong, the likelier somebody has done it.
    return changed(axes.read) + (axes.read.array() < 0.0).count();
  });
  return all;
}

}  // namespace

// Made once: several checks try all of them for every trial.
const std::vector<Axes>& other_axes() {
  static const std::vector<Axes> all = all_others();
  return all;
}

// As a person would write it into a header, and not as a matrix.
std::string as_read(const Mat3& read) {
  std::string list;
  // From -1 columns a person sees at once which one to turn.
  for (int axis = 0; axis < 3; ++axis)
    for (int from = 0; from < 3; ++from)
      if (read(axis, from) != 0.0)
        list += std::string(list.empty() ? "(" : ", ") + (read(axis, from) < 0.0 ? "-" : "") +
                names[from];
  return list + ")";
}

}  // namespace pedicel::discrepancy
