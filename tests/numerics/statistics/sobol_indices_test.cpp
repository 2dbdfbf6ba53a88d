#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/sobol_indices.hpp>

namespace boresight::design {
namespace {

constexpr double pi = std::numbers::pi;

// T. Ishigami and T. Homma, ISUMA 1990: inputs uniform over (-pi, pi).
double ishigami(const std::vector<double>& fractions) {
  const auto x = [&](std::size_t i) { return pi * (2.0 * fractions[i] - 1.0); };
  return std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) +
         0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

// Sobol' g-function: product of (|4 x - 2| + a)/(1 + a).
double g_function(const std::vector<double>& fractions, const std::vector<double>& a) {
  double product = 1.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    product *= (std::abs(4.0 * fractions[i] - 2.0) + a[i]) / (1.0 + a[i]);
  }
  return product;
}

numerics::QuantileFunction scalar(std::function<double(const std::vector<double>&)> function) {
  return [function](const std::vector<double>& fractions, Eigen::VectorXd& out) {
    out[0] = function(fractions);
  };
}

TEST(SobolIndices, AgreeWithTheIshigamiFunctionsToOnePerCent) {
  const auto result = numerics::sobol_indices(3, 1, scalar(ishigami), {.points = 1024});
  const double variance = 0.1 * std::pow(pi, 4) / 5.0 + 0.01 * std::pow(pi, 8) / 18.0 + 0.5 + 6.125;
  const double v1 = 0.5 * std::pow(1.0 + 0.1 * std::pow(pi, 4) / 5.0, 2);
  const double v13 = 0.01 * std::pow(pi, 8) * (1.0 / 18.0 - 1.0 / 50.0);
  const std::array first{v1 / variance, 6.125 / variance, 0.0};
  const std::array total{(v1 + v13) / variance, 6.125 / variance, v13 / variance};
  const numerics::SobolIndices& found = result.outputs.at(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const numerics::InputIndices& input = found.inputs.at(i);
    EXPECT_NEAR(input.first_order.value, first[i], i == 2 ? 0.001 : 0.01 * first[i]);
    EXPECT_NEAR(input.total.value, total[i], 0.01 * total[i]);
    EXPECT_LT(input.first_order.standard_error, 0.003);
    EXPECT_LT(input.total.standard_error, 0.003);
  }
  EXPECT_NEAR(found.mean, 3.5, 0.01);
  EXPECT_NEAR(found.variance, variance, 0.01 * variance);
  EXPECT_NEAR(found.interactions, v13 / variance, 0.005);
  EXPECT_EQ(result.evaluations, 16u * 1024u * 5u);
}

TEST(SobolIndices, OfASumAreTheTermsFractions) {
  // c_i x_i with x_i uniform: variance c_i^2/12 each, nothing in common.
  const std::vector<double> c{1.0, -2.0, 3.0, 0.0};
  const auto result =
      numerics::sobol_indices(4, 1, scalar([&](const std::vector<double>& fractions) {
                                double sum = 1e6;
                                for (std::size_t i = 0; i < 4; ++i) sum += c[i] * fractions[i];
                                return sum;
                              }),
                              {.points = 256});
  for (std::size_t i = 0; i < 4; ++i) {
    const numerics::InputIndices& input = result.outputs[0].inputs[i];
    EXPECT_NEAR(input.first_order.value, c[i] * c[i] / 14.0, 2e-3);
    EXPECT_NEAR(input.total.value, c[i] * c[i] / 14.0, 2e-3);
  }
  EXPECT_EQ(result.outputs[0].inputs[3].total.value, 0.0);
  EXPECT_NEAR(result.outputs[0].variance, 14.0 / 12.0, 1e-3);
}

TEST(SobolIndices, OfTheGFunctionAreItsClosedForms) {
  const std::vector<double> a{0.0, 1.0, 4.5, 9.0, 99.0, 99.0};
  const auto result = numerics::sobol_indices(
      6, 1, scalar([&](const auto& fractions) { return g_function(fractions, a); }),
      {.points = 2048});
  std::vector<double> partial;
  double all = 1.0;
  for (const double one : a) {
    partial.push_back(1.0 / (3.0 * (1.0 + one) * (1.0 + one)));
    all *= 1.0 + partial.back();
  }
  const double variance = all - 1.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const numerics::InputIndices& input = result.outputs[0].inputs[i];
    EXPECT_NEAR(input.first_order.value, partial[i] / variance, 0.005);
    EXPECT_NEAR(input.total.value, partial[i] * all / (1.0 + partial[i]) / variance, 0.005);
  }
}

TEST(SobolIndices, HaveIntervalsThatHoldTheTruthAsOftenAsTheySay) {
  // x y with x, y uniform over (0, 1): V = 7/144, V_x = V_y = 1/48.
  const auto product = scalar([](const auto& fractions) { return fractions[0] * fractions[1]; });
  int within = 0;
  int all = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const auto result = numerics::sobol_indices(2, 1, product, {.points = 32, .seed = seed});
    for (const numerics::InputIndices& input : result.outputs[0].inputs) {
      within += input.first_order.lower <= 3.0 / 7.0 && 3.0 / 7.0 <= input.first_order.upper;
      within += input.total.lower <= 4.0 / 7.0 && 4.0 / 7.0 <= input.total.upper;
      all += 2;
    }
  }
  // The two inputs are not independent trials: 600 of the 1200 are, deviation 0.9 % of 95 %.
  EXPECT_NEAR(static_cast<double>(within) / all, 0.95, 0.03);
}

