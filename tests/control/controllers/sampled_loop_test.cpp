#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_loop.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::control {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double period = 0.02;

// A drive: torque and wind to rate and angle, with a lightly damped load.
plant::StateSpace drive() {
  Eigen::Matrix4d a;
  a << 0.0, 1.0, 0.0, 0.0, -90.0, -1.2, 80.0, 0.0, 0.0, 0.0, 0.0, 1.0, 70.0, 0.0, -300.0, -2.0;
  Eigen::MatrixXd b(4, 2), c(2, 4);
  b << 0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 8.0;
  c << 1.0, 0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 0.0;
  auto system = reference::state_space(a, b, c, Eigen::MatrixXd::Zero(2, 2));
  system.inputs = {"torque", "wind"};
  system.outputs = {"angle", "mixed"};
  return system;
}

// torque[k] from the reference and the measured angle; two states.
plant::StateSpace controller() {
  Eigen::Matrix2d a;
  a << 1.0, 0.0, 0.0, 0.4;
  Eigen::Matrix2d b;
  b << period, -period, 0.0, -1.0;
  auto system = reference::state_space(a, b, Eigen::RowVector2d(30.0, -8.0),
                                       Eigen::RowVector2d(0.0, 20.0), period);
  system.inputs = {"reference", "angle"};
  system.outputs = {"torque"};
  system.states = {"integral", "lag"};
  return system;
}

SampledLoop loop_with(double delay) {
  return {drive(), controller(), delay};
}

TEST(SampledClosedLoop, NamesItsSignalsAndStates) {
  const auto closed = sampled_closed_loop(loop_with(1.3 * period));
  EXPECT_THAT(closed.inputs, ElementsAre("wind", "reference", "angle_noise"));
  EXPECT_THAT(closed.outputs, ElementsAre("angle", "mixed", "torque"));
  EXPECT_THAT(closed.states, ElementsAre("x1", "x2", "x3", "x4", "torque_held_1", "torque_held_2",
                                         "integral", "lag"));
  EXPECT_EQ(closed.sample_time, period);
}

// Step by step: the plant simulated in twentieths of a period with the command that acts there.
TEST(SampledClosedLoop, IsTheLoopSimulatedBetweenTheSamples) {
  reference::RandomNumbers random(95);
  constexpr int parts = 20;
  for (const int late : {0, 7, 20, 33, 60}) {
    const auto closed = sampled_closed_loop(loop_with(late * period / parts));
    const Eigen::Index samples = 40;
    const Eigen::MatrixXd u = random.matrix(samples, 3);
    const Eigen::MatrixXd expected = plant::LinearSimulation(closed, period).simulate(u);

    const auto fast = plant::sample(drive(), period / parts);
    const auto compensator = controller();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(4), z = Eigen::VectorXd::Zero(2);
    std::vector<double> commands;
    for (Eigen::Index k = 0; k < samples; ++k) {
      const Eigen::Vector2d y = fast.c * x;
      const Eigen::Vector2d in(u(k, 1), y[0] + u(k, 2));
      commands.push_back((compensator.c * z + compensator.d * in)(0));
      EXPECT_NEAR(expected(k, 0), y[0], 1e-12) << late << ", " << k;
      EXPECT_NEAR(expected(k, 1), y[1], 1e-12);
      EXPECT_NEAR(expected(k, 2), commands.back(), 1e-11);
      z = compensator.a * z + compensator.b * in;
      for (int part = 0; part < parts; ++part) {
        const int since = static_cast<int>(k) * parts + part - late;
        const double acting = since < 0 ? 0.0 : commands[static_cast<std::size_t>(since / parts)];
        x = fast.a * x + fast.b * Eigen::Vector2d(acting, u(k, 0));
      }
    }
  }
}

