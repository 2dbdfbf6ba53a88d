#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_nonlinear_antenna.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/state_space.hpp>
#include <boresight/plant/nonlinear/antenna_channels.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd no_input(const FeedbackSystem& system) {
  return VectorXd::Zero(system.linear.b.cols() - system.channel_outputs);
}

const std::vector<std::string> linear_outputs{"tachometer", "motor_torque", "encoder", "beam"};

TEST(NonlinearAntenna, IsTheLinearPlantInSmallMotionAboutRest) {
  auto details = reference::drive_details();
  details.line_lengths.clear();
  details.friction = {{}, 0.0, 0.0, 0.01};
  details.friction.curve.stribeck_rate = details.friction.curve.saturating_rate = 1.0;
  details.friction.curve.viscous_friction = 0.9;
  auto drive = reference::hydraulic_drive();
  drive.volume_2 = drive.volume_1;  // sides alike: their mean pressure is not felt at all
  const auto antenna = make_nonlinear_antenna(reference::antenna(), drive, details);
  const auto system = to_feedback_system(antenna);
  const auto small = subsystem(linearise(system, state_at_rest(antenna), no_input(system)),
                               {"valve_command", "wind_torque"}, linear_outputs);
  const auto linear = to_state_space(reference::antenna());
  for (const double hertz : {1e-3, 0.1, 0.8, 1.0, 2.26, 3.3, 6.0, 12.0, 40.0}) {
    const double w = two_pi * hertz;
    const Eigen::MatrixXcd expected = frequency_response(linear, w);
    const Eigen::MatrixXcd found = frequency_response(small, w);
    EXPECT_LT(((found - expected).array() / expected.array()).abs().maxCoeff(), 1e-9) << hertz;
  }
}

TEST(NonlinearAntenna, LinesChangeTheSlowMotionLittleAndRingAtTheirSlosh) {
  auto details = reference::drive_details();
  const auto antenna = reference::nonlinear_antenna(details);
  details.line_lengths.clear();
  const auto without = reference::nonlinear_antenna(details);
  const auto small = [](const NonlinearAntenna& model) {
    const auto system = to_feedback_system(model);
    return linearise(system, state_at_rest(model), no_input(system));
  };
  const auto ringing = small(antenna);
  const auto slow = subsystem(ringing, {"valve_command"}, linear_outputs);
  const auto plain = subsystem(small(without), {"valve_command"}, linear_outputs);
  for (const double hertz : {0.01, 0.3, 0.85}) {
    const double w = two_pi * hertz;
    EXPECT_LT((frequency_response(slow, w) - frequency_response(plain, w)).norm(),
              1e-2 * frequency_response(plain, w).norm())
        << hertz;
  }
  // With the motor all but standing still and the valve a source of flow, a pressure wave runs to
  // the motor and back once a period: the response of the port pressure is largest there.
  const auto port = subsystem(ringing, {"valve_command"}, {"inlet_pressure_1"});
  const double slosh = antenna.oil.lines[0].half_wave;
  const auto magnitude = [&](double hertz) {
    return std::abs(frequency_response(port, two_pi * hertz)(0, 0));
  };
  EXPECT_GT(magnitude(slosh), 2.5 * magnitude(0.97 * slosh));
  EXPECT_GT(magnitude(slosh), magnitude(0.999 * slosh));
  EXPECT_GT(magnitude(slosh), magnitude(1.001 * slosh));
  EXPECT_NEAR(bulk_modulus_from_slosh(13.11, slosh, 850.0), 1229e6, 1.0);
}

TEST(NonlinearAntenna, FollowsThePhysicsOfOneTorqueState) {
  // q = xv sqrt(1 - sign(xv) T/T_supply) with both sides about their mean.
  const auto antenna = reference::nonlinear_antenna();
  const auto system = to_feedback_system(antenna);
  VectorXd z = VectorXd::Zero(AntennaChannels::input_count);
  VectorXd n(system.channel_outputs);
  MatrixXd slope(system.channel_outputs, system.channel_inputs);
  const double supply = antenna.oil.supply_torque;
  EXPECT_NEAR(supply, 316.0, 0.5);
  for (const double spool : {-20.0, -0.5, 0.5, 20.0}) {
    for (const double torque : {-150.0, 0.0, 200.0}) {
      z[AntennaChannels::spool] = spool;
      z[AntennaChannels::manifold_1] = z[AntennaChannels::side_1] = 0.5 * (supply + torque);
      z[AntennaChannels::manifold_2] = z[AntennaChannels::side_2] = 0.5 * (supply - torque);
      system.channels->evaluate(z, n, slope);
      const double null = antenna.oil.null_leakage * supply;
      const double expected =
          spool * std::sqrt(1.0 - std::copysign(torque, spool * torque) / supply);
      EXPECT_NEAR(spool + n[0] - null, expected, 1e-5 * std::abs(spool));
      EXPECT_NEAR(spool - n[1] + null, expected, 1e-5 * std::abs(spool));
    }
  }
}

