#pragma once

#include <Eigen/Dense>
#include <vector>

namespace pedicel::discrepancy {

/// Rows in which two markers have each other's labels.
struct LabelExchange {
  int a = 0, b = 0;      ///< the markers
  int from = 0, to = 0;  ///< rows, the last one not included
  int rows() const { return to - from; }
};

/// Markers that exchange their places from one sample to the next, far beyond their usual steps.
/// `value`: rows x 3 markers, m.
std::vector<LabelExchange> exchanges_in(const Eigen::MatrixXd& value);

/// Gives the markers their own labels again. Returns how many rows that changes.
int put_back(const std::vector<LabelExchange>& exchanges, Eigen::MatrixXd& value);

}  // namespace pedicel::discrepancy
