#include <cstdlib>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "../control/reference_loop.hpp"
#include "../peer_drive.hpp"
#include "../peer_family.hpp"
#include "allocation_count.hpp"
#include <boresight/plant/integration/fast_integrator.hpp>
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/time_response.hpp>
#include <boresight/plant/modal/modal_response.hpp>

// What is prepared once and then called many times asks for no memory at all when it is called.
namespace boresight {
namespace {

using reference::allocations_of;

TEST(Allocations, AreSeenWhereverTheyComeFrom) {
  EXPECT_EQ(allocations_of([] {}), 0);
  EXPECT_GE(allocations_of([] { std::make_unique<std::vector<double>>(1000); }), 1);
  EXPECT_GE(allocations_of([] { Eigen::MatrixXd::Zero(30, 30).eval(); }), 1);
  void* volatile block = nullptr;  // or the compiler leaves out what nobody reads
  EXPECT_EQ(allocations_of([&] { block = std::malloc(100); }), 1);
  std::free(block);
  const auto system = reference::peer_closed_loop(5);
  EXPECT_GE(allocations_of([&] { plant::frequency_response(system, 1.0); }), 1);
}

TEST(Allocations, NoneInTheResponseOfAModalSystem) {
  const plant::ModalResponse response(reference::peer_modal_system(50), "t", "y");
  const Eigen::ArrayXd w = reference::peer_frequencies();
  Eigen::ArrayXcd result(w.size());
  EXPECT_EQ(allocations_of([&] { response.evaluate(w, result); }), 0);
  std::complex<double> sum = 0.0;
  EXPECT_EQ(allocations_of([&] {
              for (const double frequency : w) sum += response.at(frequency);
            }),
            0);
  EXPECT_NEAR(std::abs(result.sum() - sum), 0.0, 1e-9 * std::abs(sum));
}

TEST(Allocations, NoneInTheResponseOfADenseSystem) {
  plant::DenseResponse response(reference::peer_closed_loop(20));
  const Eigen::ArrayXd w = reference::peer_frequencies();
  Eigen::ArrayXcd channel(w.size());
  EXPECT_EQ(allocations_of([&] { response.evaluate(w, channel, 0, 1); }), 0);
  Eigen::MatrixXcd all(2, 3);
  bool finite = true;
  EXPECT_EQ(allocations_of([&] {
              for (const double frequency : w) {
                finite = response.evaluate(std::complex(0.0, frequency), all) && finite;
              }
            }),
            0);
  EXPECT_TRUE(finite);
}

TEST(Allocations, NoneInTheStepsOfASimulation) {
  const Eigen::MatrixXd input = reference::peer_noise(5000);
  Eigen::MatrixXd output(input.rows(), 1);
  const auto system = reference::channel(reference::peer_closed_loop(20), "n", "y");
  for (const double largest_condition : {1e12, 0.0}) {
    for (const auto interpolation :
         {plant::Interpolation::zero_order_hold, plant::Interpolation::first_order_hold}) {
      plant::LinearSimulation simulation(system, 1e-3, {interpolation, largest_condition});
      EXPECT_EQ(simulation.by_modes(), largest_condition > 0.0);
      simulation.simulate(input, output);  // the first sample of a record may take some
      EXPECT_EQ(allocations_of([&] { simulation.simulate(input, output); }), 0);
    }
  }
}

TEST(Allocations, NoneInTheStepsOfTheFastIntegrator) {
  for (const auto friction : {reference::DriveFriction::none, reference::DriveFriction::tanh,
                              reference::DriveFriction::lugre}) {
    for (const double largest_condition : {1e8, 0.0}) {
      const auto system = reference::peer_drive(friction);
      plant::FastIntegratorOptions options;
      options.interval = 0.01;
      options.largest_condition = largest_condition;
      plant::FastIntegrator integrator(system, options);
      const Eigen::MatrixXd command = Eigen::VectorXd::NullaryExpr(1001, [](Eigen::Index k) {
        return reference::peer_rate_command(0.01 * static_cast<double>(k));
      });
      Eigen::MatrixXd output(1000, 3);
      const Eigen::VectorXd rest = Eigen::VectorXd::Zero(system.linear.a.rows());
      const auto run = [&] {
        integrator.simulate(command, output, plant::Interpolation::first_order_hold);
      };
      run();  // prepares the step lengths that it takes
      integrator.start_from(rest);
      EXPECT_EQ(allocations_of(run), 0);
    }
  }
}

// Polishing the peaks and returning them takes memory; nothing is asked for frequency by frequency.
TEST(Allocations, OfALoopEvaluationDoNotGrowWithTheGrid) {
  const auto allocations = [](int points_per_decade) {
    auto evaluator = reference::loop_evaluator(reference::antenna(), points_per_decade);
    const control::Controller controller{control::LoopStructure::pi_with_lag(),
                                         {0.05, 0.5, 3.0, 0.3, 0.01}};
    evaluator.evaluate(controller, true);
    return allocations_of([&] { evaluator.evaluate(controller, true); });
  };
  EXPECT_LE(allocations(1000), allocations(100) + 4);
}

}  // namespace
}  // namespace boresight
