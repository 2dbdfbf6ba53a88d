#include "peer_drive.hpp"

#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include <boresight/plant/integration/fast_integrator.hpp>
#include <boresight/plant/integration/feedback_ode.hpp>
#include <boresight/plant/integration/ode_integrator.hpp>

// The rate loop that other programs were measured on, with its valve and friction.
namespace boresight::plant {
namespace {

using reference::DriveFriction;

constexpr double step = 0.01;
constexpr Eigen::Index samples = 6000;
// The first period of the command, in which friction does all it can do: what CVODES follows with
// utmost accuracy.
constexpr Eigen::Index close_samples = 2000;

struct Item {
  DriveFriction friction;
  const char* name;
  double largest_error;  // of v, rad/s
};
constexpr std::array<Item, 3> items{{{DriveFriction::none, "nl_none", 1e-6},
                                     {DriveFriction::tanh, "nl_tanh", 1e-5},
                                     {DriveFriction::lugre, "nl_lugre", 1e-5}}};

Eigen::VectorXd rate_command() {
  return Eigen::VectorXd::NullaryExpr(samples + 1, [](Eigen::Index k) {
    return reference::peer_rate_command(step * static_cast<double>(k));
  });
}

// v, th, T by CVODES, from one corner of the triangle to the next.
Eigen::MatrixXd by_cvodes(const FeedbackSystem& system, double tolerance, double absolute) {
  const Eigen::VectorXd command = rate_command();
  FeedbackOde ode(system);
  OdeOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, absolute);
  OdeIntegrator integrator(ode, 0.0, Eigen::VectorXd::Zero(ode.states()), options);
  Eigen::MatrixXd output(close_samples, 3);
  for (Eigen::Index k = 0; k < close_samples; ++k) {
    const bool corner = k % 500 == 0;
    if (corner) {
      const double start = step * static_cast<double>(k);
      ode.drive(start, command.segment(k, 1), start + 5.0, command.segment(k + 500, 1));
      integrator.restart();
    }
    integrator.advance(step * static_cast<double>(k + 1),
                       k % 500 == 499 ? Approach::stop_exactly : Approach::interpolate);
    output.row(k) = ode.outputs(integrator.time(), integrator.state());
  }
  return output;
}

double largest_error_of_v(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (found.col(0) - expected.col(0)).cwiseAbs().maxCoeff();
}

TEST(PeerDrive, IsIntegratedAsByOthersAndByBothIntegrators) {
  const auto peers = reference::peer_values();
  for (const auto& item : items) {
    SCOPED_TRACE(item.name);
    const auto system = reference::peer_drive(item.friction);
    const Eigen::MatrixXd expected = by_cvodes(system, 1e-11, 1e-13);

    const auto& peer = peers.at(item.name);
    const auto v_of_peer = [&](Eigen::Index k) {
      return peer.at("v_every_5s").at(static_cast<std::size_t>(k)).get<double>();
    };
    for (Eigen::Index k = 1; k <= 4; ++k) {
      EXPECT_NEAR(expected(500 * k - 1, 0), v_of_peer(k), 1e-8) << k;
    }
    EXPECT_LT(largest_error_of_v(by_cvodes(system, 1e-8, 1e-10), expected), item.largest_error);

    FastIntegratorOptions options;
    options.interval = step;
    FastIntegrator fast(system, options);
    EXPECT_TRUE(fast.by_modes());
    Eigen::MatrixXd found(samples, 3);
    fast.simulate(rate_command(), found, Interpolation::first_order_hold);
    EXPECT_LT(largest_error_of_v(found.topRows(close_samples), expected), item.largest_error);
    for (Eigen::Index k = 1; k <= 12; ++k) {
      EXPECT_NEAR(found(500 * k - 1, 0), v_of_peer(k), item.largest_error) << k;
    }
    // th, v, T at the end, rms and peak of v; at rest at the start.
    const double rms = std::sqrt(found.col(0).squaredNorm() / (samples + 1.0));
    const std::array<double, 5> values{found(samples - 1, 1), found(samples - 1, 0),
                                       found(samples - 1, 2), rms,
                                       found.col(0).cwiseAbs().maxCoeff()};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double of_peer = peer.at("val").at(i);
      EXPECT_NEAR(values[i], of_peer, 1e-6 * (1.0 + std::abs(of_peer))) << i;
    }
  }
}

TEST(PeerDrive, HasTheSlopesOfItsChannels) {
  reference::RandomNumbers random(71);
  for (const auto& item : items) {
    const reference::DriveChannels channels(item.friction);
    const Eigen::Index p = channels.inputs(), q = channels.outputs();
    const Eigen::VectorXd size = Eigen::Vector4d(0.05, 60.0, 0.1, 1.5e-3).head(p);
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::VectorXd z = size.cwiseProduct(random.matrix(p, 1).col(0));
      Eigen::VectorXd n(q), up(q), down(q);
      Eigen::MatrixXd slope(q, p), unused(q, p);
      channels.evaluate(z, n, slope);
      for (Eigen::Index i = 0; i < p; ++i) {
        const Eigen::VectorXd shift = 1e-5 * size[i] * Eigen::VectorXd::Unit(p, i);
        channels.evaluate(z + shift, up, unused);
        channels.evaluate(z - shift, down, unused);
        const Eigen::VectorXd expected = (up - down) / (2e-5 * size[i]);
        EXPECT_LT((slope.col(i) - expected).norm(), 1e-5 * (1e-3 + expected.norm())) << z;
      }
    }
  }
}

}  // namespace
}  // namespace boresight::plant
