#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/modal_form.hpp>

namespace boresight::plant {
namespace {

StateSpace random_system(reference::RandomNumbers& random, Eigen::Index n) {
  StateSpace system{random.matrix(n, n),
                    random.matrix(n, 2),
                    random.matrix(2, n),
                    random.matrix(2, 2),
                    {"u", "v"},
                    {"y", "z"},
                    {}};
  for (Eigen::Index i = 0; i < n; ++i) system.states.push_back("x" + std::to_string(i));
  return system;
}

TEST(ModalForm, HasTheResponseOfTheSystem) {
  reference::RandomNumbers random(301);
  for (Eigen::Index n = 0; n <= 12; ++n) {
    for (const double sample_time : {0.0, 0.1}) {
      auto system = random_system(random, n);
      system.sample_time = sample_time;
      const ModalForm form = modal_form(system);
      for (const double w : {0.0, 0.3, 4.0, 30.0}) {
        const std::complex<double> s =
            sample_time > 0.0 ? std::polar(1.0, w * sample_time) : std::complex<double>{0.0, w};
        const Eigen::MatrixXcd expected = frequency_response(system, w);
        EXPECT_LT((modal_response(form, s) - expected).norm(),
                  1e-13 * form.condition * (1.0 + expected.norm()));
      }
    }
  }
}

TEST(ModalForm, OfOscillatorsKeepsOnePoleOfEachPair) {
  StateSpace system{Eigen::MatrixXd::Zero(3, 3),
                    Eigen::MatrixXd::Ones(3, 1),
                    Eigen::MatrixXd::Ones(1, 3),
                    Eigen::MatrixXd::Zero(1, 1),
                    {"u"},
                    {"y"},
                    {"a", "b", "c"}};
  system.a << 0.0, 2.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  const ModalForm form = modal_form(system);
  ASSERT_EQ(form.poles.size(), 2);
  EXPECT_NEAR(std::abs(form.poles[0] - std::complex<double>(-1.0, 0.0)), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(form.poles[1] - std::complex<double>(0.0, 2.0)), 0.0, 1e-15);
}

TEST(ModalForm, DoesNotCareForTheScaleOfTheStates) {
  reference::RandomNumbers random(302);
  const auto system = random_system(random, 6);
  auto scaled = system;
  Eigen::VectorXd scale(6);
  scale << 1e-9, 1e3, 1.0, 1e8, 1e-4, 1e6;
  scaled.a = scale.cwiseInverse().asDiagonal() * system.a * scale.asDiagonal();
  scaled.b = scale.cwiseInverse().asDiagonal() * system.b;
  scaled.c = system.c * scale.asDiagonal();
  const Eigen::MatrixXcd expected = frequency_response(system, 1.0);
  const ModalForm form = modal_form(scaled);
  EXPECT_LT((modal_response(form, {0.0, 1.0}) - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT(form.condition, 1e3);
}

TEST(ModalForm, RefusesAChainOfEqualPoles) {
  StateSpace system{Eigen::MatrixXd::Zero(2, 2),
                    Eigen::MatrixXd::Ones(2, 1),
                    Eigen::MatrixXd::Ones(1, 2),
                    Eigen::MatrixXd::Zero(1, 1),
                    {"u"},
                    {"y"},
                    {"angle", "rate"}};
  system.a(0, 1) = 1.0;
  EXPECT_THROW(modal_form(system), NumericalFailure);
  system.a(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(reference::Call([&] { modal_form(system); }),
              testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("not finite")));
}

}  // namespace
}  // namespace boresight::plant
