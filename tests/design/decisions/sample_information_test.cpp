#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/decisions/sample_information.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::design {
namespace {

// Of a choice between 0 and a normal gain of this mean and deviation, made knowing the gain:
// E max(0, g) - max(0, mean) (Raiffa and Schlaifer's unit normal loss integral).
double normal_value(double mean, double deviation) {
  const double z = std::abs(mean) / deviation;
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  return deviation * (density - z * 0.5 * std::erfc(z / std::numbers::sqrt2));
}

struct Samples {
  Eigen::MatrixXd inputs, losses;
};

// Option 0 loses 0; option 1 loses mean + sum of weights times independent standard normals, of
// which the last is no input; what both share tells nothing.
Samples linear_samples(Eigen::Index count, double mean, const std::vector<double>& weights,
                       double noise, std::uint64_t seed) {
  Samples random_samples{Eigen::MatrixXd(count, static_cast<Eigen::Index>(weights.size())),
                         Eigen::MatrixXd(count, 2)};
  for (Eigen::Index n = 0; n < count; ++n) {
    const auto index = static_cast<std::uint64_t>(n);
    const auto rest = numerics::NormalNumbers(seed, 99).pair(index);
    double loss = mean + noise * rest.real();
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double x = numerics::NormalNumbers(seed, i).pair(index).real();
      random_samples.inputs(n, static_cast<Eigen::Index>(i)) = 20.0 + 3.0 * x;
      loss += weights[i] * x;
    }
    random_samples.losses(n, 0) = 5.0 * rest.imag();
    random_samples.losses(n, 1) = random_samples.losses(n, 0) + loss;
  }
  return random_samples;
}

TEST(SampleInformation, AgreesWithTheClosedFormOfTwoOptionsAndNormalInputs) {
  const Samples random_samples = linear_samples(20000, 0.3, {1.0, 0.5, 0.0}, 0.6, 4);
  const SampleInformation found = sample_information(random_samples.inputs, random_samples.losses);
  EXPECT_EQ(found.choice, 0u);
  const double all = normal_value(0.3, std::sqrt(1.0 + 0.25 + 0.36));
  EXPECT_NEAR(found.perfect.gain, all, 3.0 * found.perfect.standard_error);
  EXPECT_LT(found.perfect.standard_error, 0.02 * all);
  ASSERT_EQ(found.inputs.size(), 3u);
  const std::array truth{normal_value(0.3, 1.0), normal_value(0.3, 0.5), 0.0};
  for (std::size_t i = 0; i < 2; ++i) {
    const InputValue& input = found.inputs[i];
    EXPECT_NEAR(input.fitted.gain, truth[i], 3.0 * input.fitted.standard_error);
    EXPECT_NEAR(input.held_out_gain, truth[i], 3.0 * input.held_out_error);
    EXPECT_LT(input.fitted.standard_error, 0.06 * truth[i]);
    EXPECT_GE(input.coefficients, 2u);
  }
  // What has no part in the losses is worth next to nothing.
  EXPECT_LT(found.inputs[2].fitted.gain, 0.002);
  EXPECT_LE(found.inputs[2].held_out_gain, 0.001);
}

TEST(SampleInformation, StatesErrorsThatHoldWhatTheySay) {
  // Standardised errors of 200 repetitions: deviation near 1, mean near 0 but for the bias stated.
  const double truth = normal_value(0.3, 1.0);
  const double all = normal_value(0.3, std::sqrt(1.25));
  double square = 0.0, perfect_square = 0.0, fitted = 0.0, held_out = 0.0;
  constexpr int repetitions = 200;
  for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
    const Samples random_samples = linear_samples(300, 0.3, {1.0}, 0.5, seed);
    const SampleInformation found =
        sample_information(random_samples.inputs, random_samples.losses);
    const InputValue& input = found.inputs[0];
    square += std::pow((input.fitted.gain - truth) / input.fitted.standard_error, 2);
    perfect_square += std::pow((found.perfect.gain - all) / found.perfect.standard_error, 2);
    fitted += input.fitted.gain / repetitions;
    held_out += input.held_out_gain / repetitions;
  }
  EXPECT_NEAR(std::sqrt(square / repetitions), 1.0, 0.2);
  EXPECT_NEAR(std::sqrt(perfect_square / repetitions), 1.0, 0.2);
  EXPECT_NEAR(fitted, truth, 0.03 * truth);
  EXPECT_LT(held_out, fitted);
  EXPECT_NEAR(held_out, truth, 0.06 * truth);
}

