#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/control/controllers/delay.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/control/loops/state_space_controller_response.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;

constexpr double delay = 0.03;
constexpr double sample_time = 0.02;

Controller pi_controller() {
  return {LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}};
}

Controller full_controller() {
  Controller controller{LoopStructure::full().with_compliance_compensation(), {}};
  for (const auto& gain : controller.structure.gains()) {
    const std::string& s = gain.symbol;
    controller.gains.push_back(s == "kr"    ? 0.25
                               : s == "wi"  ? 0.8
                               : s == "wz"  ? 20.0
                               : s == "wp"  ? 12.0
                               : s == "kT"  ? 2e-3
                               : s == "wd"  ? 1.0
                               : s == "kp"  ? 0.25
                               : s == "wip" ? 0.03
                               : s == "cs"  ? 1e-4
                                            : 1.0);
  }
  return controller;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(StateSpaceController, SaysWhichPortsItTakes) {
  auto controller = to_state_space(pi_controller());
  controller.inputs[0] = "tacho";
  EXPECT_THAT(refusal([&] { antenna_state_space_controller(controller); }),
              HasSubstr("inputs among tachometer, encoder, motor_torque, rate_disturbance, found "
                        "'tacho'"));
  controller = to_state_space(pi_controller());
  controller.outputs[0] = "command";
  EXPECT_THAT(refusal([&] { antenna_state_space_controller(controller); }),
              HasSubstr("outputs among valve_demand, rate_command, found 'command'"));
  controller = plant::subsystem(to_state_space(pi_controller()),
                                {"tachometer", "encoder", "rate_disturbance"}, {"valve_demand"});
  EXPECT_THAT(refusal([&] { antenna_state_space_controller(controller); }),
              HasSubstr("the first alone"));
  controller = plant::subsystem(to_state_space(pi_controller()), {"tachometer", "encoder"},
                                {"valve_demand", "rate_command"});
  EXPECT_THAT(refusal([&] { antenna_state_space_controller(controller); }),
              HasSubstr("the second alone"));
  controller = plant::subsystem(to_state_space(pi_controller()), {"encoder"}, {"valve_demand"});
  EXPECT_THAT(refusal([&] { rate_loop_of(controller); }), HasSubstr("found neither"));
  controller.c.setConstant(std::nan(""));
  EXPECT_NE(refusal([&] { antenna_state_space_controller(controller); }), "");
  EXPECT_NE(refusal([&] {
              ControlledAntenna(reference::antenna(), to_state_space(pi_controller()), -1.0);
            }),
            "");
}

TEST(StateSpaceController, LoopGainsAreTheControllersOwn) {
  const auto plant = reference::antenna();
  const plant::PointResponse response(plant);
  for (const auto& controller : {pi_controller(), full_controller()}) {
    ControlledAntenna loop(plant, to_state_space(controller), delay);
    for (const double w : {1e-3, 0.05, 0.9, 5.3, 14.1, 70.0}) {
      const auto point = loop.at(w);
      for (std::size_t b = 0; b < 3; ++b) {
        const auto expected = loop_gain(response(w), w, controller, delay, loop_breaks.at(b));
        EXPECT_LT(std::abs(point.loop_gain.at(b) - expected), 1e-9 * std::abs(expected))
            << w << " " << b;
      }
    }
  }
}

TEST(StateSpaceController, RateLoopIsTheControllersOwn) {
  const auto plant = reference::antenna();
  for (const auto& controller : {pi_controller(), full_controller()}) {
    const auto rate = rate_loop_of(to_state_space(controller));
    const auto expected = rate_loop_controller(controller);
    EXPECT_EQ(rate.a.rows(), expected.a.rows());
    for (const double w : {0.01, 1.0, 30.0}) {
      const auto found = plant::frequency_response(rate, w);
      const auto wanted = plant::frequency_response(expected, w);
      for (std::size_t i = 0; i < rate.inputs.size(); ++i) {
        const auto there = std::ranges::find(expected.inputs, rate.inputs[i]);
        ASSERT_NE(there, expected.inputs.end());
        EXPECT_LT(std::abs(found(0, static_cast<Eigen::Index>(i)) -
                           wanted(0, there - expected.inputs.begin())),
                  1e-9 * wanted.norm());
      }
    }
  }
}

TEST(StateSpaceController, WorstComplianceIsThatOfTheResponse) {
  const auto plant = reference::antenna();
  const auto controller = to_state_space(pi_controller());
  const PeakGain worst = worst_compliance(plant, controller, delay);
  EXPECT_TRUE(worst.closed);
  ControlledAntenna loop(plant, controller, delay);
  EXPECT_NEAR(std::abs(loop.at(worst.frequency).boresight_by_wind), worst.lower,
              1e-8 * worst.lower);
  double highest = 0.0;
  for (double w = 1e-3; w < 200.0; w *= 1.003) {
    highest = std::max(highest, std::abs(loop.at(w).boresight_by_wind));
  }
  EXPECT_LE(highest, worst.upper);
  EXPECT_GT(highest, 0.99 * worst.lower);
}

TEST(ClosedLoopResponse, PolesAreThoseOfTheRationalDeadTime) {
  const auto plant = reference::antenna();
  for (const auto& controller : {pi_controller(), full_controller()}) {
    const ClosedLoopResponse course(plant, to_state_space(controller), delay);
    const double expected = numerics::spectral_abscissa(closed_loop(plant, controller, delay).a);
    EXPECT_NEAR(course.abscissa(), expected, 1e-7 * std::abs(expected) + 1e-9);
  }
}

// Parseval: the integral of the squared impulse response is that of the squared response over
// frequency, which knows no period, no points and no Lyapunov equation.
double response_energy(ControlledAntenna& loop, const plant::AntennaPlant& plant, bool step) {
  const double final_value = step ? loop.at(1e-7).boresight_by_wind.real() : 0.0;
  Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-6, 400.0, 3000);
  double sum = 0.0, before = 0.0;
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    std::complex<double> value = loop.at(w[i]).boresight_by_wind;
    if (step) value = (value - final_value) / std::complex<double>(0.0, w[i]);
    const double density = std::norm(value) / std::numbers::pi;
    if (i > 0) sum += 0.5 * (density * w[i] + before * w[i - 1]) * std::log(w[i] / w[i - 1]);
    before = density;
  }
  return sum;
}

