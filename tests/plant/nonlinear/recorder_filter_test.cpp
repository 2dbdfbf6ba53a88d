#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/recorder_filter.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

TEST(RecorderFilter, HasButterworthsGainAtEveryOrder) {
  const double step = 1e-4;
  const double corner = 40.0;
  const Index stride = 5;
  for (int order = 1; order <= 8; ++order) {
    for (const double frequency : {5.0, 40.0, 100.0}) {
      VectorXd signal(30001);
      for (Index k = 0; k < signal.size(); ++k) {
        signal[k] = 3.0 + std::sin(2.0 * std::numbers::pi * frequency * step * double(k));
      }
      const VectorXd smooth = filtered({order, corner}, signal, step, stride);
      ASSERT_EQ(smooth.size(), 6001);
      // A second of whole cycles, long after the start.
      const VectorXd settled = smooth.tail(2000).array() - 3.0;
      const double gain = std::sqrt(2.0 * settled.squaredNorm() / 2000.0);
      const double expected = 1.0 / std::sqrt(1.0 + std::pow(frequency / corner, 2 * order));
      EXPECT_NEAR(gain, expected, 1e-3) << order << " at " << frequency;
      EXPECT_NEAR(settled.mean(), 0.0, 1e-3);
    }
  }
}

TEST(RecorderFilter, OfOrder0OnlyThinsAndAConstantPassesAll) {
  const VectorXd ramp = VectorXd::LinSpaced(11, 0.0, 10.0);
  EXPECT_EQ(filtered({}, ramp, 0.1, 5), Eigen::Vector3d(0.0, 5.0, 10.0));
  EXPECT_EQ(filtered({}, ramp, 0.1, 1), ramp);
  const VectorXd constant = VectorXd::Constant(100, 7.0);
  EXPECT_LT((filtered({3, 10.0}, constant, 0.01, 1) - constant).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(steps_per_sample({}, 0.005, 90.0), 1);
  EXPECT_EQ(steps_per_sample({2, 50.0}, 0.005, 0.0), 5);
  EXPECT_EQ(steps_per_sample({2, 50.0}, 0.005, 190.0), 10);
  EXPECT_EQ(steps_per_sample({2, 1.0}, 0.005, 0.0), 1);
  EXPECT_THROW(steps_per_sample({2, 5000.0}, 0.005, 0.0), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
