#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/least_squares.hpp>

namespace boresight::identification {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// Value of a model at one predictor, and its gradient by the parameters.
using Curve = double (*)(double x, const Vector& b, Vector& gradient);

struct NistCase {
  std::string name;
  Curve curve;
};

double saturating(double x, const Vector& b, Vector& g) {
  const double e = std::exp(-b(1) * x);
  g << 1.0 - e, b(0) * x * e;
  return b(0) * (1.0 - e);
}

double chwirut(double x, const Vector& b, Vector& g) {
  const double bottom = b(1) + b(2) * x;
  const double y = std::exp(-b(0) * x) / bottom;
  g << -x * y, -y / bottom, -x * y / bottom;
  return y;
}

double power(double x, const Vector& b, Vector& g) {
  const double p = std::pow(x, b(1));
  g << p, b(0) * p * std::log(x);
  return b(0) * p;
}

double bell(double x, const Vector& b, Vector& g) {
  const double u = (x - b(2)) / b(1);
  const double e = std::exp(-0.5 * u * u) / b(1);
  g << e, b(0) * e * (u * u - 1.0) / b(1), b(0) * e * u / b(1);
  return b(0) * e;
}

double quadratics(double x, const Vector& b, Vector& g) {
  const double top = b(0) + x * (b(1) + x * b(2));
  const double bottom = 1.0 + x * (b(3) + x * b(4));
  const double y = top / bottom;
  g << 1.0 / bottom, x / bottom, x * x / bottom, -x * y / bottom, -x * x * y / bottom;
  return y;
}

double three_decays(double x, const Vector& b, Vector& g) {
  double y = 0.0;
  for (int i = 0; i < 6; i += 2) {
    const double e = std::exp(-b(i + 1) * x);
    g(i) = e;
    g(i + 1) = -x * b(i) * e;
    y += b(i) * e;
  }
  return y;
}

double two_decays(double x, const Vector& b, Vector& g) {
  const double e4 = std::exp(-x * b(3)), e5 = std::exp(-x * b(4));
  g << 1.0, e4, e5, -x * b(1) * e4, -x * b(2) * e5;
  return b(0) + b(1) * e4 + b(2) * e5;
}

struct Certified {
  Vector start, value, deviation, x, y;
  double sum_of_squares = 0.0;
};

Certified read_nist(const std::string& name) {
  std::ifstream file(BORESIGHT_SOURCE_DIR "/tests/data/nist/" + name + ".dat");
  std::vector<double> start, value, deviation, x, y;
  Certified c;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream text(line);
    std::string word, equals;
    double first = 0.0, second = 0.0, third = 0.0, fourth = 0.0;
    if (number > 40 && number < 60 && text >> word >> equals && word.size() == 2 &&
        word[0] == 'b' && text >> first >> second >> third >> fourth) {
      start.push_back(first);
      value.push_back(third);
      deviation.push_back(fourth);
    } else if (line.rfind("Residual Sum of Squares:", 0) == 0) {
      c.sum_of_squares = std::stod(line.substr(24));
    } else if (number > 60 && std::istringstream(line) >> first >> second) {
      y.push_back(first);
      x.push_back(second);
    }
  }
  const auto vector = [](const std::vector<double>& v) {
    return Vector(Eigen::Map<const Vector>(v.data(), static_cast<Eigen::Index>(v.size())));
  };
  c.start = vector(start);
  c.value = vector(value);
  c.deviation = vector(deviation);
  c.x = vector(x);
  c.y = vector(y);
  return c;
}

numerics::ResidualFunction residuals_of(const Certified& data, Curve curve) {
  return [&data, curve](const Vector& b, Vector& residuals, Matrix* jacobian) {
    residuals.resize(data.y.size());
    if (jacobian != nullptr) jacobian->resize(data.y.size(), b.size());
    Vector gradient(b.size());
    for (Eigen::Index i = 0; i < data.y.size(); ++i) {
      residuals(i) = curve(data.x(i), b, gradient) - data.y(i);
      if (jacobian != nullptr) jacobian->row(i) = gradient.transpose();
    }
  };
}

// Correct digits, at most the 11 that are certified.
double log_relative_error(double found, double certified) {
  const double error = std::abs(found - certified) / std::abs(certified);
  return error > 0.0 ? std::clamp(-std::log10(error), 0.0, 11.0) : 11.0;
}

TEST(LeastSquares, ReachesNistsCertifiedValuesFromTheHarderStart) {
  const std::vector<NistCase> cases{{"BoxBOD", saturating}, {"Chwirut2", chwirut},
                                    {"DanWood", power},     {"Eckerle4", bell},
                                    {"Kirby2", quadratics}, {"Lanczos3", three_decays},
                                    {"MGH17", two_decays},  {"Misra1a", saturating}};
  double sum = 0.0;
  for (const auto& [name, curve] : cases) {
    const Certified data = read_nist(name);
    ASSERT_GT(data.start.size(), 1) << name;
    const auto result = numerics::least_squares(residuals_of(data, curve), data.start);
    EXPECT_TRUE(result.converged()) << name << ": " << numerics::describe(result.status);
    double worst = 11.0;
    for (Eigen::Index i = 0; i < data.value.size(); ++i) {
      worst = std::min(worst, log_relative_error(result.x(i), data.value(i)));
    }
    EXPECT_GE(worst, 7.0) << name;
    sum += worst;
    EXPECT_NEAR(result.sum_of_squares, data.sum_of_squares, 1e-8 * data.sum_of_squares) << name;
    EXPECT_EQ(result.rank, data.value.size()) << name;
    const double variance = result.sum_of_squares / double(data.y.size() - data.value.size());
    for (Eigen::Index i = 0; i < data.value.size(); ++i) {
      EXPECT_NEAR(std::sqrt(variance * result.inverse_normal(i, i)), data.deviation(i),
                  1e-5 * data.deviation(i))
          << name << " parameter " << i;
    }
    RecordProperty(name, std::to_string(worst));
  }
  EXPECT_GE(sum / double(cases.size()), 9.0);
}