TEST(ClosedLoopResponse, EnergyIsThatOfTheResponseWithExactDeadTime) {
  const auto plant = reference::antenna();
  for (const auto& controller : {pi_controller(), full_controller()}) {
    const auto system = to_state_space(controller);
    ControlledAntenna loop(plant, system, delay);
    const ClosedLoopResponse course(plant, system, delay);
    const double impulse = course.score(DisturbanceType::impulse).integral_squared_error;
    EXPECT_NEAR(impulse, response_energy(loop, plant, false), 2e-5 * impulse);
    const double step = course.score(DisturbanceType::step).integral_squared_error;
    EXPECT_NEAR(step, response_energy(loop, plant, true), 2e-4 * step);
  }
}

// With integrators in the loop the encoder comes back to where it was: what is left of a constant
// torque is the bending that it does not see.
TEST(ClosedLoopResponse, OnlyBendingIsLeftOfAConstantTorque) {
  const auto plant = reference::antenna();
  double bending = 0.0;
  for (const auto& mode : plant.structure.modes) {
    bending += mode.beam_weight * mode.wind_fraction / mode.stiffness;
  }
  const ClosedLoopResponse course(plant, to_state_space(pi_controller()), delay);
  EXPECT_NEAR(course.score(DisturbanceType::step).final_value, bending, 1e-8 * bending);
  const auto sampled = antenna_state_space_controller(
      plant::subsystem(sampled_controller(pi_controller(), sample_time), {"tachometer", "encoder"},
                       {"valve_demand"}));
  const ClosedLoopResponse other(plant, sampled, delay);
  EXPECT_NEAR(other.score(DisturbanceType::step).final_value, bending, 1e-8 * bending);
}

