#include "pedicel/io/asset_folder.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace pedicel::io {
namespace {

TEST(AssetFolder, StandsInACheckoutAboveTheProgramOrWhereItIsInstalled) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "tree/assets/leaves");
  std::filesystem::create_directories(folder / "usr/share/pedicel/assets/leaves");
  EXPECT_EQ(asset_folder_of(folder / "tree/build/release/pedicel"), folder / "tree/assets");
  EXPECT_EQ(asset_folder_of(folder / "usr/bin/pedicel"), folder / "usr/share/pedicel/assets");
}

TEST(AssetFolder, IsEmptyWhereThereIsNone) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "usr/share/pedicel");
  std::filesystem::create_directories(folder / "usr/assets");  // somebody else's
  EXPECT_EQ(asset_folder_of(folder / "usr/bin/pedicel"), "");
}

}  // namespace
}  // namespace pedicel::io
