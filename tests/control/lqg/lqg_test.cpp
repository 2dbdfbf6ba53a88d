#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/antenna_in_wind.hpp>
#include <boresight/control/lqg/lqg.hpp>
#include <boresight/control/lqg/noise_effort_lqg.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>
#include <boresight/plant/linear/covariance_propagation.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::control {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double period = 0.02;

// A lightly damped load on a drive, disturbed through a first-order filter.
plant::StateSpace drive() {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(5, 5);
  a.topLeftCorner(4, 4) << 0.0, 1.0, 0.0, 0.0, -90.0, -1.2, 80.0, 0.0, 0.0, 0.0, 0.0, 1.0, 70.0,
      0.0, -300.0, -2.0;
  a(3, 4) = 8.0;
  a(4, 4) = -0.7;
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(5, 2), c = Eigen::MatrixXd::Zero(3, 5);
  b(1, 0) = 1.0;
  b(4, 1) = 1.0;
  c(0, 0) = 1.0;
  c(1, 1) = 0.5;
  c(1, 2) = 1.0;
  c(2, 2) = 1.0;
  auto system = reference::state_space(a, b, c, Eigen::MatrixXd::Zero(3, 2));
  system.inputs = {"torque", "wind"};
  system.outputs = {"angle", "mixed", "load"};
  return system;
}

LqgProblem problem_of(double delay, double weight = 1e-4) {
  return {drive(),
          {"torque"},
          {"angle", "mixed"},
          period,
          delay,
          {{"wind", 0.3}},
          {{"angle", 1e-6}, {"mixed", 4e-5}},
          {{"load", 1.0}, {"angle", 0.2}},
          {{"torque", weight}}};
}

// What the problem charges, found by the covariance of the closed loop; noise alone or all.
struct EvaluatedCost {
  double outputs = 0.0, command = 0.0;
};

EvaluatedCost evaluate(const LqgProblem& problem, const plant::StateSpace& controller,
                       bool disturbed = true) {
  const std::string& command = problem.commands[0];
  const auto held = plant::static_gain(Eigen::MatrixXd::Ones(1, 1), {command}, {"acting_command"});
  std::vector<std::string> outputs = problem.plant.outputs;
  outputs.emplace_back("acting_command");
  const auto with_held = plant::connect({problem.plant, held}, problem.plant.inputs, outputs);
  SampledLoopNoise noise;
  if (disturbed) noise.disturbance_intensity = problem.disturbance_intensity;
  noise.measurement_variance = problem.measurement_variance;
  std::vector<std::string> asked;
  for (const auto& [name, weight] : problem.output_weight) asked.push_back(name);
  asked.emplace_back("acting_command");
  const Eigen::VectorXd rms =
      sampled_loop_rms({with_held, controller, problem.computation_delay}, noise, asked).over_time;
  EvaluatedCost cost;
  for (std::size_t i = 0; i + 1 < asked.size(); ++i) {
    cost.outputs +=
        problem.output_weight.at(asked[i]) * std::pow(rms[static_cast<Eigen::Index>(i)], 2);
  }
  cost.command = std::pow(rms[rms.size() - 1], 2);
  return cost;
}

double evaluated(const LqgProblem& problem, const plant::StateSpace& controller) {
  const EvaluatedCost cost = evaluate(problem, controller);
  return cost.outputs + problem.command_weight.at(problem.commands[0]) * cost.command;
}

TEST(Lqg, CostsWhatTheClosedLoopShowsAtAnyDelay) {
  for (const double delay : {0.0, 0.3, 1.0, 1.6, 2.0}) {
    const LqgProblem problem = problem_of(delay * period);
    const LqgDesign design = lqg(problem);
    EXPECT_NEAR(evaluated(problem, design.controller) / design.cost, 1.0, 1e-9) << delay;
    EXPECT_LT(design.full_information_cost, design.cost);
  }
}