// Without integrators: valve, leakage and gains in series under a constant torque T. The motor
// stands, K xv = lambda T, and xv = -kr kp angle.
TEST(ClosedLoopResponse, StaticComplianceWithoutIntegralIsLeakageOverTheGains) {
  const auto plant = reference::antenna();
  const double kr = 0.2, kp = 0.2;
  plant::StateSpace controller = plant::static_gain(Eigen::RowVector2d{-kr, -kr * kp},
                                                    {"tachometer", "encoder"}, {"valve_demand"});
  const ClosedLoopResponse course(plant, controller, delay);
  ASSERT_TRUE(course.stable());
  double bending = 0.0;
  for (const auto& mode : plant.structure.modes) {
    bending += mode.beam_weight * mode.wind_fraction / mode.stiffness;
  }
  const double expected =
      plant.drive.leakage_rate / (plant.drive.oil_stiffness * kr * kp) + bending;
  const auto score = course.score(DisturbanceType::step);
  EXPECT_NEAR(score.final_value, expected, 1e-9 * expected);
  // A loop as slow as this one creeps to its end and has no peak.
  EXPECT_NEAR(score.peak, expected, 1e-9 * expected);
  EXPECT_EQ(score.time_of_peak, std::numeric_limits<double>::infinity());
  ControlledAntenna loop(plant, controller, delay);
  EXPECT_NEAR(loop.at(1e-6).boresight_by_wind.real(), expected, 1e-6 * expected);
}

TEST(ClosedLoopResponse, ImpulseIsTheDerivativeOfTheStep) {
  const auto plant = reference::antenna();
  const auto controller = to_state_space(pi_controller());
  const ClosedLoopResponse course(plant, controller, delay);
  const auto step = course.boresight(DisturbanceType::step, 20.0);
  const auto impulse = course.boresight(DisturbanceType::impulse, 20.0);
  double sum = 0.0, largest = 0.0;
  for (const auto& point : step) largest = std::max(largest, std::abs(point.boresight));
  for (std::size_t i = 1; i < step.size(); ++i) {
    sum += 0.5 * (impulse[i].boresight + impulse[i - 1].boresight) *
           (impulse[i].time - impulse[i - 1].time);
    ASSERT_NEAR(sum, step[i].boresight, 1e-4 * largest);
  }
}

// The rational dead time of order 8 is right to 1e-7 here, its system's H2 norm is a Lyapunov
// equation of other states.
TEST(ClosedLoopResponse, EnergyIsTheSquaredNormOfTheRationalLoop) {
  const auto plant = reference::antenna();
  const auto rational =
      plant::subsystem(closed_loop(plant, pi_controller(), delay), {"wind_torque"}, {"beam"});
  const ClosedLoopResponse course(plant, to_state_space(pi_controller()), delay);
  const double norm = h2_norm(rational).value;
  EXPECT_NEAR(course.score(DisturbanceType::impulse).integral_squared_error, norm * norm,
              1e-7 * norm * norm);
}

TEST(ClosedLoopResponse, ReturnsWithinItsFractionAndStaysThere) {
  const auto plant = reference::antenna();
  const ClosedLoopResponse course(plant, to_state_space(pi_controller()), delay);
  const auto score = course.score(DisturbanceType::impulse);
  ASSERT_TRUE(score.return_time);
  double peak = 0.0, last = 0.0;
  for (const auto& point : course.boresight(DisturbanceType::impulse, score.horizon)) {
    peak = std::max(peak, std::abs(point.boresight));
    if (std::abs(point.boresight) > 0.05 * score.peak) last = point.time;
  }
  EXPECT_NEAR(score.peak, peak, 1e-3 * peak);
  EXPECT_GE(score.peak, peak * (1.0 - 1e-12));
  EXPECT_NEAR(*score.return_time, last, 2.0 * delay);
}

TEST(ClosedLoopResponse, FinerSamplesComeNearTheContinuousLoop) {
  const auto plant = reference::antenna();
  const auto controller = pi_controller();
  // One and a half fine samples of delay of its own.
  const double fine = 1e-3;
  const auto sampled = plant::subsystem(sampled_controller(controller, fine),
                                        {"tachometer", "encoder"}, {"valve_demand"});
  const auto one = ClosedLoopResponse(plant, sampled, 0.0).score(DisturbanceType::impulse);
  const auto other = ClosedLoopResponse(plant, to_state_space(controller), 1.5 * fine)
                         .score(DisturbanceType::impulse);
  EXPECT_NEAR(one.peak, other.peak, 1e-4 * other.peak);
  EXPECT_NEAR(one.integral_squared_error, other.integral_squared_error,
              1e-4 * other.integral_squared_error);
}

