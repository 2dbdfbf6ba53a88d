#include <cmath>

#include <gtest/gtest.h>

#include <boresight/design/commissioning/sampled_step.hpp>

namespace boresight::design {
namespace {

// A first-order lag rises in ln 9 and settles into 5 % in ln 20 of its time constants.
TEST(SampledStep, OfAFirstOrderLagHasItsTimes) {
  constexpr double sample_time = 1e-3;
  Eigen::VectorXd response(8000);
  for (Eigen::Index k = 0; k < response.size(); ++k) {
    response[k] = 1.0 - std::exp(-sample_time * static_cast<double>(k));
  }
  EXPECT_NEAR(rise_time(response, sample_time), std::log(9.0), 1e-6);
  EXPECT_EQ(settled_from(response), static_cast<Eigen::Index>(std::ceil(std::log(20.0) / 1e-3)));
}

TEST(SampledStep, ThatDoesNotArriveHasNoTimes) {
  const Eigen::VectorXd response = Eigen::VectorXd::Constant(100, 0.5);
  EXPECT_TRUE(std::isinf(rise_time(response, 0.1)));
  EXPECT_EQ(settled_from(response), 100);
  EXPECT_EQ(settled_from(Eigen::VectorXd::Ones(100)), 0);
}

}  // namespace
}  // namespace boresight::design
