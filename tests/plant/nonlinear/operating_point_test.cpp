#include <gtest/gtest.h>

#include <boresight/plant/nonlinear/nonlinear_drive.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::plant {
namespace {

TEST(StateHeldByFriction, BristlesCarryTheOffset) {
  const NonlinearAntenna antenna = nonlinear_antenna(demo_antenna());
  const auto state = state_held_by_friction(antenna);
  // 5.65 N m over 2500 N m/rad.
  EXPECT_NEAR(state[AntennaStates::bristle], 5.65 / 2500.0, 1e-12);
  auto rest = state_at_rest(antenna);
  rest[AntennaStates::bristle] = state[AntennaStates::bristle];
  EXPECT_EQ(state, rest);
}

TEST(StateHeldByFriction, PressuresCarryAnOffsetBeyondTheBreakaway) {
  NonlinearAntenna antenna = nonlinear_antenna(demo_antenna());
  antenna.offset.constant = -40.0;
  EXPECT_EQ(state_held_by_friction(antenna), trim(antenna, {}).state);
}

}  // namespace
}  // namespace boresight::plant
