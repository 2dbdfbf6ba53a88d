#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Antenna with(std::vector<AntennaChange> changes) {
  return changed(demo_antenna(), changes);
}

TEST(AntennaChange, SetsAndScalesOneNumber) {
  const Antenna own = demo_antenna();
  EXPECT_EQ(with({set_to("oil.bulk_modulus", 1.6e9)}).hydraulics.bulk_modulus, 1.6e9);
  EXPECT_EQ(with({scaled_by("oil.bulk_modulus", 1.25)}).hydraulics.bulk_modulus,
            1.25 * own.hydraulics.bulk_modulus);
  EXPECT_EQ(with({set_to("structure.mode[1].frequency", 3.3)}).structure.modes[1].frequency, 3.3);
}

TEST(AntennaChange, ChangesEveryNumberThatItLists) {
  const Antenna own = demo_antenna();
  const auto paths = change_paths(own);
  EXPECT_EQ(std::set<std::string>(paths.begin(), paths.end()).size(), paths.size());
  for (const std::string& path : paths) {
    EXPECT_NO_THROW(changed(own, {scaled_by(path, 1.5)})) << path;
  }
}

TEST(AntennaChange, DisksOnTheMotorsAddInertia) {
  const double own = motor_inertia(demo_antenna());
  const double bare = motor_inertia(with({set_to("motor.flywheel_disks", 0.0)}));
  EXPECT_NEAR(own - bare, 4.0 * 24.0 * 0.012358, 1e-12);
}

TEST(AntennaChange, ScalesWhatThePartsMakeAtTheShaft) {
  const Antenna own = demo_antenna();
  const Antenna stiffer = with({scaled_by("at_shaft.oil_stiffness", 1.3)});
  EXPECT_EQ(oil_stiffness(stiffer), 1.3 * oil_stiffness(own));
  EXPECT_EQ(stiffer.hydraulics.bulk_modulus, own.hydraulics.bulk_modulus);
  const Antenna twice =
      with({scaled_by("at_shaft.motor_inertia", 2.0), scaled_by("at_shaft.motor_inertia", 2.0)});
  EXPECT_EQ(motor_inertia(twice), 4.0 * motor_inertia(own));
}

TEST(AntennaChange, InertiaAtTheShaftAsAboutTheAxis) {
  const double about_axis = antenna_inertia(with({scaled_by("antenna.inertia", 1.5)}));
  const double at_shaft = antenna_inertia(with({scaled_by("at_shaft.antenna_inertia", 1.5)}));
  EXPECT_NEAR(about_axis / at_shaft, 1.0, 1e-14);
}

TEST(AntennaChange, ScalesAllFrequenciesAsSpringsWouldAllInertias) {
  const Structure own = linear_plant(demo_antenna()).structure;
  const double factor = 0.9;
  const Structure softer =
      linear_plant(with({scaled_by("structure.frequencies", factor)})).structure;
  EXPECT_NEAR(softer.gear_stiffness / own.gear_stiffness, factor * factor, 1e-12);
  for (std::size_t i = 0; i < own.modes.size(); ++i) {
    EXPECT_NEAR(softer.modes[i].stiffness / own.modes[i].stiffness, factor * factor, 1e-12);
    EXPECT_EQ(softer.modes[i].inertia, own.modes[i].inertia);
  }
}

TEST(AntennaChange, RefusesWhatWouldChangeNothing) {
  const auto refused = [](std::vector<AntennaChange> changes) {
    return [changes] { with(changes); };
  };
  EXPECT_THAT(reference::Call(refused(
                  {set_to("at_shaft.oil_stiffness", 80.0), set_to("oil.bulk_modulus", 1e9)})),
              ThrowsMessage<InvalidInput>(HasSubstr("at_shaft.oil_stiffness")));
  EXPECT_THAT(reference::Call(refused(
                  {set_to("at_shaft.motor_inertia", 1.0), set_to("motor.flywheel_disks", 0.0)})),
              ThrowsMessage<InvalidInput>(HasSubstr("at_shaft.motor_inertia")));
  EXPECT_THAT(reference::Call(refused({set_to("oil.viscosity", 1.0)})),
              ThrowsMessage<InvalidInput>(HasSubstr("oil.viscosity")));
  EXPECT_THAT(reference::Call(refused({set_to("structure.mode[4].frequency", 9.0)})),
              ThrowsMessage<InvalidInput>(HasSubstr("mode[4]")));
  EXPECT_THAT(reference::Call(refused({set_to("structure.frequencies", 2.0)})),
              ThrowsMessage<InvalidInput>(HasSubstr("factor")));
  EXPECT_THAT(reference::Call(
                  refused({set_to("oil.bulk_modulus", std::numeric_limits<double>::infinity())})),
              ThrowsMessage<InvalidInput>(HasSubstr("finite")));
}

}  // namespace
}  // namespace boresight::plant