TEST(SampledOpenLoop, ClosesToThePolesOfTheClosedLoop) {
  for (const double delay : {0.0, 0.4 * period, 2.0 * period}) {
    const auto open = sampled_open_loop(loop_with(delay), "torque");
    EXPECT_THAT(open.inputs, ElementsAre("torque"));
    EXPECT_THAT(open.outputs, ElementsAre("torque_returned"));
    const auto closed = plant::feedback(
        open, plant::static_gain(Eigen::MatrixXd::Ones(1, 1), {"torque_returned"}, {"torque"}));
    const auto expected = numerics::eigenvalues(sampled_closed_loop(loop_with(delay)).a);
    const auto found = numerics::eigenvalues(closed.a);
    for (const auto pole : found) {
      EXPECT_LT((expected.array() - pole).abs().minCoeff(), 1e-9) << delay;
    }
    // Its response is minus plant times controller, with the delay exact at whole samples.
    if (delay == 0.4 * period) continue;
    const double w = 9.0;
    const auto prompt = plant::sample(drive(), period);
    const auto expected_response = -frequency_response(prompt, w)(0, 0) *
                                   frequency_response(controller(), w)(0, 1) *
                                   std::polar(1.0, -w * delay);
    EXPECT_LT(reference::relative_error(frequency_response(open, w)(0, 0), expected_response),
              1e-12);
  }
}

TEST(SampledOpenLoop, OfOneOfTwoCommandsKeepsTheOtherClosed) {
  reference::RandomNumbers random(96);
  auto plant =
      reference::state_space(random.matrix(3, 3) - 2.0 * Eigen::MatrixXd::Identity(3, 3),
                             random.matrix(3, 2), random.matrix(2, 3), Eigen::MatrixXd::Zero(2, 2));
  auto compensator =
      reference::state_space(0.3 * random.matrix(2, 2), random.matrix(2, 2),
                             0.3 * random.matrix(2, 2), 0.2 * random.matrix(2, 2), 0.1);
  compensator.inputs = {"y2", "y1"};
  compensator.outputs = {"u2", "u1"};
  compensator.states = {"c1", "c2"};
  const SampledLoop loop{plant, compensator, 0.05};
  const auto poles = numerics::eigenvalues(sampled_closed_loop(loop).a);
  for (const char* command : {"u1", "u2"}) {
    const auto open = sampled_open_loop(loop, command);
    for (const auto pole : numerics::eigenvalues(open.a - open.b * open.c / (1.0 + open.d(0, 0)))) {
      EXPECT_LT((poles.array() - pole).abs().minCoeff(), 1e-9);
    }
  }
}

TEST(SampledLoopRms, OfAnIntegratorUnderAGainIsTheClosedForm) {
  // dx/dt = u + w, u = -g (x[k] + v[k]): x[k+1] = (1 - g T) x - g T v + w_k.
  auto body = plant::rational({1.0}, {0.0, 1.0}, "u", "x", "x");
  body.b.conservativeResize(1, 2);
  body.b(0, 1) = 1.0;
  body.d = Eigen::MatrixXd::Zero(1, 2);
  body.inputs.emplace_back("w");
  for (const double part : {0.1, 0.9, 1.7}) {  // g T
    auto gain = plant::static_gain(Eigen::MatrixXd::Constant(1, 1, -part / period), {"x"}, {"u"});
    gain.sample_time = period;
    const double q = 3.0, r = 0.2;
    const auto found = sampled_loop_rms({body, gain, 0.0}, {{{"w", q}}, {{"x", r}}}, {"x"});
    const double p = (q * period + part * part * r) / (1.0 - (1.0 - part) * (1.0 - part));
    EXPECT_NEAR(found.at_samples[0], std::sqrt(p), 1e-12 * std::sqrt(p));
    const double mean =
        p * (1.0 - part + part * part / 3.0) + r * part * part / 3.0 + 0.5 * q * period;
    EXPECT_NEAR(found.over_time[0], std::sqrt(mean), 1e-12 * std::sqrt(mean));
  }
}