// Every derivative of every channel against differences, at random points on either side of kinks.
TEST(AntennaChannels, DerivativesAreThoseOfTheirValues) {
  auto details = reference::drive_details();
  details.air_fraction = 0.01;
  details.makeup_pressure = 3e5;
  details.overlap = 0.5;
  details.null_offset = 0.1;
  details.supply_droop = 2e4;
  details.slew_limit = 400.0;
  details.preload_torque = 20.0;
  details.backlash = 0.3;
  details.offset.cosine = 5.0;
  details.offset.sine = -2.0;
  reference::RandomNumbers random(7);
  for (const bool bristles : {true, false}) {
    if (!bristles) details.friction.bristle_stiffness = 0.0;
    const auto antenna = reference::nonlinear_antenna(details);
    const auto system = to_feedback_system(antenna);
    ASSERT_EQ(system.channel_outputs, bristles ? 8 : 7);
    const VectorXd scale = (VectorXd(AntennaChannels::input_count) << 30.0, 10.0, 300.0, 300.0,
                            300.0, 300.0, 3.0, 0.02, 1e4, 0.8, 3.0)
                               .finished();
    const auto at = [&](const VectorXd& z) {
      VectorXd n(system.channel_outputs);
      MatrixXd slope(system.channel_outputs, system.channel_inputs);
      system.channels->evaluate(z, n, slope);
      return std::pair{n, slope};
    };
    for (int trial = 0; trial < 300; ++trial) {
      VectorXd z(scale.size());
      for (Index i = 0; i < z.size(); ++i) {
        const bool pressure = i >= AntennaChannels::manifold_1 && i <= AntennaChannels::side_2;
        z[i] = scale[i] * random.uniform(pressure ? -0.05 : -1.0, 1.0);
      }
      const auto [n, slope] = at(z);
      for (Index i = 0; i < z.size(); ++i) {
        const double h = 1e-6 * scale[i];
        VectorXd up = z;
        VectorXd down = z;
        up[i] += h;
        down[i] -= h;
        const auto [n_up, slope_up] = at(up);
        const auto [n_down, slope_down] = at(down);
        for (Index row = 0; row < n.size(); ++row) {
          // A kink within the difference: its two sides differ.
          if (std::abs(slope_up(row, i) - slope_down(row, i)) >
              1e-3 * (1e-3 + std::abs(slope(row, i)))) {
            continue;
          }
          EXPECT_NEAR((n_up[row] - n_down[row]) / (2.0 * h), slope(row, i),
                      1e-5 * (std::abs(slope(row, i)) + (1.0 + std::abs(n[row])) / scale[i]))
              << "channel " << row << " by " << i << " in trial " << trial;
        }
      }
    }
  }
}

TEST(NonlinearAntenna, FrictionOfSteadyMotionIsTheCurve) {
  const auto antenna = reference::nonlinear_antenna();
  for (const double rate : {-20.0, -0.3, 0.02, 2.09, 60.0}) {
    const auto point = trim(antenna, {rate, 0.0, {}});
    const auto system = to_feedback_system(antenna);
    const double torque = (system.linear.c.row(system.channel_inputs + 1) * point.state)(0, 0);
    EXPECT_NEAR(torque, friction_torque(antenna.friction.curve, rate), 1e-8 * std::abs(torque));
    EXPECT_LT(point.residual, 1e-9);
  }
}

TEST(NonlinearAntenna, SlopeOfFrictionAtTrackingSpeedDampsTheSmallMotion) {
  // LuGre's slow small-signal friction is the slope of the curve: at a low frequency the response
  // from valve to rate is that of the linear plant with this viscous friction.
  auto details = reference::drive_details();
  details.line_lengths.clear();
  const auto antenna = reference::nonlinear_antenna(details);
  const double rate = 2.09;
  const auto point = trim(antenna, {rate, 0.0, {}});
  const auto small = linearise(to_feedback_system(antenna), point.state, point.input);
  auto linear = reference::antenna();
  linear.drive.viscous_friction = friction_slope(antenna.friction.curve, rate);
  // The orifice adds to the leakage, d(flow)/d(torque) = -(q/2)/(T_supply - T).
  const double torque = friction_torque(antenna.friction.curve, rate);
  linear.drive.leakage_rate +=
      0.5 * linear.drive.oil_stiffness * point.state[AntennaStates::spool] *
      std::sqrt(1.0 / (antenna.oil.supply_torque * (antenna.oil.supply_torque - torque)));
  const auto expected = to_state_space(linear);
  const double w = two_pi * 0.01;
  const auto gain = [&](const StateSpace& system) {
    return frequency_response(subsystem(system, {"valve_command"}, {"motor_torque"}), w)(0, 0);
  };
  const auto opening = std::sqrt(1.0 - torque / antenna.oil.supply_torque);
  EXPECT_NEAR(std::abs(gain(small) / (opening * gain(expected))), 1.0, 2e-3);
}

