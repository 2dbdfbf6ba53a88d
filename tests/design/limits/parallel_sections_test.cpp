#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/sampled_setting.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Poles at 0.9 e^(+-0.4j), 0.99997, 0.5 and -0.3, in coordinates that mix them. Reads the encoder
// and the torque.
plant::StateSpace controller() {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(5, 5);
  a.topLeftCorner(2, 2) << 0.9 * std::cos(0.4), 0.9 * std::sin(0.4), -0.9 * std::sin(0.4),
      0.9 * std::cos(0.4);
  a(2, 2) = 0.99997;
  a(3, 3) = 0.5;
  a(4, 4) = -0.3;
  const Eigen::VectorXd normal = Eigen::VectorXd::LinSpaced(5, -1.0, 2.0).normalized();
  const Eigen::MatrixXd reflection =
      Eigen::MatrixXd::Identity(5, 5) - 2.0 * normal * normal.transpose();
  plant::StateSpace result;
  result.a = reflection * a * reflection;
  result.b = Eigen::MatrixXd::Ones(5, 2);
  result.b.col(1) = Eigen::VectorXd::LinSpaced(5, 0.3, -0.8);
  result.c = Eigen::RowVectorXd::LinSpaced(5, 1.0, 2.0);
  result.d = Eigen::RowVector2d(0.7, -0.2);
  result.inputs = {"encoder", "motor_torque"};
  result.outputs = {"valve_command"};
  result.states = {"a", "b", "c", "d", "e"};
  result.sample_time = 0.02;
  return result;
}

const Eigen::ArrayXd& frequency() {
  static const Eigen::ArrayXd grid =
      Eigen::ArrayXd::LinSpaced(80, std::log(1e-4), std::log(156.0)).exp();
  return grid;
}

TEST(ParallelSections, RespondAsTheController) {
  const ParallelSections sections(controller());
  EXPECT_EQ(sections.order(), 5);
  // As few numbers as the order, three sensors and a direct path have.
  EXPECT_EQ(sections.parameters().size(), 5 + 3 * 5 + 3);
  const auto expected = SampledSetting::controller_response(controller(), frequency());
  // A pole 3e-5 from 1 has lost that many digits before the sections see it.
  const double allowed = 1e-10 * expected.abs().maxCoeff();
  const auto found = sections.response(sections.parameters(), frequency()).value;
  EXPECT_LT((found - expected).abs().maxCoeff(), allowed);
  const auto as_states =
      SampledSetting::controller_response(sections.state_space(sections.parameters()), frequency());
  EXPECT_LT((as_states - expected).abs().maxCoeff(), allowed);
}

TEST(ParallelSections, DerivativesAreThoseOfTheResponse) {
  const ParallelSections sections(controller());
  const Eigen::VectorXd here = sections.parameters();
  const auto found = sections.response(here, frequency());
  for (Eigen::Index k = 0; k < here.size(); ++k) {
    const double step = 1e-5 * std::max(1.0, std::abs(here[k]));
    Eigen::VectorXd above = here, below = here;
    above[k] += step;
    below[k] -= step;
    const Eigen::ArrayXXcd slope = (sections.response(above, frequency()).value -
                                    sections.response(below, frequency()).value) /
                                   (2.0 * step);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto own = sections.parameters_of(i);
      const auto place = std::ranges::find(own, k) - own.begin();
      const auto& derivatives = found.by_parameters.at(static_cast<std::size_t>(i));
      ASSERT_EQ(derivatives.cols(), std::ssize(own));
      Eigen::ArrayXcd derivative = Eigen::ArrayXcd::Zero(slope.rows());
      if (place < std::ssize(own)) derivative = derivatives.col(place);
      EXPECT_LT((slope.col(i) - derivative).abs().maxCoeff(),
                1e-7 * (1.0 + derivative.abs().maxCoeff()))
          << k << ' ' << i;
    }
  }
}

void expect_gradients_of_conditions(const ParallelSections& sections) {
  const Eigen::VectorXd here = sections.parameters();
  const auto found = sections.stability(here);
  for (Eigen::Index k = 0; k < here.size(); ++k) {
    Eigen::VectorXd above = here, below = here;
    above[k] += 1e-6;
    below[k] -= 1e-6;
    const Eigen::VectorXd slope =
        (sections.stability(above).conditions - sections.stability(below).conditions) / 2e-6;
    EXPECT_LT((slope - found.gradients.col(k)).cwiseAbs().maxCoeff(), 1e-6) << k;
  }
}