TEST(Lqg, HasThePolesOfRegulatorAndEstimator) {
  const LqgProblem problem = problem_of(1.3 * period);
  const LqgDesign design = lqg(problem);
  const auto closed =
      sampled_closed_loop({problem.plant, design.controller, problem.computation_delay});
  std::vector<std::complex<double>> expected(design.regulator.poles.begin(),
                                             design.regulator.poles.end());
  expected.insert(expected.end(), design.estimator.poles.begin(), design.estimator.poles.end());
  const Eigen::VectorXcd found = numerics::eigenvalues(closed.a);
  ASSERT_EQ(static_cast<std::size_t>(found.size()), expected.size());
  // As polynomials of both sets: at points about the unit circle.
  for (const double angle : {0.1, 0.7, 1.9, 3.0}) {
    const std::complex<double> z = std::polar(1.2, angle);
    std::complex<double> ratio = 1.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ratio *= (z - expected[i]) / (z - found[static_cast<Eigen::Index>(i)]);
    }
    EXPECT_LT(std::abs(ratio - 1.0), 1e-6);
  }
}

TEST(Lqg, IsNotBeatenByAnyChangeOfItsGains) {
  const LqgProblem problem = problem_of(period);
  const SampledLqgProblem sampled = sampled_problem(problem);
  const LqgDesign design = lqg(problem);
  reference::RandomNumbers random(7);
  for (const double size : {1e-3, 1e-2, 0.1}) {
    for (int i = 0; i < 20; ++i) {
      LqRegulator regulator = design.regulator;
      StateEstimator estimator = design.estimator;
      Eigen::MatrixXd& gain = i % 2 == 0 ? regulator.gain : estimator.gain;
      gain.array() *= 1.0 + size * random.matrix(gain.rows(), gain.cols()).array();
      const double cost = evaluated(problem, lqg_controller(sampled, regulator, estimator));
      EXPECT_GT(cost, design.cost * (1.0 - 1e-9));
    }
  }
}

// x'' = u + w, cost q x^2 + r u^2, position measured. With a = (q/r)^(1/4), f = (W/V)^(1/4) the
// continuous gains are [a^2, sqrt(2) a] and [sqrt(2) f, f^2] (B. D. O. Anderson, J. B. Moore,
// Optimal Control, 1990), which the sampled ones approach with the sample time.
TEST(Lqg, ApproachesTheClosedFormOfTheDoubleIntegrator) {
  Eigen::Matrix2d a;
  a << 0.0, 1.0, 0.0, 0.0;
  Eigen::MatrixXd b(2, 2);
  b << 0.0, 0.0, 1.0, 1.0;
  auto system =
      reference::state_space(a, b, Eigen::RowVector2d(1.0, 0.0), Eigen::RowVector2d::Zero());
  system.inputs = {"u", "w"};
  system.outputs = {"x"};
  const double q = 3.0, r = 0.2, w = 0.7, v = 0.05;
  const double c = std::pow(q / r, 0.25), f = std::pow(w / v, 0.25), root = std::sqrt(2.0);
  const double exact =
      r * root * c * w + r * v *
                             (root * std::pow(c, 4) * f + 2.0 * root * std::pow(c, 3) * f * f +
                              2.0 * root * c * c * std::pow(f, 3));
  double last = 1.0;
  for (const double sample_time : {4e-3, 1e-3, 2.5e-4}) {
    const LqgDesign design = lqg({system,
                                  {"u"},
                                  {"x"},
                                  sample_time,
                                  0.0,
                                  {{"w", w}},
                                  {{"x", v / sample_time}},
                                  {{"x", q}},
                                  {{"u", r}}});
    const double error = std::abs(design.cost / exact - 1.0);
    EXPECT_LT(error, 3.0 * sample_time * c);
    EXPECT_LT(error, 0.3 * last);
    last = error;
    EXPECT_NEAR(design.regulator.gain(0, 0), c * c, 5.0 * sample_time * c * c);
    EXPECT_NEAR(design.regulator.gain(0, 1), root * c, 5.0 * sample_time * root * c);
    EXPECT_NEAR(design.estimator.gain(0, 0) / sample_time, root * f, 10.0 * sample_time * root * f);
    EXPECT_NEAR(design.estimator.gain(1, 0) / sample_time, f * f, 10.0 * sample_time * f * f);
  }
}

