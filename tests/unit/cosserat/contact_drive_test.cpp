#include "plugins/cosserat/contact/contact_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/core/random.h"

namespace pedicel::cosserat {
namespace {

// Two pads that shut from 20 mm towards 0 at 0.5 mm a step, and press with 10 N.
ContactDrive shutting() {
  ContactDrive drive;
  drive.reference = drive.start = 2.0e-2;
  drive.aim = 1.95e-2;
  drive.lower = 0.0;
  drive.upper = 2.5e-2;
  drive.press = 9.6;
  drive.hold = 10.4;
  return drive;
}

TEST(ContactDrive, GoesToItsAimWhereNothingPushes) {
  EXPECT_EQ(stand(shutting(), {}), 1.95e-2);
  const DriveLoad far{-1.0, 1.0e5, -1.0e-2};
  EXPECT_EQ(stand(shutting(), {&far, 1}), 1.95e-2);
}

// Both pads touch a stem 0.1 mm on: each sinks in by half of 9.6 N over 1e5 N/m.
TEST(ContactDrive, StopsWhereItsForceIsSpent) {
  const std::vector<DriveLoad> loads(2, {-1.0, 1.0e5, -1.0e-4});
  const ContactDrive drive = shutting();
  const double position = stand(drive, loads);
  EXPECT_NEAR(position, 2.0e-2 - 1.0e-4 - 4.8e-5, 1e-12);
  EXPECT_NEAR(load_at(drive, loads, position), -9.6, 1e-6);
}

TEST(ContactDrive, ReachesItsAimAgainstLessThanItsForce) {
  const DriveLoad soft{-1.0, 1.0e3, 0.0};  // 0.5 N at the aim
  EXPECT_EQ(stand(shutting(), {&soft, 1}), 1.95e-2);
}

// What pushes with less than it holds, and more than it presses, leaves it where it is.
TEST(ContactDrive, FrictionHoldsItWhereItStands) {
  const DriveLoad load{-1.0, 1.0e5, 1.0e-4};  // 10 N at the start
  EXPECT_EQ(stand(shutting(), {&load, 1}), 2.0e-2);
}

TEST(ContactDrive, IsPushedBackByMoreThanItHolds) {
  const DriveLoad load{-1.0, 1.0e5, 5.0e-4};  // 50 N at the start
  const ContactDrive drive = shutting();
  const double position = stand(drive, {&load, 1});
  EXPECT_NEAR(position, 2.0e-2 + 5.0e-4 - 1.04e-4, 1e-12);
}

TEST(ContactDrive, ItsStopBearsTheRest) {
  const DriveLoad load{-1.0, 1.0e5, 6.0e-3};
  EXPECT_EQ(stand(shutting(), {&load, 1}), 2.5e-2);
}

// Stems on both sides of a finger: the position is where all balance, and it is the only one.
TEST(ContactDrive, BalancesWhateverTouches) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    ContactDrive drive;
    drive.lower = random.uniform(-0.03, 0.0);
    drive.upper = random.uniform(0.0, 0.03);
    drive.reference = random.uniform(-0.01, 0.01);
    drive.start = random.uniform(-0.01, 0.01);
    drive.aim = random.uniform(-0.02, 0.02);
    drive.press = random.uniform(0.0, 20.0);
    drive.hold = drive.press + random.uniform(0.0, 1.0);
    std::vector<DriveLoad> loads(random.integer(0, 12));
    for (DriveLoad& load : loads)
      load = {random.uniform(-1.0, 1.0), std::pow(10.0, random.uniform(2.0, 6.0)),
              random.uniform(-5e-3, 5e-3)};
    const double position = stand(drive, loads), step = 1e-9;
    ASSERT_GE(position, drive.lower);
    ASSERT_LE(position, drive.upper);
    // Just below it the load is less than the force, just above it more.
    const double slack = 1e-6 + 1e-3 * step * 1e6 * 12;
    if (position > drive.lower + step) {
      EXPECT_LE(load_at(drive, loads, position - step), drive.force_above(position - step) + slack)
          << i;
    }
    if (position < drive.upper - step) {
      EXPECT_GE(load_at(drive, loads, position + step), drive.force_above(position + step) - slack)
          << i;
    }
  }
}

}  // namespace
}  // namespace pedicel::cosserat
