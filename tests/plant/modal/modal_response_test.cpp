#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_modal_family.hpp"
#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/modal/modal_response.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;

// The same by the dense state space, dead times closed one after another by hand.
Complex dense_response(const ModalSystem& system, const std::string& input,
                       const std::string& output, double w) {
  auto open = system;
  open.dead_times.clear();
  for (const auto& dead_time : system.dead_times) {
    open.inputs.push_back(dead_time.to);
    open.outputs.push_back(dead_time.from);
  }
  const auto dense = to_state_space(open);
  const Eigen::MatrixXcd all = frequency_response(dense, w);
  const Eigen::Index i = input_index(dense, input), o = output_index(dense, output);
  const auto count = static_cast<Eigen::Index>(system.dead_times.size());
  if (count == 0) return all(o, i);
  Eigen::MatrixXcd loop = Eigen::MatrixXcd::Identity(count, count);
  Eigen::VectorXcd right(count), phase(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& dead_time = system.dead_times[static_cast<std::size_t>(k)];
    phase[k] = std::polar(1.0, -w * dead_time.delay);
    right[k] = all(output_index(dense, dead_time.from), i);
    for (Eigen::Index l = 0; l < count; ++l) {
      const auto& other = system.dead_times[static_cast<std::size_t>(l)];
      loop(k, l) -= all(output_index(dense, dead_time.from), input_index(dense, other.to)) *
                    std::polar(1.0, -w * other.delay);
    }
  }
  Eigen::MatrixXd both(2 * count, 2 * count), sides(2 * count, 1);
  both << loop.real(), -loop.imag(), loop.imag(), loop.real();
  sides << right.real(), right.imag();
  const Eigen::VectorXd solved = numerics::linear_solve(both, sides, "the dead times' loop");
  const Eigen::VectorXcd before =
      solved.head(count).cast<Complex>() + Complex(0.0, 1.0) * solved.tail(count).cast<Complex>();
  Complex result = all(o, i);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& dead_time = system.dead_times[static_cast<std::size_t>(k)];
    result += all(o, input_index(dense, dead_time.to)) * phase[k] * before[k];
  }
  return result;
}

TEST(ModalResponse, OfThePeersAntennaIsThatOfTheirStateSpace) {
  for (const int modes : {1, 3, 5, 20, 50}) {
    const auto dense = reference::peer_closed_loop(modes);
    const auto system = reference::peer_modal_system(modes);
    for (const char* input : {"n", "t", "d"}) {
      for (const char* output : {"y", "u"}) {
        const ModalResponse response(system, input, output);
        EXPECT_TRUE(response.core_by_modes());
        for (const double w : {0.01, 0.3, 2.0, 7.0, 11.0, 25.0, 110.0, 300.0, 900.0}) {
          const Complex expected =
              frequency_response(dense, w)(output_index(dense, output), input_index(dense, input));
          EXPECT_LT(std::abs(response.at(w) - expected), 1e-11 * (std::abs(expected) + 1e-3))
              << modes << input << output << w;
        }
      }
    }
  }
}

TEST(ModalResponse, LeavesOutWhatIsNotOnTheWay) {
  const auto system = reference::peer_modal_system(5);
  const ModalResponse torque(system, "t", "y");
  EXPECT_EQ(torque.reduction().core.a.rows(), 8);  // no wind filter
  EXPECT_EQ(std::count(torque.reduction().in_loop.begin(), torque.reduction().in_loop.end(), true),
            1);
  const ModalResponse open(reference::peer_modal_open_loop(5), "d", "loop_gain");
  EXPECT_EQ(open.reduction().in_loop.size(), 1U);  // the wind torque is not there
}