// The antenna, its wind and sensors; weight of the beam 1/rad^2 of motor.
LqgProblem antenna_problem(double weight) {
  const SensorNoise noise = reference::sensor_noise();
  const Eigen::ArrayXd frequency =
      Eigen::ArrayXd::LinSpaced(200, std::log(5e-4), std::log(5.0)).exp();
  const auto filter = plant::fit_shaping_filter(
      frequency, frequency.unaryExpr([](double f) { return reference::motor_wind_spectrum(f); }),
      4);
  const auto variance = [&](double rms) { return sample_variance(rms, noise.bandwidth, period); };
  return {antenna_in_wind(reference::antenna(), filter),
          {"valve_command"},
          {"tachometer", "encoder", "motor_torque"},
          period,
          period,
          {{"wind_white_noise", 1.0}},
          {{"tachometer", variance(noise.tachometer_rms)},
           {"encoder", variance(noise.encoder_rms)},
           {"motor_torque", variance(noise.torque_rms)}},
          {{"beam", 1.0}},
          {{"valve_command", weight}}};
}

TEST(Lqg, CostsWhatTheAntennasClosedLoopShows) {
  for (const double weight : {1e-6, 1e-3, 1.0}) {
    const LqgProblem problem = antenna_problem(weight);
    const LqgDesign design = lqg(problem);
    EXPECT_NEAR(evaluated(problem, design.controller) / design.cost, 1.0, 1e-7) << weight;
    EXPECT_LT(design.regulator.relative_residual, 1e-14);
    EXPECT_LT(design.estimator.relative_residual, 1e-14);
  }
}

// Half an hour of seeded noise through the closed loop step by step, against its covariance.
TEST(Lqg, SwaysTheAntennaInASimulationAsItsCovarianceSays) {
  const LqgProblem problem = antenna_problem(1e-3);
  const LqgDesign design = lqg(problem);
  const SampledLoop loop{problem.plant, design.controller, period};
  const auto closed = sampled_closed_loop(loop);
  SampledLoopNoise noise{problem.disturbance_intensity, problem.measurement_variance};
  const std::vector<std::string> outputs{"beam", "encoder", "held_command"};
  const auto expected = sampled_loop_rms(loop, noise, outputs);

  const Eigen::Index n = problem.plant.a.rows(), size = closed.a.rows();
  const Eigen::VectorXd drive =
      problem.plant.b.col(plant::input_index(problem.plant, "wind_white_noise"));
  const Eigen::MatrixXd wind = numerics::semidefinite_factor(
      plant::propagate_covariance(problem.plant.a, drive * drive.transpose(),
                                  Eigen::MatrixXd::Zero(n, n), period)
          .end,
      "wind of one sample");
  Eigen::VectorXd deviation(3);
  Eigen::MatrixXd jolt(size, 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::string& name = problem.measured[static_cast<std::size_t>(i)];
    deviation[i] = std::sqrt(problem.measurement_variance.at(name));
    jolt.col(i) = closed.b.col(plant::input_index(closed, name + "_noise"));
  }
  const numerics::NormalNumbers normal(20);
  std::uint64_t drawn = 0;
  const auto fill = [&](Eigen::VectorXd& numbers) {
    for (double& number : numbers) number = normal.pair(drawn++).real();
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size), kick(wind.cols()), error(3);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  constexpr int lead = 5000, samples = 1000000;
  Eigen::MatrixXd seen(3, size);
  for (Eigen::Index i = 0; i < 3; ++i) {
    seen.row(i) = closed.c.row(plant::output_index(closed, outputs[static_cast<std::size_t>(i)]));
  }
  for (int k = -lead; k < samples; ++k) {
    if (k >= 0) sum += (seen * x).cwiseAbs2();
    fill(kick);
    fill(error);
    x = closed.a * x + jolt * deviation.cwiseProduct(error);
    x.head(n) += wind * kick;
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::sqrt(sum[i] / samples) / expected.at_samples[i], 1.0, 0.03)
        << outputs[static_cast<std::size_t>(i)];
  }
}