// The same by a route of its own: the covariance of plant, commands under way and controller in
// steps of a fortieth of a period, until it repeats; the mean square by Simpson's rule.
struct FineRms {
  Eigen::VectorXd at_samples, over_time;
};
FineRms fine_rms(int late, double intensity, double variance) {
  constexpr int parts = 40;
  const auto plant = drive();
  const auto compensator = controller();
  const auto fast = plant::sample(plant, period / parts);
  // Noise of one step: Simpson over ten sub-steps.
  const auto tenth = plant::sample(plant, period / parts / 10.0);
  Eigen::MatrixXd step_noise = Eigen::MatrixXd::Zero(4, 4);
  Eigen::VectorXd spread = plant.b.col(1);
  for (int i = 0; i <= 10; ++i) {
    const double weight = i == 0 || i == 10 ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    step_noise += weight / 30.0 * period / parts * intensity * spread * spread.transpose();
    spread = (tenth.a * spread).eval();
  }
  // [x, acting, next, next but one, controller]
  const Eigen::Index all = 4 + 3 + 2;
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(all, all);
  Eigen::MatrixXd move = Eigen::MatrixXd::Identity(all, all);
  move.topLeftCorner(4, 4) = fast.a;
  move.block(0, 4, 4, 1) = fast.b.col(0);
  Eigen::MatrixXd arrive = Eigen::MatrixXd::Identity(all, all);
  arrive.block(4, 4, 3, 3) << 0, 1, 0, 0, 0, 1, 0, 0, 1;
  // At a sample: the command goes to the first free place.
  const int waiting = late / parts;  // commands under way just after a sample, but for the new one
  Eigen::MatrixXd sample = Eigen::MatrixXd::Identity(all, all),
                  jolt = Eigen::MatrixXd::Zero(all, 1);
  const Eigen::Index place = 4 + waiting + 1;
  sample.row(place).setZero();
  sample.block(place, 0, 1, 4) = compensator.d(0, 1) * plant.c.row(0);
  sample.block(place, 7, 1, 2) = compensator.c;
  sample.block(7, 0, 2, 4) = compensator.b.col(1) * plant.c.row(0);
  sample.block(7, 7, 2, 2) = compensator.a;
  jolt(place, 0) = compensator.d(0, 1);
  jolt.block(7, 0, 2, 1) = compensator.b.col(1);
  FineRms result{Eigen::VectorXd(2), Eigen::VectorXd(2)};
  for (int k = 0; k < 4000; ++k) {
    result.at_samples = (plant.c * p.topLeftCorner(4, 4) * plant.c.transpose()).diagonal();
    p = (sample * p * sample.transpose() + variance * jolt * jolt.transpose()).eval();
    result.over_time = Eigen::VectorXd::Zero(2);
    for (int i = 0; i <= parts; ++i) {
      if (i % parts == late % parts && i < parts) p = (arrive * p * arrive.transpose()).eval();
      const double weight = i == 0 || i == parts ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
      result.over_time += weight / (3.0 * parts) *
                          (plant.c * p.topLeftCorner(4, 4) * plant.c.transpose()).diagonal();
      if (i == parts) break;
      p = (move * p * move.transpose()).eval();
      p.topLeftCorner(4, 4) += step_noise;
    }
  }
  result.at_samples = result.at_samples.cwiseSqrt();
  result.over_time = result.over_time.cwiseSqrt();
  return result;
}

TEST(SampledLoopRms, AgreesWithACovarianceInFineSteps) {
  const double q = 0.1, r = 0.3;
  for (const int late : {0, 12, 40, 58}) {
    const auto found = sampled_loop_rms(loop_with(late * period / 40.0),
                                        {{{"wind", q}}, {{"angle", r}}}, {"angle", "mixed"});
    const FineRms fine = fine_rms(late, q, r);
    for (const Eigen::Index i : {0, 1}) {
      EXPECT_NEAR(found.at_samples[i], fine.at_samples[i], 1e-8 * fine.at_samples[i]) << late;
      EXPECT_NEAR(found.over_time[i], fine.over_time[i], 1e-7 * fine.over_time[i]) << late;
    }
    // The mean over time is not what the samples say.
    EXPECT_GT(std::abs(found.over_time[1] / found.at_samples[1] - 1.0), 1e-5);
  }
}

