#include "plugins/discrepancy/data/labels.h"

#include <algorithm>

#include "engine/core/frames.h"

namespace pedicel::discrepancy {

namespace {

constexpr double exchanged_share = 0.2;  // of the way that the markers go if their labels are right
constexpr double apart = 1.0e-3;         // m: closer markers are not told apart

Vec3 at(const Eigen::MatrixXd& value, int row, int m) {
  return value.block<1, 3>(row, 3 * m).transpose();
}

void exchange(Eigen::MatrixXd& value, int row, int a, int b) {
  const Vec3 keep = at(value, row, a);
  value.block<1, 3>(row, 3 * a) = value.block<1, 3>(row, 3 * b).eval();
  value.block<1, 3>(row, 3 * b) = keep.transpose();
}

bool is_exchanged(const Eigen::MatrixXd& value, int row, int a, int b) {
  const Vec3 a0 = at(value, row - 1, a), b0 = at(value, row - 1, b);
  const Vec3 a1 = at(value, row, a), b1 = at(value, row, b);
  if (!(a0 + b0 + a1 + b1).allFinite() || (a0 - b0).norm() < apart) return false;
  const double kept = (a1 - a0).norm() + (b1 - b0).norm();
  return (a1 - b0).norm() + (b1 - a0).norm() <= exchanged_share * kept;
}

}  // namespace

std::vector<LabelExchange> exchanges_in(const Eigen::MatrixXd& given) {
  Eigen::MatrixXd value = given;  // with what was found put right
  const int markers = static_cast<int>(value.cols()) / 3, rows = static_cast<int>(value.rows());
  std::vector<LabelExchange> found;
  for (int row = 1; row < rows; ++row)
    for (int a = 0; a < markers; ++a)
      for (int b = a + 1; b < markers; ++b) {
        if (!is_exchanged(value, row, a, b)) continue;
        exchange(value, row, a, b);
        const auto goes_on = std::ranges::find_if(found, [&](const LabelExchange& one) {
          return one.a == a && one.b == b && one.to == row;
        });
        if (goes_on != found.end())
          goes_on->to = row + 1;
        else
          found.push_back({a, b, row, row + 1});
      }
  return found;
}

int put_back(const std::vector<LabelExchange>& exchanges, Eigen::MatrixXd& value) {
  int rows = 0;
  for (const LabelExchange& one : exchanges) {
    for (int row = one.from; row < one.to; ++row) exchange(value, row, one.a, one.b);
    rows += one.rows();
  }
  return rows;
}

}  // namespace pedicel::discrepancy