TEST(NoiseEffortLqg, CostsWhatTheClosedLoopShows) {
  for (const double delay : {0.0, 1.0, 1.6}) {
    const LqgProblem problem = problem_of(delay * period, 1e-7);
    for (const double weight : {1e-5, 1e-3}) {
      const auto design = noise_effort_lqg(problem, weight);
      const double found = evaluated(problem, design.controller) +
                           weight * evaluate(problem, design.controller, false).command;
      EXPECT_NEAR(found / design.cost, 1.0, 1e-8) << delay << " " << weight;
      // The LQG of the same total weight also charges the fraction of the command that the wind
      // causes.
      LqgProblem alike = problem;
      alike.command_weight["torque"] = weight;
      const auto other = lqg(alike).controller;
      EXPECT_LT(design.cost,
                evaluated(problem, other) + weight * evaluate(problem, other, false).command);
    }
  }
}

// Without disturbances the noise drives all of the command: an LQG problem again.
TEST(NoiseEffortLqg, IsTheLqgWhereThereIsNothingButNoise) {
  LqgProblem problem = problem_of(period, 1e-6);
  problem.disturbance_intensity.clear();
  const auto free = noise_effort_lqg(problem, 1e-4);
  LqgProblem charged = problem;
  charged.command_weight["torque"] = 1e-6 + 1e-4;
  EXPECT_NEAR(free.cost, lqg(charged).cost, 1e-12);
}

TEST(NoiseEffortLqg, BoundsEveryControllerOfTheSameEffort) {
  const LqgProblem problem = antenna_problem(1e-8);
  const SensorNoise noise = reference::sensor_noise();
  double last_cost = 0.0, last_slope = 1e300, last_weight = 0.0;
  std::vector<std::pair<double, double>> costs;
  for (const double weight : {2e-4, 5e-4, 1e-3, 3e-3, 2e-2}) {
    const double cost = noise_effort_lqg(problem, weight).cost;
    const double slope = (cost - last_cost) / (weight - last_weight);
    EXPECT_GT(cost, last_cost);
    EXPECT_LT(slope, last_slope);  // concave
    last_cost = cost, last_slope = slope, last_weight = weight;
    costs.emplace_back(weight, cost);
  }
  for (const double weight : {1e-4, 1e-3, 1e-2, 0.1}) {
    LqgProblem charged = problem;
    charged.command_weight["valve_command"] = weight;
    for (const double input_noise : {0.0, 0.01, 1.0}) {
      charged.disturbance_intensity["valve_command"] = input_noise;
      const auto pointing =
          sampled_pointing({problem.plant, lqg(charged).controller, period}, noise);
      double closest = 0.0;
      for (const auto& [w, cost] : costs) {
        closest = std::max(closest, cost - w * pointing.control_effort * pointing.control_effort);
      }
      EXPECT_GT(pointing.boresight_rms * pointing.boresight_rms, closest * (1.0 - 1e-4));
      if (weight == 1e-3 && input_noise == 0.0) {
        EXPECT_NEAR(pointing.boresight_rms / std::sqrt(closest), 1.0, 0.01);  // and closely
      }
    }
  }
}

