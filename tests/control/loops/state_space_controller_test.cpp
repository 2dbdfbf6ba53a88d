#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/control/controllers/delay.hpp>
#include <boresight/control/controllers/sampled_law.hpp>
#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/sensitivity_bounds.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/control/loops/state_space_controller_course.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;

constexpr double delay = 0.03;
constexpr double sample_time = 0.02;

ControlLaw pi_law() {
  return {LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}};
}

ControlLaw full_law() {
  ControlLaw law{LoopStructure::full().with_compliance_compensation(), {}};
  for (const auto& gain : law.structure.gains()) {
    const std::string& s = gain.symbol;
    law.gains.push_back(s == "kr"    ? 0.25
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
  return law;
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
  auto law = to_state_space(pi_law());
  law.inputs[0] = "tacho";
  EXPECT_THAT(refusal([&] { antenna_state_space_controller(law); }),
              HasSubstr("inputs among tachometer, encoder, motor_torque, rate_disturbance, found "
                        "'tacho'"));
  law = to_state_space(pi_law());
  law.outputs[0] = "command";
  EXPECT_THAT(refusal([&] { antenna_state_space_controller(law); }),
              HasSubstr("outputs among valve_demand, rate_command, found 'command'"));
  law = plant::subsystem(to_state_space(pi_law()), {"tachometer", "encoder", "rate_disturbance"},
                         {"valve_demand"});
  EXPECT_THAT(refusal([&] { antenna_state_space_controller(law); }), HasSubstr("the first alone"));
  law = plant::subsystem(to_state_space(pi_law()), {"tachometer", "encoder"},
                         {"valve_demand", "rate_command"});
  EXPECT_THAT(refusal([&] { antenna_state_space_controller(law); }), HasSubstr("the second alone"));
  law = plant::subsystem(to_state_space(pi_law()), {"encoder"}, {"valve_demand"});
  EXPECT_THAT(refusal([&] { rate_loop_of(law); }), HasSubstr("found neither"));
  law.c.setConstant(std::nan(""));
  EXPECT_NE(refusal([&] { antenna_state_space_controller(law); }), "");
  EXPECT_NE(
      refusal([&] { ControlledAntenna(reference::antenna(), to_state_space(pi_law()), -1.0); }),
      "");
}

TEST(StateSpaceController, LoopGainsAreTheLawsOwn) {
  const auto plant = reference::antenna();
  const plant::PointResponse response(plant);
  for (const auto& law : {pi_law(), full_law()}) {
    ControlledAntenna loop(plant, to_state_space(law), delay);
    for (const double w : {1e-3, 0.05, 0.9, 5.3, 14.1, 70.0}) {
      const auto point = loop.at(w);
      for (std::size_t b = 0; b < 3; ++b) {
        const auto expected = loop_gain(response(w), w, law, delay, loop_breaks.at(b));
        EXPECT_LT(std::abs(point.loop_gain.at(b) - expected), 1e-9 * std::abs(expected))
            << w << " " << b;
      }
    }
  }
}

TEST(StateSpaceController, RateLoopIsTheLawsOwn) {
  const auto plant = reference::antenna();
  for (const auto& law : {pi_law(), full_law()}) {
    const auto rate = rate_loop_of(to_state_space(law));
    const auto expected = rate_loop_law(law);
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
  const auto law = to_state_space(pi_law());
  const PeakGain worst = worst_compliance(plant, law, delay);
  EXPECT_TRUE(worst.closed);
  ControlledAntenna loop(plant, law, delay);
  EXPECT_NEAR(std::abs(loop.at(worst.frequency).beam_by_wind), worst.lower, 1e-8 * worst.lower);
  double highest = 0.0;
  for (double w = 1e-3; w < 200.0; w *= 1.003) {
    highest = std::max(highest, std::abs(loop.at(w).beam_by_wind));
  }
  EXPECT_LE(highest, worst.upper);
  EXPECT_GT(highest, 0.99 * worst.lower);
}

TEST(ControlledCourse, PolesAreThoseOfTheRationalDeadTime) {
  const auto plant = reference::antenna();
  for (const auto& law : {pi_law(), full_law()}) {
    const ControlledCourse course(plant, to_state_space(law), delay);
    const double expected = numerics::spectral_abscissa(closed_loop(plant, law, delay).a);
    EXPECT_NEAR(course.abscissa(), expected, 1e-7 * std::abs(expected) + 1e-9);
  }
}

// Parseval: the integral of the squared impulse response is that of the squared response over
// frequency, which knows no period, no points and no Lyapunov equation.
double response_energy(ControlledAntenna& loop, const plant::AntennaPlant& plant, bool step) {
  const double final_value = step ? loop.at(1e-7).beam_by_wind.real() : 0.0;
  Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-6, 400.0, 3000);
  double sum = 0.0, before = 0.0;
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    std::complex<double> value = loop.at(w[i]).beam_by_wind;
    if (step) value = (value - final_value) / std::complex<double>(0.0, w[i]);
    const double density = std::norm(value) / std::numbers::pi;
    if (i > 0) sum += 0.5 * (density * w[i] + before * w[i - 1]) * std::log(w[i] / w[i - 1]);
    before = density;
  }
  return sum;
}

TEST(ControlledCourse, EnergyIsThatOfTheResponseWithExactDeadTime) {
  const auto plant = reference::antenna();
  for (const auto& law : {pi_law(), full_law()}) {
    const auto system = to_state_space(law);
    ControlledAntenna loop(plant, system, delay);
    const ControlledCourse course(plant, system, delay);
    const double impulse = course.score(TorqueCourse::impulse).integral_squared_error;
    EXPECT_NEAR(impulse, response_energy(loop, plant, false), 2e-5 * impulse);
    const double step = course.score(TorqueCourse::step).integral_squared_error;
    EXPECT_NEAR(step, response_energy(loop, plant, true), 2e-4 * step);
  }
}

// With integrators in the loop the encoder comes back to where it was: what is left of a constant
// torque is the bending that it does not see.
TEST(ControlledCourse, OnlyBendingIsLeftOfAConstantTorque) {
  const auto plant = reference::antenna();
  double bending = 0.0;
  for (const auto& mode : plant.structure.modes) {
    bending += mode.beam_weight * mode.wind_fraction / mode.stiffness;
  }
  const ControlledCourse course(plant, to_state_space(pi_law()), delay);
  EXPECT_NEAR(course.score(TorqueCourse::step).final_value, bending, 1e-8 * bending);
  const auto sampled = antenna_state_space_controller(plant::subsystem(
      sampled_law(pi_law(), sample_time), {"tachometer", "encoder"}, {"valve_demand"}));
  const ControlledCourse other(plant, sampled, delay);
  EXPECT_NEAR(other.score(TorqueCourse::step).final_value, bending, 1e-8 * bending);
}

// Without integrators: valve, leakage and gains in series under a constant torque T. The motor
// stands, K xv = lambda T, and xv = -kr kp angle.
TEST(ControlledCourse, StaticComplianceWithoutIntegralIsLeakageOverTheGains) {
  const auto plant = reference::antenna();
  const double kr = 0.2, kp = 0.2;
  plant::StateSpace law = plant::static_gain(Eigen::RowVector2d{-kr, -kr * kp},
                                             {"tachometer", "encoder"}, {"valve_demand"});
  const ControlledCourse course(plant, law, delay);
  ASSERT_TRUE(course.stable());
  double bending = 0.0;
  for (const auto& mode : plant.structure.modes) {
    bending += mode.beam_weight * mode.wind_fraction / mode.stiffness;
  }
  const double expected =
      plant.drive.leakage_rate / (plant.drive.oil_stiffness * kr * kp) + bending;
  const auto score = course.score(TorqueCourse::step);
  EXPECT_NEAR(score.final_value, expected, 1e-9 * expected);
  // A loop as slow as this one creeps to its end and has no peak.
  EXPECT_NEAR(score.peak, expected, 1e-9 * expected);
  EXPECT_EQ(score.time_of_peak, std::numeric_limits<double>::infinity());
  ControlledAntenna loop(plant, law, delay);
  EXPECT_NEAR(loop.at(1e-6).beam_by_wind.real(), expected, 1e-6 * expected);
}

TEST(ControlledCourse, ImpulseIsTheDerivativeOfTheStep) {
  const auto plant = reference::antenna();
  const auto law = to_state_space(pi_law());
  const ControlledCourse course(plant, law, delay);
  const auto step = course.beam(TorqueCourse::step, 20.0);
  const auto impulse = course.beam(TorqueCourse::impulse, 20.0);
  double sum = 0.0, largest = 0.0;
  for (const auto& point : step) largest = std::max(largest, std::abs(point.beam));
  for (std::size_t i = 1; i < step.size(); ++i) {
    sum += 0.5 * (impulse[i].beam + impulse[i - 1].beam) * (impulse[i].time - impulse[i - 1].time);
    ASSERT_NEAR(sum, step[i].beam, 1e-4 * largest);
  }
}

// The rational dead time of order 8 is right to 1e-7 here, its system's H2 norm is a Lyapunov
// equation of other states.
TEST(ControlledCourse, EnergyIsTheSquaredNormOfTheRationalLoop) {
  const auto plant = reference::antenna();
  const auto rational =
      plant::subsystem(closed_loop(plant, pi_law(), delay), {"wind_torque"}, {"beam"});
  const ControlledCourse course(plant, to_state_space(pi_law()), delay);
  const double norm = h2_norm(rational).value;
  EXPECT_NEAR(course.score(TorqueCourse::impulse).integral_squared_error, norm * norm,
              1e-7 * norm * norm);
}

TEST(ControlledCourse, ReturnsWithinItsShareAndStaysThere) {
  const auto plant = reference::antenna();
  const ControlledCourse course(plant, to_state_space(pi_law()), delay);
  const auto score = course.score(TorqueCourse::impulse);
  ASSERT_TRUE(score.return_time);
  double peak = 0.0, last = 0.0;
  for (const auto& point : course.beam(TorqueCourse::impulse, score.horizon)) {
    peak = std::max(peak, std::abs(point.beam));
    if (std::abs(point.beam) > 0.05 * score.peak) last = point.time;
  }
  EXPECT_NEAR(score.peak, peak, 1e-3 * peak);
  EXPECT_GE(score.peak, peak * (1.0 - 1e-12));
  EXPECT_NEAR(*score.return_time, last, 2.0 * delay);
}

TEST(ControlledCourse, FinerSamplesComeNearTheContinuousLoop) {
  const auto plant = reference::antenna();
  const auto law = pi_law();
  // One and a half fine samples of delay of its own.
  const double fine = 1e-3;
  const auto sampled =
      plant::subsystem(sampled_law(law, fine), {"tachometer", "encoder"}, {"valve_demand"});
  const auto one = ControlledCourse(plant, sampled, 0.0).score(TorqueCourse::impulse);
  const auto other =
      ControlledCourse(plant, to_state_space(law), 1.5 * fine).score(TorqueCourse::impulse);
  EXPECT_NEAR(one.peak, other.peak, 1e-4 * other.peak);
  EXPECT_NEAR(one.integral_squared_error, other.integral_squared_error,
              1e-4 * other.integral_squared_error);
}

TEST(ControlledCourse, FollowsASampledControllerAsItsClosedLoopDoes) {
  const auto plant = reference::antenna();
  const auto law = plant::subsystem(sampled_law(pi_law(), sample_time), {"tachometer", "encoder"},
                                    {"valve_demand"});
  const ControlledCourse course(plant, law, 0.0);
  const SampledLoop loop{plant::to_state_space(plant),
                         plant::renamed(law, {{"valve_demand", "valve_command"}}), sample_time};
  const auto closed = sampled_closed_loop(loop);
  EXPECT_NEAR(course.spectral_radius(), numerics::eigenvalues(closed.a).cwiseAbs().maxCoeff(),
              1e-9);
  // The same certified gain from either, and the response near it but for the hold of the torque.
  const PeakGain worst = worst_compliance(plant, law, 0.0);
  EXPECT_TRUE(worst.closed);
  ControlledAntenna response(plant, law, 0.0);
  EXPECT_NEAR(std::abs(response.at(worst.frequency).beam_by_wind), worst.lower, 5e-3 * worst.lower);
}

TEST(ControlledCourse, OtherStatesScoreTheSame) {
  const auto plant = reference::antenna();
  reference::RandomNumbers random(7);
  auto law = to_state_space(full_law());
  const auto before = ControlledCourse(plant, law, delay).score(TorqueCourse::step);
  const Eigen::Index n = law.a.rows();
  Eigen::MatrixXd t = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) t(i, j) = random.uniform(-1.0, 1.0);
    t.row(i) *= random.log_uniform(0.1, 10.0);
  }
  const Eigen::MatrixXd back =
      numerics::linear_solve(t, Eigen::MatrixXd::Identity(n, n), "change of state");
  law.a = t * law.a * back;
  law.b = t * law.b;
  law.c = law.c * back;
  const auto after = ControlledCourse(plant, law, delay).score(TorqueCourse::step);
  EXPECT_NEAR(after.peak, before.peak, 1e-9 * before.peak);
  EXPECT_NEAR(after.integral_squared_error, before.integral_squared_error,
              1e-8 * before.integral_squared_error);
}