TEST(SobolIndices, AreTheSameForAnyThreadCountAndAnotherForAnotherSeed) {
  const auto one = numerics::sobol_indices(3, 1, scalar(ishigami), {.points = 64, .threads = 1});
  const auto three = numerics::sobol_indices(3, 1, scalar(ishigami), {.points = 64, .threads = 3});
  const auto other = numerics::sobol_indices(3, 1, scalar(ishigami), {.points = 64, .seed = 2});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(one.outputs[0].inputs[i].total.value, three.outputs[0].inputs[i].total.value);
    EXPECT_EQ(one.outputs[0].inputs[i].first_order.upper,
              three.outputs[0].inputs[i].first_order.upper);
    EXPECT_NE(one.outputs[0].inputs[i].total.value, other.outputs[0].inputs[i].total.value);
  }
}

TEST(SobolIndices, OfSeveralOutputsAreThoseOfEachAlone) {
  const auto both =
      numerics::sobol_indices(3, 2,
                              [](const std::vector<double>& fractions, Eigen::VectorXd& out) {
                                out << ishigami(fractions), fractions[2];
                              },
                              {.points = 64});
  const auto alone = numerics::sobol_indices(3, 1, scalar(ishigami), {.points = 64});
  EXPECT_EQ(both.outputs[0].inputs[1].total.value, alone.outputs[0].inputs[1].total.value);
  EXPECT_NEAR(both.outputs[1].inputs[2].first_order.value, 1.0, 1e-12);
  EXPECT_EQ(both.outputs[1].inputs[0].total.value, 0.0);
}

TEST(SobolIndices, OfAConstantAreStatedToBeNone) {
  const auto result =
      numerics::sobol_indices(2, 1, scalar([](const auto&) { return 0.1; }), {.points = 16});
  EXPECT_TRUE(result.outputs[0].constant);
  EXPECT_TRUE(std::isnan(result.outputs[0].inputs[0].first_order.value));
  EXPECT_TRUE(std::isnan(result.outputs[0].inputs[1].total.upper));
  EXPECT_TRUE(std::isnan(result.outputs[0].interactions));
  EXPECT_NEAR(result.outputs[0].mean, 0.1, 1e-15);
}

TEST(SobolIndices, BalanceEveryColumn) {
  const Eigen::MatrixXd points = numerics::scrambled_sobol_points(256, 12, 3);
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    std::vector<int> count(256);
    for (Eigen::Index n = 0; n < points.rows(); ++n) {
      ASSERT_GT(points(n, j), 0.0);
      ASSERT_LT(points(n, j), 1.0);
      ++count[static_cast<std::size_t>(256.0 * points(n, j))];
    }
    EXPECT_THAT(count, testing::Each(1)) << "column " << j;
  }
  // The first two dimensions are a (0, m, 2)-net: every box of area 1/256 holds one point.
  std::vector<int> boxes(256);
  for (Eigen::Index n = 0; n < points.rows(); ++n) {
    ++boxes[static_cast<std::size_t>(16.0 * points(n, 0)) * 16 +
            static_cast<std::size_t>(16.0 * points(n, 1))];
  }
  EXPECT_THAT(boxes, testing::Each(1));
  EXPECT_EQ(numerics::scrambled_sobol_points(1, 1, 1).size(), 1);
}

template <typename Failure, typename Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "nothing was thrown";
}

TEST(SobolIndices, SayWhatIsWrong) {
  using testing::HasSubstr;
  const auto fine = scalar([](const auto& fractions) { return fractions[0]; });
  const auto refusal = [&](std::size_t inputs, std::size_t outputs,
                           const numerics::SobolOptions& options) {
    return message_of<InvalidInput>(
        [&] { numerics::sobol_indices(inputs, outputs, fine, options); });
  };
  EXPECT_THAT(refusal(0, 1, {}), HasSubstr("1 to 500 inputs and at least one output, found 0"));
  EXPECT_THAT(refusal(2, 0, {}), HasSubstr("found 2 and 0"));
  EXPECT_THAT(refusal(501, 1, {}), HasSubstr("found 501"));
  EXPECT_THAT(refusal(2, 1, {.points = 100}), HasSubstr("a power of two from 16 to 2^24"));
  EXPECT_THAT(refusal(2, 1, {.points = 8}), HasSubstr("found 8"));
  EXPECT_THAT(refusal(2, 1, {.randomisations = 3}), HasSubstr("at least 4 randomisations"));
  EXPECT_THAT(refusal(2, 1, {.confidence = 95.0}), HasSubstr("within (0, 1), found 95"));
  EXPECT_THAT(message_of<InvalidInput>([] { numerics::scrambled_sobol_points(16, 0, 1); }),
              HasSubstr("1 to 1000 dimensions, found 0"));
  EXPECT_THAT(message_of<InvalidInput>([] { numerics::scrambled_sobol_points(0, 1, 1); }),
              HasSubstr("a power of two from 1 to 2^24"));
  EXPECT_THAT(message_of<InvalidInput>([] {
                numerics::sobol_indices(1, 2,
                                        [](const auto&, Eigen::VectorXd& out) { out.resize(1); });
              }),
              HasSubstr("expected 2 outputs of the function, found 1"));
  const auto nowhere = scalar([](const std::vector<double>& fractions) {
    return fractions[1] > 0.9 ? std::numeric_limits<double>::quiet_NaN() : fractions[0];
  });
  EXPECT_THAT(
      message_of<NumericalFailure>([&] { numerics::sobol_indices(2, 1, nowhere, {.threads = 2}); }),
      HasSubstr("is not finite where the inputs stand at the fractions 0."));
}

}  // namespace
}  // namespace boresight::design