TEST(Lqg, RefusesWhatItCannotSolve) {
  const auto refused = [](auto change, const char* why) {
    LqgProblem problem = problem_of(period);
    change(problem);
    EXPECT_THAT(reference::Call([&] { lqg(problem); }),
                ThrowsMessage<InvalidInput>(HasSubstr(why)));
  };
  refused([](auto& p) { p.commands = {"force"}; },
          "expected each command to be one of torque, wind, found 'force'");
  refused([](auto& p) { p.measured.emplace_back("speed"); }, "expected each measured output to be");
  refused([](auto& p) { p.measurement_variance.erase("mixed"); },
          "expected each measurement variance to be given, found none of 'mixed'");
  refused([](auto& p) { p.measurement_variance["angle"] = 0.0; },
          "expected each measurement variance above 0, found 0 of 'angle'");
  refused([](auto& p) { p.command_weight["torque"] = -1.0; },
          "expected each command weight above 0, found -1 of 'torque'");
  refused([](auto& p) { p.output_weight.clear(); }, "found 1, 2 and 0");
  refused([](auto& p) { p.output_weight["load"] = -2.0; },
          "expected each output weight of at least 0, found -2 of 'load'");
  refused([](auto& p) { p.disturbance_intensity["gust"] = 1.0; },
          "expected each disturbance intensity to be one of torque, wind, found 'gust'");
  refused([](auto& p) { p.plant.d(2, 1) = 1.0; }, "without a lag");
  refused(
      [](auto& p) {
        p.plant.d(0, 0) = 1.0;
        p.computation_delay = 0.0;
      },
      "reaches a measured output without delay");
  EXPECT_THAT(reference::Call([] { noise_effort_lqg(problem_of(period), 0.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a noise_effort_weight above 0")));
  EXPECT_THAT(reference::Call([] {
                LqgProblem problem = problem_of(period);
                problem.commands.emplace_back("wind");
                problem.command_weight["wind"] = 1.0;
                noise_effort_lqg(problem, 1.0);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected one command, found 2")));
}

TEST(AntennaInWind, HearsOnlyTheSensorsThatTheControllerTakes) {
  const LqgProblem problem = antenna_problem(1.0);
  const Controller controller{LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}};
  SensorNoise noise = reference::sensor_noise();
  const auto loop = sampled_loop(problem.plant, controller, period);
  const auto found = sampled_pointing(loop, noise);
  EXPECT_NEAR(found.boresight_rms, std::hypot(found.wind_rms, found.noise_rms), 1e-15);
  noise.torque_rms *= 100.0;
  EXPECT_EQ(sampled_pointing(loop, noise).noise_rms, found.noise_rms);
  noise.encoder_rms *= 2.0;
  noise.tachometer_rms *= 2.0;
  EXPECT_NEAR(sampled_pointing(loop, noise).control_effort, 2.0 * found.control_effort,
              1e-9 * found.control_effort);
  EXPECT_DOUBLE_EQ(sample_variance(0.3, 25.0, 0.02), 0.09);
  EXPECT_DOUBLE_EQ(sample_variance(0.3, 25.0, 0.01), 0.18);
}

// The continuous form with its dead time of one sample and half a hold, by another route.
TEST(AntennaInWind, SwaysLikeTheContinuousFormUnderASlowController) {
  const LqgProblem problem = antenna_problem(1.0);
  const auto evaluator_noise = reference::sensor_noise();
  const Controller controller{LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}};
  auto evaluator = reference::loop_evaluator(reference::antenna());
  const auto expected = evaluator.evaluate(controller, false);
  const auto found =
      sampled_pointing(sampled_loop(problem.plant, controller, period), evaluator_noise);
  EXPECT_NEAR(found.wind_rms / std::sqrt(expected.wind_variance), 1.0, 0.01);
  EXPECT_NEAR(found.noise_rms / std::sqrt(expected.noise_variance), 1.0, 0.01);
}

}  // namespace
}  // namespace boresight::control