TEST(SampleInformation, BracketsAnInputThatIsWorthNothing) {
  double fitted = 0.0, held_out = 0.0;
  constexpr int repetitions = 100;
  for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
    const Samples random_samples = linear_samples(200, 0.0, {0.0}, 1.0, seed);
    const InputValue input =
        sample_information(random_samples.inputs, random_samples.losses).inputs[0];
    fitted += input.fitted.gain / repetitions;
    held_out += input.held_out_gain / repetitions;
  }
  EXPECT_GT(fitted, 0.0);
  EXPECT_LT(fitted, 0.03);
  EXPECT_LT(held_out, 0.0);
  EXPECT_GT(held_out, -0.06);
}

TEST(SampleInformation, FindsWhatDependsOnAnInputByACurve) {
  // Option 1 loses x^2 - 1/3, x uniform over (-1, 1): knowing x gains the mean of 1/3 - x^2 over
  // |x| < 1/sqrt(3), which is 2/(9 sqrt(3)); the realisation error in it is the deviation 0.3.
  Samples random_samples{Eigen::MatrixXd(4000, 2), Eigen::MatrixXd(4000, 3)};
  for (Eigen::Index n = 0; n < 4000; ++n) {
    const double x = (2.0 * static_cast<double>(n) + 1.0) / 4000.0 - 1.0;
    const auto noise = numerics::NormalNumbers(8).pair(static_cast<std::uint64_t>(n));
    random_samples.inputs.row(n) << x, 7.0;
    random_samples.losses.row(n) << 1.0, 1.0 + x * x - 1.0 / 3.0 + 0.3 * noise.real(), 2.0 + x;
  }
  const SampleInformation found = sample_information(random_samples.inputs, random_samples.losses);
  const double truth = 2.0 / (9.0 * std::sqrt(3.0));
  EXPECT_NEAR(found.inputs[0].fitted.gain, truth, 0.08 * truth);
  EXPECT_NEAR(found.inputs[0].held_out_gain, truth, 0.08 * truth);
  EXPECT_GE(found.inputs[0].coefficients, 4u);
  EXPECT_GT(found.perfect.gain, truth);
  // A constant input teaches nothing.
  EXPECT_EQ(found.inputs[1].fitted.gain, 0.0);
  EXPECT_EQ(found.inputs[1].coefficients, 1u);
}

TEST(SampleInformation, DoesNotDependOnUnitsOfInputsOrOnWhatAllOptionsShare) {
  Samples random_samples = linear_samples(300, 0.2, {1.0, 0.4}, 0.5, 11);
  const SampleInformation one = sample_information(random_samples.inputs, random_samples.losses);
  random_samples.inputs.col(0) *= 1e9;
  random_samples.losses.colwise() += Eigen::VectorXd::LinSpaced(300, 0.0, 2.0);
  const SampleInformation other = sample_information(random_samples.inputs, random_samples.losses);
  EXPECT_NEAR(one.inputs[0].fitted.gain, other.inputs[0].fitted.gain, 1e-10);
  EXPECT_NEAR(one.perfect.gain, other.perfect.gain, 1e-12);
}

TEST(SampleInformation, IsNothingWhereOneOptionIsBestEverywhere) {
  Samples random_samples = linear_samples(200, 0.0, {1.0}, 0.0, 2);
  random_samples.losses.col(1) = random_samples.losses.col(0).array() + 0.5;
  const SampleInformation found = sample_information(random_samples.inputs, random_samples.losses);
  EXPECT_EQ(found.perfect.gain, 0.0);
  EXPECT_EQ(found.inputs[0].fitted.gain, 0.0);
  EXPECT_EQ(found.inputs[0].held_out_gain, 0.0);
}

TEST(SampleInformation, SaysWhatIsWrong) {
  using testing::HasSubstr;
  const auto refusal = [](const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& losses) {
    try {
      sample_information(inputs, losses);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  const Eigen::MatrixXd fine = Eigen::MatrixXd::Random(100, 2);
  EXPECT_THAT(refusal(fine, fine.leftCols(1)), HasSubstr("found 100 x 1"));
  EXPECT_THAT(refusal(fine.topRows(99), fine.topRows(99)), HasSubstr("at least 100 samples"));
  EXPECT_THAT(refusal(fine.topRows(99), fine), HasSubstr("as of the losses, 100, found 99"));
  Eigen::MatrixXd bad = fine;
  bad(3, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(fine, bad), HasSubstr("the loss that its failure would cost"));
  EXPECT_THAT(refusal(bad, fine), HasSubstr("finite inputs and losses"));
}

}  // namespace
}  // namespace boresight::design
