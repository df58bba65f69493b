#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>

namespace pedicel {

/// FNV-1a over the bits of the state: two runs agree if and only if (nearly) their bits agree.
class StateHash {
 public:
  void add(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) {
      value_ ^= (bits >> (8 * i)) & 0xff;
      value_ *= 0x100000001b3ull;
    }
  }
  void add(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }
  void add(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const Eigen::Quaterniond& q) {
    for (int i = 0; i < 4; ++i) add(q.coeffs()[i]);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace pedicel
