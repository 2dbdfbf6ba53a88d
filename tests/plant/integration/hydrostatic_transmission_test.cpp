#include "plant/hydrostatic_transmission.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/plant/integration/ode_integrator.hpp>

// The transmission of Hopsan's example, against Hopsan's own result.
namespace boresight::plant {
namespace {

using Transmission = reference::HydrostaticTransmission;
using reference::run;

constexpr double step_time = 5.0;  // s
constexpr double step = 20.0;      // rad/s

// Time and speed.
std::vector<std::pair<double, double>> hopsan() {
  std::ifstream file(BORESIGHT_SOURCE_DIR "/tests/data/hopsan/hydrostatic_transmission.csv");
  std::vector<std::pair<double, double>> rows;
  double time = 0.0, speed = 0.0;
  char comma = ',';
  while (file >> time >> comma >> speed) rows.emplace_back(time, speed);
  return rows;
}

OdeOptions options(double relative_tolerance) {
  OdeOptions result;
  result.relative_tolerance = relative_tolerance;
  result.absolute_tolerance.resize(Transmission::count);
  // Pa, rad/s, rad, m3/s per sqrt(Pa), m3.
  result.absolute_tolerance << 1e6, 1e6, 1.0, 1.0, 1e-6, 1e-6, 1e-4;
  result.absolute_tolerance *= relative_tolerance;
  return result;
}

OdeIntegrator integrator_of(const Transmission& system, double tolerance = 1e-6) {
  return {system, 0.0, system.initial_state(), options(tolerance)};
}

// The step starts at the first of the times that is not before it.
template <class Visit>
int follow(Transmission& system, OdeIntegrator& integrator, const std::vector<double>& times,
           const Visit& visit) {
  int events = 0;
  for (const double t : times) {
    if (integrator.time() < step_time && t >= step_time) {
      events += run(system, integrator, step_time);
      system.demanded_speed = step;
      integrator.restart();
    }
    events += run(system, integrator, t);
    visit(t);
  }
  return events;
}

double largest_speed_error(Transmission system) {
  OdeIntegrator integrator = integrator_of(system);
  const auto reference = hopsan();
  EXPECT_EQ(reference.size(), 2048U);
  std::vector<double> times;
  for (const auto& row : reference) times.push_back(row.first);
  double worst = 0.0;
  std::size_t k = 0;
  follow(system, integrator, times, [&](double) {
    worst =
        std::max(worst, std::abs(integrator.state()(Transmission::speed) - reference[k].second));
    ++k;
  });
  return worst;
}

TEST(HydrostaticTransmission, RunsAsHopsanSays) {
  EXPECT_LT(largest_speed_error({}), 0.015 * step);
}

TEST(HydrostaticTransmission, NeedsTheUpperStopOfTheReliefSpool) {
  Transmission system;
  system.relief.largest_opening = 1.0;
  EXPECT_GT(largest_speed_error(system), 0.08 * step);
}

std::vector<double> every_hundredth() {
  std::vector<double> times;
  for (int k = 0; k <= 500; ++k) times.push_back(5.0 + 0.01 * k);
  return times;
}

TEST(HydrostaticTransmission, TakesInWhatItsOilIsCompressedBy) {
  Transmission system;
  OdeIntegrator integrator = integrator_of(system);
  double worst = 0.0, largest = 0.0;
  follow(system, integrator, every_hundredth(), [&](double) {
    const Eigen::VectorXd change = integrator.state() - system.initial_state();
    const double compressed = change(Transmission::high) / system.stiffness[0] +
                              change(Transmission::low) / system.stiffness[1];
    worst = std::max(worst, std::abs(compressed - change(Transmission::taken_in)));
    largest = std::max(largest, std::abs(change(Transmission::taken_in)));
  });
  EXPECT_GT(largest, 1e-6);
  EXPECT_LT(worst, 1e-9 * largest);
}

TEST(HydrostaticTransmission, KeepsToTheEquationsOfItsStateBetweenItsEvents) {
  Transmission system;
  OdeIntegrator integrator = integrator_of(system);
  std::array<bool, 6> seen{};
  const int events = follow(system, integrator, every_hundredth(), [&](double t) {
    Eigen::VectorXd g(system.events());
    system.event_values(t, integrator.state(), g);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      EXPECT_EQ(system.beyond()[k], g(static_cast<Eigen::Index>(k)) > 0.0) << k << " at " << t;
      seen[k] |= system.beyond()[k];
    }
  });
  // The high side blows off, its spool at the stop for a while; the low side is made up.
  EXPECT_EQ(seen, (std::array<bool, 6>{false, true, true, true, false, false}));
  EXPECT_EQ(events, 6);
}

TEST(HydrostaticTransmission, DoesNotDependOnTolerancesAndTransitions) {
  const auto speeds = [](double tolerance, double transition) {
    Transmission system;
    system.transition = transition;
    OdeIntegrator integrator = integrator_of(system, tolerance);
    std::vector<double> result;
    follow(system, integrator, every_hundredth(),
           [&](double) { result.push_back(integrator.state()(Transmission::speed)); });
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(result.data(), std::ssize(result)));
  };
  const Eigen::VectorXd usual = speeds(1e-6, 100.0);
  EXPECT_LT((speeds(1e-9, 100.0) - usual).cwiseAbs().maxCoeff(), 1e-5 * step);
  EXPECT_LT((speeds(1e-6, 1e4) - usual).cwiseAbs().maxCoeff(), 1e-5 * step);
}

TEST(HydrostaticTransmission, HasTheJacobianOfItsDifferences) {
  Transmission system;
  system.transition = 1e5;
  OdeIntegrator integrator = integrator_of(system);
  // Large enough to be seen beside what the rates are, small against what makes them bend.
  Eigen::VectorXd h(system.states());
  h << 1e2, 1e2, 1e-3, 1e-3, 1e-10, 1e-10, 1e-6;
  follow(system, integrator, every_hundredth(), [&](double t) {
    const Eigen::VectorXd& x = integrator.state();
    const Eigen::Index n = x.size();
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(n, n), differences(n, n);
    system.jacobian(t, x, j);
    for (Eigen::Index k = 0; k < n; ++k) {
      Eigen::VectorXd above(n), below(n);
      system.rate(t, x + h(k) * Eigen::VectorXd::Unit(n, k), above);
      system.rate(t, x - h(k) * Eigen::VectorXd::Unit(n, k), below);
      differences.col(k) = (above - below) / (2.0 * h(k));
    }
    // Each row in its own unit.
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::RowVectorXd size = j.row(i).cwiseProduct(h.transpose());
      const Eigen::RowVectorXd error = (differences - j).row(i).cwiseProduct(h.transpose());
      EXPECT_LE(error.cwiseAbs().maxCoeff(), 1e-6 * size.cwiseAbs().maxCoeff()) << i << " at " << t;
    }
  });
}

}  // namespace
}  // namespace boresight::plant
