#include "engine/io/asset_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

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

TEST(AssetFolder, AFileThatShipsIsFoundByItsNameInACheckout) {
  const TemporaryFolder folder;
  const std::filesystem::path assets = folder / "usr/share/pedicel/assets";
  std::filesystem::create_directories(assets / "scenes");
  std::filesystem::create_directories(folder / "usr/share/pedicel/plants");
  const auto scene = assets / "scenes/one.scene.yaml",
             plant = folder / "usr/share/pedicel/plants/one.plant.yaml";
  std::ofstream(scene) << "a";
  std::ofstream(plant) << "a";
  EXPECT_EQ(shipped_file("assets/scenes/one.scene.yaml", assets), scene.string());
  EXPECT_EQ(shipped_file("plants/one.plant.yaml", assets), plant.string());
  // Neither a folder nor what is not there, and no name without its folder.
  for (const char* name : {"assets/scenes", "assets/scenes/two.scene.yaml", "one.scene.yaml", ""})
    EXPECT_EQ(shipped_file(name, assets), name);
  EXPECT_EQ(shipped_file("plants/one.plant.yaml", ""), "plants/one.plant.yaml");
}

TEST(AssetFolder, OnesOwnFileComesBeforeTheOneThatShips) {
  const TemporaryFolder folder;
  const std::filesystem::path own = folder / "own/plants", shipped = folder / "share/plants";
  std::filesystem::create_directories(own);
  std::filesystem::create_directories(shipped);
  std::ofstream(own / "one.plant.yaml") << "a";
  std::ofstream(shipped / "one.plant.yaml") << "a";
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "own");
  const std::string own_one = shipped_file("plants/one.plant.yaml", folder / "share/assets");
  std::filesystem::current_path(folder / "");
  const std::string shipped_one = shipped_file("plants/one.plant.yaml", folder / "share/assets");
  std::filesystem::current_path(before);
  EXPECT_EQ(own_one, "plants/one.plant.yaml");
  EXPECT_EQ(shipped_one, (shipped / "one.plant.yaml").string());
}

}  // namespace
}  // namespace pedicel::io