TEST(Trim, RestCarriesTheOffsetByPressure) {
  auto details = reference::drive_details();
  details.offset = {3.0, 4.0, 1.0, 0.7, reference::gear_ratio()};
  const auto antenna = reference::nonlinear_antenna(details);
  const double angle = 100.0;
  const auto point = trim(antenna, {0.0, angle, {}});
  const auto system = to_feedback_system(antenna);
  const double elevation = 0.7 + angle / reference::gear_ratio();
  EXPECT_NEAR((system.linear.c.row(system.channel_inputs + 1) * point.state)(0, 0),
              3.0 + 4.0 * std::cos(elevation) + std::sin(elevation), 1e-9);
  EXPECT_NEAR(point.state[AntennaStates::motor_angle], angle, 1e-9);
}

TEST(Trim, FindsTheSpoolBeyondTheOverlap) {
  auto details = reference::drive_details();
  details.overlap = 3.0;
  details.null_offset = 0.5;
  details.offset.constant = 4.0;
  const auto antenna = reference::nonlinear_antenna(details);
  const auto without = reference::nonlinear_antenna([&] {
    auto plain = details;
    plain.overlap = 0.0;
    plain.null_offset = 0.0;
    return plain;
  }());
  for (const double rate : {-2.09, 0.0, 1e-3, 20.0}) {
    const auto point = trim(antenna, {rate, 0.0, {}});
    const auto plain = trim(without, {rate, 0.0, {}});
    const double expected = plain.input[0] + std::copysign(3.0, plain.input[0]) - 0.5;
    EXPECT_NEAR(point.input[0], expected, 1e-9 * std::abs(expected)) << rate;
  }
}

TEST(Trim, IsThatOfOilWithoutAirUpToTheLastRate) {
  // Whether the supply can give a rate is no matter of stiffness.
  const auto airless = reference::nonlinear_antenna();
  const auto holds = [](const NonlinearAntenna& antenna, double rate) {
    try {
      trim(antenna, {rate, 0.0, {}});
      return true;
    } catch (const NumericalFailure&) {
      return false;
    }
  };
  for (const double air : {0.001, 0.02, 0.1}) {
    auto details = reference::drive_details();
    details.air_fraction = air;
    const auto antenna = reference::nonlinear_antenna(details);
    const auto system = to_feedback_system(antenna);
    const auto matrices = feedback_matrices(system);
    for (double rate = 5.0; rate <= 150.0; rate += 5.0) {
      ASSERT_EQ(holds(antenna, rate), holds(airless, rate)) << air << ", " << rate;
      if (!holds(airless, rate)) continue;
      const auto point = trim(antenna, {rate, 0.0, {}});
      Eigen::VectorXd value(system.channel_outputs);
      Eigen::MatrixXd slope(system.channel_outputs, system.channel_inputs);
      const Eigen::VectorXd z =
          matrices.channel_output * point.state + matrices.input_to_channels * point.input;
      system.channels->evaluate(z, value, slope);
      const Eigen::VectorXd change =
          matrices.a * point.state + matrices.input * point.input + matrices.channel_input * value;
      const Eigen::VectorXd scale = matrices.a.cwiseAbs() * point.state.cwiseAbs() +
                                    matrices.input.cwiseAbs() * point.input.cwiseAbs() +
                                    matrices.channel_input.cwiseAbs() * value.cwiseAbs();
      const Eigen::VectorXd rotation = rate * rigid_rotation(antenna);
      for (Eigen::Index i = 0; i < change.size(); ++i) {
        EXPECT_NEAR(change[i], rotation[i], 1e-9 * std::max(scale[i], 1e-6) + 1e-15 * rate)
            << air << ", " << rate << ", state " << i + 1;
      }
    }
  }
}

