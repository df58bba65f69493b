#include "engine/core/state_hash.h"

#include <gtest/gtest.h>

#include <limits>

namespace pedicel {
namespace {

std::uint64_t hash_of(double value) {
  StateHash hash;
  hash.add(value);
  return hash.value();
}

// FNV-1a 64: nothing gives the offset basis; eight zero bytes multiply it by the prime eight times.
TEST(StateHash, IsFnv1a) {
  EXPECT_EQ(StateHash().value(), 0xcbf29ce484222325ull);
  StateHash hash;
  hash.add(std::uint64_t{0});
  std::uint64_t expected = 0xcbf29ce484222325ull;
  for (int i = 0; i < 8; ++i) expected *= 0x100000001b3ull;
  EXPECT_EQ(hash.value(), expected);
}

TEST(StateHash, SeesTheLastBitTheSignAndTheOrder) {
  EXPECT_EQ(hash_of(1.0), hash_of(1.0));
  EXPECT_NE(hash_of(1.0), hash_of(1.0 + std::numeric_limits<double>::epsilon()));
  EXPECT_NE(hash_of(0.0), hash_of(-0.0));
  StateHash ab, ba;
  ab.add(1.0), ab.add(2.0);
  ba.add(2.0), ba.add(1.0);
  EXPECT_NE(ab.value(), ba.value());
}

TEST(StateHash, VectorsAndRotationsCountByTheirNumbers) {
  StateHash vector, numbers;
  vector.add(Eigen::Vector3d(1, 2, 3));
  vector.add(Eigen::Quaterniond(4, 5, 6, 7));  // w first here, x y z w in the hash
  for (const double value : {1.0, 2.0, 3.0, 5.0, 6.0, 7.0, 4.0}) numbers.add(value);
  EXPECT_EQ(vector.value(), numbers.value());
}

}  // namespace
}  // namespace pedicel