TEST(ParallelSections, ConditionsAreNegativeWhereTheControllerIsStable) {
  const ParallelSections sections(controller());
  const Eigen::VectorXd here = sections.parameters();
  const auto at = [&](Eigen::Index parameter, double change) {
    Eigen::VectorXd parameters = here;
    parameters[parameter] += change;
    const bool stable = numerics::spectral_radius(sections.state_space(parameters).a) < 1.0;
    const auto conditions = sections.stability(parameters).conditions;
    EXPECT_EQ(stable, conditions.maxCoeff() < 0.0) << parameter << ' ' << change;
    return stable;
  };
  int stable = 0, all = 0;
  for (const Eigen::Index parameter : {0, 1, 8, 9, 16}) {
    for (const double change : {-3.0, -1.0, -0.1, 0.0, 0.1, 1.0, 3.0}) {
      stable += at(parameter, change) ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(stable, all / 3);
  EXPECT_LT(stable, all - 3);
  expect_gradients_of_conditions(sections);
}

TEST(ParallelSections, ConditionsAreNegativeWhereNoPoleIsSlowerThanAllowed) {
  // The slowest of this controller: 0.00003 a sample.
  const double slowest = 3e-5 / 0.02;
  const Eigen::VectorXd here = ParallelSections(controller()).parameters();
  EXPECT_LT(ParallelSections(controller(), {.slowest = 0.9 * slowest})
                .stability(here)
                .conditions.maxCoeff(),
            0.0);
  const ParallelSections sections(controller(), {.slowest = 1.1 * slowest});
  EXPECT_GT(sections.stability(here).conditions.maxCoeff(), 0.0);
  int slow = 0, all = 0;
  for (const Eigen::Index parameter : {0, 1, 8, 9, 16}) {
    for (const double change : {-6.0, -2.0, -0.5, 0.5, 2.0}) {
      Eigen::VectorXd parameters = here;
      parameters[parameter] += change;
      const Eigen::VectorXcd poles =
          numerics::eigen_decomposition(sections.state_space(parameters).a).values;
      if (poles.cwiseAbs().maxCoeff() >= 1.0) continue;
      const bool too_slow = ((1.0 - poles.real().array()) / 0.02).minCoeff() < 1.1 * slowest;
      const bool met = sections.stability(parameters).conditions.maxCoeff() < 0.0;
      EXPECT_EQ(met, !too_slow) << parameter << ' ' << change;
      slow += too_slow ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(slow, 3);
  EXPECT_LT(slow, all - 1);
  expect_gradients_of_conditions(sections);
}

// The pair 0.9 e^(+-0.4j): b0 = |p - 1|^2/T^2, b1 = 2 (1 - 0.9 cos 0.4)/T.
TEST(ParallelSections, ConditionsAreNegativeWhereEveryPairIsDampedEnough) {
  const double size = std::abs(std::polar(0.9, 0.4) - 1.0);
  const double damping = (1.0 - 0.9 * std::cos(0.4)) / size - 0.5 * size;
  EXPECT_NEAR(bounds_of(controller()).damping, damping, 1e-9);
  EXPECT_NEAR(bounds_of(controller()).slowest, 3e-5 / 0.02, 1e-9);
  const Eigen::VectorXd here = ParallelSections(controller()).parameters();
  const auto worst = [&](double bound) {
    return ParallelSections(controller(), {.damping = bound}).stability(here).conditions.maxCoeff();
  };
  EXPECT_LT(worst(0.95 * damping), 0.0);
  EXPECT_GT(worst(1.05 * damping), 0.0);
  expect_gradients_of_conditions(ParallelSections(controller(), {.damping = 1.05 * damping}));
}

// Those that are too fast for their damping are left out: 2 (0.999 - 0.5)/0.02 s = 49.9 rad/s.
TEST(ParallelSections, IdlePairsChangeNothingAndHaveTheirFrequencyAndDamping) {
  const auto found = with_idle_pairs(controller(), std::array{2.0, 20.0, 49.0, 50.0}, 0.5);
  EXPECT_EQ(found.a.rows(), 5 + 6);
  const auto expected = SampledSetting::controller_response(controller(), frequency());
  const auto response = SampledSetting::controller_response(found, frequency());
  EXPECT_LT((response - expected).abs().maxCoeff(), 1e-12 * expected.abs().maxCoeff());
  const Eigen::MatrixXd added = found.a.bottomRightCorner(6, 6);
  const Eigen::VectorXcd poles = numerics::eigen_decomposition(added).values;
  for (const double frequency : {2.0, 20.0, 49.0}) {
    EXPECT_EQ(std::ranges::count_if(poles,
                                    [&](const std::complex<double>& pole) {
                                      return std::abs(std::abs(pole - 1.0) / 0.02 - frequency) <
                                             1e-9 * frequency;
                                    }),
              2)
        << frequency;
  }
  plant::StateSpace one = controller();
  for (Eigen::Index k = 0; k < 6; k += 2) {
    one.a = added.block(k, k, 2, 2);
    EXPECT_NEAR(bounds_of(one).damping, 0.5, 1e-9) << k;
  }
}

TEST(ParallelSections, RefuseWhatIsNoStableSampledController) {
  plant::StateSpace unstable = controller();
  unstable.a *= 1.01;
  EXPECT_THAT([&] { (void)ParallelSections(unstable); },
              ThrowsMessage<InvalidInput>(HasSubstr("pole of magnitude 1.00997")));
  plant::StateSpace continuous = controller();
  continuous.sample_time = 0.0;
  EXPECT_THAT([&] { (void)ParallelSections(continuous); },
              ThrowsMessage<InvalidInput>(HasSubstr("expected a sampled controller")));
}

}  // namespace
}  // namespace boresight::design