TEST(ControlledCourse, RefusesToScoreAnUnstableLoop) {
  auto law = to_state_space(pi_law());
  law.c *= 40.0;
  law.d *= 40.0;
  const ControlledCourse course(reference::antenna(), law, delay);
  EXPECT_FALSE(course.stable());
  EXPECT_GT(course.abscissa(), 0.0);
  EXPECT_THROW(course.score(TorqueCourse::step), NumericalFailure);
}

TEST(ControlledCourse, SplitsTheDeadTimeForFastPoles) {
  const auto plant = reference::antenna();
  // A lag far beyond the loop changes next to nothing; the period must follow it.
  auto law = to_state_space(pi_law());
  const auto lag = plant::rational({1.0}, {1.0, 1.0 / 2000.0}, "slow", "valve_demand", "lag");
  const auto fast = plant::connect({plant::renamed(law, {{"valve_demand", "slow"}}), lag},
                                   {"tachometer", "encoder", "rate_disturbance"},
                                   {"valve_demand", "rate_command"});
  const ControlledCourse course(plant, fast, delay);
  EXPECT_LT(course.period(), 0.5 * delay);
  const double later = 1.0 / 2000.0;  // a fast lag is a little dead time
  const auto expected = ControlledCourse(plant, law, delay + later).score(TorqueCourse::impulse);
  const auto found = course.score(TorqueCourse::impulse);
  EXPECT_NEAR(found.peak, expected.peak, 1e-5 * expected.peak);
  EXPECT_NEAR(found.integral_squared_error, expected.integral_squared_error,
              1e-5 * expected.integral_squared_error);
}

}  // namespace
}  // namespace boresight::control