// Random cores with several forces, displacements and dead times, some of them in loops of their
// own: more unknowns than one.
ModalSystem random_system(reference::RandomNumbers& random, int states, int ports, int dead_times) {
  ModalSystem system;
  auto& core = system.core;
  core.inputs = {"in"};
  core.outputs = {"out"};
  for (int i = 0; i < states; ++i) core.states.push_back("x" + std::to_string(i));
  for (int i = 0; i < ports; ++i) {
    core.inputs.push_back("q" + std::to_string(i));
    system.modes.displacements.push_back(core.inputs.back());
    if (i % 2 == 0) core.inputs.push_back("r" + std::to_string(i));
    system.modes.rates.push_back(i % 2 == 0 ? core.inputs.back() : "");
    core.outputs.push_back("f" + std::to_string(i));
    system.modes.forces.push_back(core.outputs.back());
  }
  for (int i = 0; i < dead_times; ++i) {
    core.inputs.push_back("late" + std::to_string(i));
    core.outputs.push_back("early" + std::to_string(i));
    system.dead_times.push_back(
        {core.outputs.back(), core.inputs.back(), random.uniform(0.0, 0.3)});
  }
  const auto m = static_cast<Eigen::Index>(core.inputs.size());
  const auto p = static_cast<Eigen::Index>(core.outputs.size());
  core.a = random.matrix(states, states) - 3.0 * Eigen::MatrixXd::Identity(states, states);
  core.b = random.matrix(states, m);
  core.c = random.matrix(p, states);
  core.d = 0.1 * random.matrix(p, m);
  const int modes = random.integer(0, 9);
  system.modes.frequency = 5.0 * (random.matrix(modes, 1).array() + 1.5);
  system.modes.damping_ratio = 0.02 * (random.matrix(modes, 1).array() + 1.5);
  system.modes.force_shape = random.matrix(modes, ports);
  system.modes.displacement_shape = random.matrix(ports, modes);
  system.inputs = {"in"};
  system.outputs = {"out"};
  return system;
}

TEST(ModalResponse, ClosesAnyNumberOfForcesAndDeadTimes) {
  reference::RandomNumbers random(311);
  for (int trial = 0; trial < 60; ++trial) {
    const int ports = random.integer(0, 4), dead_times = random.integer(0, 3);
    const auto system = random_system(random, random.integer(0, 6), ports, dead_times);
    const ModalResponse response(system, "in", "out");
    for (int i = 0; i < 10; ++i) {
      const double w = random.log_uniform(0.01, 100.0);
      const Complex expected = dense_response(system, "in", "out", w);
      EXPECT_LT(std::abs(response.at(w) - expected), 1e-10 * (1.0 + std::abs(expected)))
          << ports << " ports, " << dead_times << " dead times at " << w;
    }
  }
}

TEST(ModalResponse, IsTheSameForManyFrequenciesAsForOne) {
  const ModalResponse response(reference::peer_modal_system(7), "t", "y");
  for (const Eigen::Index count : {1, 63, 64, 65, 200}) {
    const Eigen::ArrayXd w = Eigen::ArrayXd::LinSpaced(count, 0.1, 300.0);
    Eigen::ArrayXcd values;
    response.evaluate(w, values);
    ASSERT_EQ(values.size(), count);
    for (Eigen::Index i = 0; i < count; ++i) EXPECT_EQ(values[i], response.at(w[i]));
  }
}

TEST(ModalResponse, TakesACoreWithoutIndependentEigenvectors) {
  // Three lags in a row at one place, around a mode.
  ModalSystem system;
  system.core.a.resize(3, 3);
  system.core.a << -1.0, 1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -1.0;
  system.core.b = Eigen::MatrixXd::Identity(3, 2).colwise().reverse();
  system.core.c = Eigen::MatrixXd::Identity(2, 3);
  system.core.d = Eigen::MatrixXd::Zero(2, 2);
  system.core.inputs = {"in", "q"};
  system.core.outputs = {"out", "f"};
  system.core.states = {"a", "b", "c"};
  system.modes = {Eigen::VectorXd::Constant(1, 2.0),
                  Eigen::VectorXd::Constant(1, 0.01),
                  Eigen::MatrixXd::Ones(1, 1),
                  Eigen::MatrixXd::Ones(1, 1),
                  {"f"},
                  {"q"},
                  {""}};
  system.inputs = {"in"};
  system.outputs = {"out"};
  const ModalResponse response(system, "in", "out");
  EXPECT_FALSE(response.core_by_modes());
  for (const double w : {0.0, 0.5, 1.9, 2.0, 7.0}) {
    EXPECT_LT(std::abs(response.at(w) - dense_response(system, "in", "out", w)), 1e-13);
  }
}