TEST(LeastSquares, LeavesWhatTheDataDoNotSayAtItsStart) {
  // Only the sum of the two parameters is seen.
  const auto model = [](const Vector& x, Vector& residuals, Matrix* jacobian) {
    residuals = Vector{{x(0) + x(1) - 3.0, 2.0 * (x(0) + x(1)) - 6.5}};
    if (jacobian != nullptr) *jacobian = Matrix{{1.0, 1.0}, {2.0, 2.0}};
  };
  const auto result = numerics::least_squares(model, Vector{{1.0, 0.0}});
  EXPECT_TRUE(result.converged());
  EXPECT_NEAR(result.x.sum(), 3.2, 1e-12);
  EXPECT_NEAR(result.x(0) - result.x(1), 1.0, 1e-9);
  EXPECT_EQ(result.rank, 1);
  EXPECT_GT(result.condition, 1e12);
  // var(x1 + x2) = 1/5 of the residuals'; the difference has no information and no variance.
  EXPECT_NEAR(result.inverse_normal.sum(), 0.2, 1e-12);
}

TEST(LeastSquares, StepsBackFromWhereTheModelHasNoValue) {
  const auto model = [](const Vector& x, Vector& residuals, Matrix* jacobian) {
    residuals = Vector::Constant(1, std::log(x(0)) + 2.0);
    if (jacobian != nullptr) *jacobian = Matrix::Constant(1, 1, 1.0 / x(0));
  };
  // The first full step would lead to a negative number.
  const auto result = numerics::least_squares(model, Vector::Constant(1, 5.0));
  EXPECT_TRUE(result.converged());
  EXPECT_NEAR(result.x(0), std::exp(-2.0), 1e-12);
}

TEST(LeastSquares, GoesTheSameWayWhenDerivingWhatItTries) {
  const Certified data = read_nist("MGH17");
  numerics::LeastSquaresOptions options;
  options.derive_when_trying = true;
  const auto model = residuals_of(data, two_decays);
  const auto one = numerics::least_squares(model, data.start);
  const auto other = numerics::least_squares(model, data.start, options);
  EXPECT_EQ(one.x, other.x);
  EXPECT_EQ(one.iterations, other.iterations);
  EXPECT_LT(other.evaluations, one.evaluations);
}

TEST(LeastSquares, DoesNotDependOnUnits) {
  const Certified data = read_nist("Misra1a");
  const auto model = residuals_of(data, saturating);
  const Vector unit{{1e6, 1e-7}};
  const auto scaled = [&](const Vector& x, Vector& residuals, Matrix* jacobian) {
    model(x.cwiseProduct(unit), residuals, jacobian);
    if (jacobian != nullptr) *jacobian = (*jacobian * unit.asDiagonal()).eval();
  };
  const auto plain = numerics::least_squares(model, data.start);
  const auto other = numerics::least_squares(scaled, data.start.cwiseQuotient(unit));
  EXPECT_LT((other.x.cwiseProduct(unit) - plain.x).cwiseQuotient(plain.x).norm(), 1e-9);
  EXPECT_NEAR(other.condition, plain.condition, 1e-6 * plain.condition);
}

TEST(LeastSquares, SaysWhereItStopped) {
  const Certified data = read_nist("MGH17");
  numerics::LeastSquaresOptions options;
  options.iterations = 3;
  const auto result = numerics::least_squares(residuals_of(data, two_decays), data.start, options);
  EXPECT_FALSE(result.converged());
  EXPECT_EQ(numerics::describe(result.status), "the limit of iterations was reached");
  // A Jacobian of the wrong sign: nothing descends.
  const auto wrong = [](const Vector& x, Vector& residuals, Matrix* jacobian) {
    residuals = Vector::Constant(1, 1.0 + x(0));
    if (jacobian != nullptr) *jacobian = Matrix::Constant(1, 1, -1.0);
  };
  const auto stuck = numerics::least_squares(wrong, Vector::Constant(1, 1.0));
  EXPECT_FALSE(stuck.converged());
  EXPECT_EQ(stuck.status, numerics::LeastSquaresStatus::no_descent);
}

TEST(LeastSquares, RefusesWhatItCannotStartFrom) {
  const auto line = [](const Vector& x, Vector& residuals, Matrix* jacobian) {
    residuals = x;
    if (jacobian != nullptr) *jacobian = Matrix::Identity(x.size(), x.size());
  };
  EXPECT_THAT(reference::Call([&] { numerics::least_squares(line, Vector(0)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("least_squares: expected a start")));
  const Vector bad = Vector::Constant(1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(reference::Call([&] { numerics::least_squares(line, bad); }),
              ThrowsMessage<InvalidInput>(HasSubstr("not all finite")));
  numerics::LeastSquaresOptions options;
  options.iterations = 0;
  EXPECT_THAT(reference::Call([&] { numerics::least_squares(line, Vector::Ones(1), options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected iterations from 1")));
  const auto nowhere = [](const Vector&, Vector& residuals, Matrix* jacobian) {
    residuals = Vector::Constant(1, std::numeric_limits<double>::infinity());
    if (jacobian != nullptr) *jacobian = Matrix::Ones(1, 1);
  };
  EXPECT_THAT(reference::Call([&] { numerics::least_squares(nowhere, Vector::Ones(1)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("start elsewhere")));
}

}  // namespace
}  // namespace boresight::identification