TEST(ClosedLoopResponse, FollowsASampledControllerAsItsClosedLoopDoes) {
  const auto plant = reference::antenna();
  const auto controller = plant::subsystem(sampled_controller(pi_controller(), sample_time),
                                           {"tachometer", "encoder"}, {"valve_demand"});
  const ClosedLoopResponse course(plant, controller, 0.0);
  const SampledLoop loop{plant::to_state_space(plant),
                         plant::renamed(controller, {{"valve_demand", "valve_command"}}),
                         sample_time};
  const auto closed = sampled_closed_loop(loop);
  EXPECT_NEAR(course.spectral_radius(), numerics::eigenvalues(closed.a).cwiseAbs().maxCoeff(),
              1e-9);
  // The same certified gain from either, and the response near it but for the hold of the torque.
  const PeakGain worst = worst_compliance(plant, controller, 0.0);
  EXPECT_TRUE(worst.closed);
  ControlledAntenna response(plant, controller, 0.0);
  EXPECT_NEAR(std::abs(response.at(worst.frequency).boresight_by_wind), worst.lower,
              5e-3 * worst.lower);
}

TEST(ClosedLoopResponse, OtherStatesScoreTheSame) {
  const auto plant = reference::antenna();
  reference::RandomNumbers random(7);
  auto controller = to_state_space(full_controller());
  const auto before = ClosedLoopResponse(plant, controller, delay).score(DisturbanceType::step);
  const Eigen::Index n = controller.a.rows();
  Eigen::MatrixXd t = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) t(i, j) = random.uniform(-1.0, 1.0);
    t.row(i) *= random.log_uniform(0.1, 10.0);
  }
  const Eigen::MatrixXd back =
      numerics::linear_solve(t, Eigen::MatrixXd::Identity(n, n), "change of state");
  controller.a = t * controller.a * back;
  controller.b = t * controller.b;
  controller.c = controller.c * back;
  const auto after = ClosedLoopResponse(plant, controller, delay).score(DisturbanceType::step);
  EXPECT_NEAR(after.peak, before.peak, 1e-9 * before.peak);
  EXPECT_NEAR(after.integral_squared_error, before.integral_squared_error,
              1e-8 * before.integral_squared_error);
}

TEST(ClosedLoopResponse, RefusesToScoreAnUnstableLoop) {
  auto controller = to_state_space(pi_controller());
  controller.c *= 40.0;
  controller.d *= 40.0;
  const ClosedLoopResponse course(reference::antenna(), controller, delay);
  EXPECT_FALSE(course.stable());
  EXPECT_GT(course.abscissa(), 0.0);
  EXPECT_THROW(course.score(DisturbanceType::step), NumericalFailure);
}

TEST(ClosedLoopResponse, SplitsTheDeadTimeForFastPoles) {
  const auto plant = reference::antenna();
  // A lag far beyond the loop changes next to nothing; the period must follow it.
  auto controller = to_state_space(pi_controller());
  const auto lag = plant::rational({1.0}, {1.0, 1.0 / 2000.0}, "slow", "valve_demand", "lag");
  const auto fast = plant::connect({plant::renamed(controller, {{"valve_demand", "slow"}}), lag},
                                   {"tachometer", "encoder", "rate_disturbance"},
                                   {"valve_demand", "rate_command"});
  const ClosedLoopResponse course(plant, fast, delay);
  EXPECT_LT(course.period(), 0.5 * delay);
  const double later = 1.0 / 2000.0;  // a fast lag is a little dead time
  const auto expected =
      ClosedLoopResponse(plant, controller, delay + later).score(DisturbanceType::impulse);
  const auto found = course.score(DisturbanceType::impulse);
  EXPECT_NEAR(found.peak, expected.peak, 1e-5 * expected.peak);
  EXPECT_NEAR(found.integral_squared_error, expected.integral_squared_error,
              1e-5 * expected.integral_squared_error);
}

}  // namespace
}  // namespace boresight::control