TEST(ModalResponse, HoldsIntegratorsOfTheCoreThatOnlyALoopOutsideItHolds) {
  // k (1 + w_i/s)/s closed over a mode's displacement and rate and a dead time; alone the core has
  // two poles at 0.
  ModalSystem system;
  auto& core = system.core;
  core.a.resize(2, 2);
  core.a << 0.0, 1.0, 0.0, 0.0;
  core.b.resize(2, 4);
  core.b << 0.0, 0.3, -0.2, -2.0, 1.0, 0.1, 0.0, -0.5;
  core.c.resize(3, 2);
  core.c << 1.0, 0.2, 0.4, -1.0, 1.0, 0.0;
  core.d = Eigen::MatrixXd::Zero(3, 4);
  core.d(2, 1) = 0.7;
  core.inputs = {"in", "q", "r", "late"};
  core.outputs = {"out", "f", "early"};
  core.states = {"i", "x"};
  system.modes = {Eigen::VectorXd::Constant(1, 5.0),
                  Eigen::VectorXd::Constant(1, 0.02),
                  Eigen::MatrixXd::Ones(1, 1),
                  Eigen::MatrixXd::Ones(1, 1),
                  {"f"},
                  {"q"},
                  {"r"}};
  system.dead_times = {{"early", "late", 0.1}};
  system.inputs = {"in"};
  system.outputs = {"out"};
  const ModalResponse response(system, "in", "out");
  EXPECT_TRUE(response.core_by_modes());
  for (const double w : {1e-6, 0.5, 4.9, 5.0, 30.0}) {
    const Complex expected = dense_response(system, "in", "out", w);
    EXPECT_LT(std::abs(response.at(w) - expected), 1e-9 * std::abs(expected)) << w;
  }
  // At 0 itself, where the dense route has a singular matrix.
  EXPECT_LT(std::abs(response.at(0.0) - response.at(1e-9)), 1e-8 * std::abs(response.at(0.0)));
}

TEST(ModalResponse, HoldsNearALightlyDampedResonance) {
  // 1/(w0^2 - w^2 + 2 j zeta w0 w) a hair beside w0, against long double.
  ModalSystem system;
  system.core = static_gain(Eigen::MatrixXd::Zero(2, 2), {"in", "q"}, {"out", "f"});
  system.core.d << 0.0, 1.0, 1.0, 0.0;
  const double w0 = 7.3, zeta = 1e-6;
  system.modes = {Eigen::VectorXd::Constant(1, w0),
                  Eigen::VectorXd::Constant(1, zeta),
                  Eigen::MatrixXd::Ones(1, 1),
                  Eigen::MatrixXd::Ones(1, 1),
                  {"f"},
                  {"q"},
                  {""}};
  system.inputs = {"in"};
  system.outputs = {"out"};
  const ModalResponse response(system, "in", "out");
  for (const double w : {w0, w0 * (1.0 + 1e-7), w0 * (1.0 - 3e-6), w0 * 1.01}) {
    const std::complex<long double> expected =
        1.0L / std::complex<long double>(
                   static_cast<long double>(w0) * w0 - static_cast<long double>(w) * w,
                   2.0L * zeta * w0 * w);
    EXPECT_LT(std::abs(response.at(w) - Complex(expected)), 1e-14 * std::abs(response.at(w)));
  }
}

TEST(ModalResponse, RefusesNamesThatAreNotOutside) {
  const auto system = reference::peer_modal_system(3);
  EXPECT_THAT(reference::Call([&] { ModalResponse(system, "motor bend rate", "y"); }),
              testing::ThrowsMessage<InvalidInput>(testing::HasSubstr(
                  "expected one of the inputs n, t, d, found 'motor bend rate'")));
  EXPECT_THROW(ModalResponse(system, "t", "motor force"), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