TEST(SampledLoopRms, ApproachesTheContinuousLoopAsSamplingGetsFaster) {
  // u = -g y without delay: the hold is half a sample late, so the difference falls with T.
  const double g = 40.0, q = 2.0;
  const auto plant = drive();
  const Eigen::MatrixXd a = plant.a - g * plant.b.col(0) * plant.c.row(0);
  const Eigen::MatrixXd p =
      solve_lyapunov(a, q * plant.b.col(1) * plant.b.col(1).transpose()).covariance;
  const double expected = std::sqrt((plant.c.row(0) * p * plant.c.row(0).transpose())(0, 0));
  const auto error = [&](double t) {
    auto gain = plant::static_gain(Eigen::MatrixXd::Constant(1, 1, -g), {"angle"}, {"torque"});
    gain.sample_time = t;
    return sampled_loop_rms({plant, gain, 0.0}, {{{"wind", q}}, {}}, {"angle"}).over_time[0] -
           expected;
  };
  EXPECT_LT(std::abs(error(1e-4)), 1e-3 * expected);
  EXPECT_NEAR(error(2e-4) / error(1e-4), 2.0, 0.05);
}

TEST(SampledLoopRms, AddsNoisesByTheirSquares) {
  const auto loop = loop_with(0.013);
  const auto rms = [&](double q, double r) {
    return sampled_loop_rms(loop, {{{"wind", q}}, {{"angle", r}}}, {"angle"}).over_time[0];
  };
  EXPECT_NEAR(std::hypot(rms(3.0, 0.0), rms(0.0, 0.1)), rms(3.0, 0.1), 1e-12 * rms(3.0, 0.1));
  EXPECT_EQ(rms(0.0, 0.0), 0.0);
}

TEST(SampledLoop, NamesWhatItRefuses) {
  const auto refused = [](auto change, const char* message) {
    SampledLoop loop = loop_with(0.0);
    change(loop);
    EXPECT_THAT(reference::Call([&] { sampled_closed_loop(loop); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refused([](SampledLoop& l) { l.controller.sample_time = 0.0; }, "a sampled controller");
  refused([](SampledLoop& l) { l.plant = plant::sample(l.plant, period); }, "a continuous plant");
  refused([](SampledLoop& l) { l.controller.outputs = {"thrust"}; }, "found 'thrust'");
  refused(
      [](SampledLoop& l) {
        l.controller.inputs = {"reference", "rate"};
      },
      "none of the controller's inputs reference, rate");
  refused([](SampledLoop& l) { l.computation_delay = -0.1; }, "found -0.1 s");
  refused([](SampledLoop& l) { l.controller.states[0] = "x1"; }, "found 'x1' twice");
  EXPECT_THAT(reference::Call([] { sampled_open_loop(loop_with(0.0), "wind"); }),
              ThrowsMessage<InvalidInput>(HasSubstr("among torque, found 'wind'")));
  const auto rms_refused = [](const SampledLoopNoise& noise,
                              const std::vector<std::string>& outputs, const char* message) {
    EXPECT_THAT(reference::Call([&] { sampled_loop_rms(loop_with(0.0), noise, outputs); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  rms_refused({{{"torque", 1.0}}, {}}, {"angle"}, "one of wind, found 'torque'");
  rms_refused({{{"wind", -1.0}}, {}}, {"angle"}, "found -1 of 'wind'");
  rms_refused({{}, {{"mixed", 1.0}}}, {"angle"}, "one of angle, found 'mixed'");
  rms_refused({}, {"rate"}, "found 'rate'");
  SampledLoop direct = loop_with(0.0);
  direct.plant.d(1, 1) = 0.1;
  EXPECT_THAT(reference::Call([&] {
                sampled_loop_rms(direct, {{{"wind", 1.0}}, {}}, {"mixed"});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("reaches the output 'mixed' without a lag")));
  EXPECT_NO_THROW(sampled_loop_rms(direct, {{{"wind", 1.0}}, {}}, {"angle"}));
  SampledLoop unstable = loop_with(0.0);
  unstable.controller.d *= 100.0;
  EXPECT_THROW(sampled_loop_rms(unstable, {{{"wind", 1.0}}, {}}, {"angle"}), NumericalFailure);
}

}  // namespace
}  // namespace boresight::control