TEST(Trim, HoldsEveryRateBelowTheSupplysLastWhateverTheFriction) {
  // Steady motion takes a little more pressure the faster it is: the rates that hold are an
  // interval.
  reference::RandomNumbers random(20);
  for (int trial = 0; trial < 40; ++trial) {
    auto details = reference::drive_details();
    auto& curve = details.friction.curve;
    curve.coulomb_torque = random.log_uniform(1.0, 30.0);
    curve.breakaway_torque = curve.coulomb_torque * random.uniform(1.0, 2.0);
    curve.saturating_torque = random.integer(0, 1) == 0 ? 0.0 : random.log_uniform(1.0, 60.0);
    curve.viscous_friction = random.log_uniform(0.05, 2.0);
    details.friction.bristle_stiffness = random.log_uniform(500.0, 10000.0);
    const auto antenna = reference::nonlinear_antenna(details);
    bool held = true;
    for (double rate = 1.0; rate < 150.0; rate += 3.0) {
      bool holds = true;
      try {
        EXPECT_LT(trim(antenna, {rate, 0.0, {}}).residual, 1e-9);
      } catch (const NumericalFailure&) {
        holds = false;
      }
      EXPECT_TRUE(held || !holds) << "trial " << trial << ", " << rate << " rad/s";
      held = holds;
    }
    // Half the torque and two thirds of the valve at 60 rad/s.
    EXPECT_NO_THROW(trim(antenna, {60.0, 0.0, {}})) << "trial " << trial;
  }
}

TEST(Trim, SaysWhatTheSupplyCannotGive) {
  try {
    trim(reference::nonlinear_antenna(), {200.0, 0.0, {}});
    FAIL();
  } catch (const NumericalFailure& error) {
    EXPECT_THAT(error.what(), testing::AnyOf(testing::HasSubstr("no steady motion"),
                                             testing::HasSubstr("balance of the steady motion")));
  }
}

TEST(NonlinearAntenna, RefusesWhatCannotBe) {
  const auto refused = [](auto change, const char* what) {
    auto antenna = reference::nonlinear_antenna();
    change(antenna);
    try {
      to_feedback_system(antenna);
      ADD_FAILURE() << what;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(what));
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& a) { a.oil.supply_torque = a.oil.return_torque; }, "supply torque");
  refused([&](auto& a) { a.oil.laminar_torque = nan; }, "laminar torque");
  refused([](auto& a) { a.valve.stroke_limit = 0.0; }, "stroke limit");
  refused([](auto& a) { a.friction.curve.coulomb_torque = 0.0; }, "bristles");
  refused([](auto& a) { a.gear.backlash = 0.1; }, "preload");
  refused([](auto& a) { a.oil.lines[2].half_wave = -1.0; }, "half-wave");
  refused([&](auto& a) { a.motor_inertia = nan; }, "motor inertia");
  refused([](auto& a) { a.oil.modes_per_line = 21; }, "modes a line");
}

TEST(GearContact, IsTheLinearSpringWithinThePreloadAndConservative) {
  const GearContact gear{160.0, 2.0, 20.0, 0.3};
  const double preload = 20.0 / 80.0;
  for (const double windup : {-0.2, -0.05, 0.0, 0.22}) {
    const auto torque = gear_torque(gear, windup, 0.5);
    EXPECT_NEAR(torque.value, 160.0 * windup + 2.0 * 0.5, 1e-12);
  }
  // One half crosses its backlash: the other's spring alone, then both pull one way.
  EXPECT_NEAR(gear_torque(gear, preload + 0.1, 0.0).value, 80.0 * (2.0 * preload + 0.1), 1e-12);
  EXPECT_NEAR(gear_torque(gear, preload + 0.4, 0.0).value,
              80.0 * (2.0 * preload + 0.4) + 80.0 * 0.1, 1e-12);
  // Torque is the derivative of the energy.
  for (double windup = -0.9; windup < 0.9; windup += 0.0371) {
    const double h = 1e-6;
    EXPECT_NEAR((gear_energy(gear, windup + h) - gear_energy(gear, windup - h)) / (2.0 * h),
                gear_torque(gear, windup, 0.0).value, 1e-4);
    EXPECT_NEAR(gear_torque(gear, -windup, -0.3).value, -gear_torque(gear, windup, 0.3).value,
                1e-12);
  }
}

TEST(OilCircuit, AirSoftensAtLowPressureAndIsMonotone) {
  OilCircuit oil;
  oil.air_fraction = 0.01;
  oil.bulk_modulus_torque = 1229e6;
  oil.atmosphere_torque = 101325.0;
  // Merritt: 1/beta_eff = 1/beta + V_gas/(V n p); isothermal at the atmosphere: 1 % of air makes
  // beta_eff = 1/(1/1229 + 0.01/0.101325) MPa.
  oil.polytropic_exponent = 1.0;
  EXPECT_NEAR(stiffness_ratio(oil, 101325.0).value * 1229.0, 1.0 / (1.0 / 1229.0 + 0.01 / 0.101325),
              1e-9);
  double last = 0.0;
  for (double p = 1e3; p < 1e8; p *= 2.0) {
    const double ratio = stiffness_ratio(oil, p).value;
    EXPECT_GT(ratio, last);
    last = ratio;
  }
  EXPECT_NEAR(last, 1.0, 1e-3);
}

}  // namespace
}  // namespace boresight::plant
