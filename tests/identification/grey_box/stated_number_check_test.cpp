#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Core>
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/synthetic_drive.hpp"
#include <boresight/identification/grey_box/stated_number_check.hpp>
#include <boresight/numerics/statistics/lognormal_interval.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using synthetic::bulk;
using synthetic::P;
using synthetic::quick;
using synthetic::Truth;

const StatedNumberCheck& check_of(const std::vector<StatedNumberCheck>& checks,
                                  const std::string& name) {
  const auto found = std::ranges::find(checks, name, &StatedNumberCheck::name);
  EXPECT_NE(found, checks.end()) << name;
  return *found;
}

// Of a linear model: information of records that say little of the second parameter.
MatrixXd information_of_records() {
  MatrixXd root(4, 4);
  root << 3.0, 0.2, -1.0, 0.4, 0.0, 0.3, 0.1, -0.2, 1.0, 0.1, 2.0, 0.5, 0.2, 0.0, 0.3, 4.0;
  return root.transpose() * root;
}

TEST(WithoutStatedNumber, IsWhatTheRecordsGiveWithoutItsPrior) {
  const MatrixXd records = information_of_records();
  const MatrixXd identity = MatrixXd::Identity(4, 4);
  const VectorXd estimate = (VectorXd(4) << 0.5, 8.0, -1.0, 2.0).finished();
  GreyBoxPosterior posterior;
  posterior.formal = (records + identity).inverse();
  posterior.point = posterior.formal * records * estimate;
  posterior.covariance = posterior.formal;
  posterior.misfit = MatrixXd::Zero(4, 4);
  for (const VectorXd& direction :
       {VectorXd(VectorXd::Unit(4, 1)), VectorXd((VectorXd(4) << 0.6, 0.8, 0.0, 0.0).finished())}) {
    const auto without = without_stated_number(posterior, direction);
    const MatrixXd expected = (records + identity - direction * direction.transpose()).inverse();
    EXPECT_TRUE(without.formal.isApprox(expected, 1e-10));
    EXPECT_TRUE(without.covariance.isApprox(expected, 1e-10));
    EXPECT_TRUE(without.point.isApprox(expected * records * estimate, 1e-10));
  }
}

TEST(WithoutStatedNumber, KeepsAMisfitAsFarAsTheOptimumFollowsIt) {
  const MatrixXd records = information_of_records();
  const MatrixXd identity = MatrixXd::Identity(4, 4);
  // Errors of the records that move their scores by so much.
  const VectorXd scores = (VectorXd(4) << 1.0, -0.5, 0.3, 2.0).finished();
  GreyBoxPosterior posterior;
  posterior.formal = (records + identity).inverse();
  posterior.point = VectorXd::Zero(4);
  const VectorXd shift = posterior.formal * scores;
  posterior.misfit = shift * shift.transpose();
  posterior.covariance = posterior.formal + posterior.misfit;
  const VectorXd direction = VectorXd::Unit(4, 1);
  const auto without = without_stated_number(posterior, direction);
  const MatrixXd formal = (records + identity - direction * direction.transpose()).inverse();
  const VectorXd expected = formal * scores;
  EXPECT_TRUE(without.misfit.isApprox(expected * expected.transpose(), 1e-10));
  EXPECT_TRUE(without.covariance.isApprox(formal + expected * expected.transpose(), 1e-10));
}

TEST(CheckStatedNumbers, FindsNothingAgainstNumbersThatAreRight) {
  const Truth truth;
  const auto result =
      fit_grey_box(synthetic::campaign(truth.parameters, truth.point, 0.005, 11), bulk, quick());
  EXPECT_GT(result.stated_numbers.size(), 10U);
  for (const auto& one : result.stated_numbers) {
    EXPECT_LT(std::abs(one.departure), 3.0) << one.name;
    EXPECT_GT(one.visible_error, 3.5 * one.stated_uncertainty) << one.name;
    // Without a number there is less to know.
    EXPECT_GE(one.inertia.standard_uncertainty / one.inertia.value,
              0.99 * result.quantity("inertia").posterior.standard_uncertainty /
                  result.quantity("inertia").posterior.value)
        << one.name;
  }
  EXPECT_TRUE(departing_numbers(result.stated_numbers, 3.0).empty());
  // Torque is pressure times displacement, and rate over it: what one per cent of the scales makes.
  EXPECT_GT(check_of(result.stated_numbers, "torque per pressure").inertia_effect, 0.1);
  EXPECT_LT(check_of(result.stated_numbers, "pressure gain").inertia_effect, -0.1);
}

TEST(CheckStatedNumbers, NamesATachometerThatNoEncoderContradicts) {
  const Truth truth;
  Campaign campaign = synthetic::campaign(truth.parameters, truth.point, 0.005, 11);
  for (DriveRecord& record : campaign.records) record.motor_rate.values *= 1.06;
  const auto result = fit_grey_box(campaign, bulk, quick());
  const auto& tachometer = check_of(result.stated_numbers, "tachometer scale");
  EXPECT_GT(tachometer.departure, StatedNumberCheck::contradicted_beyond);
  EXPECT_TRUE(tachometer.moves_inertia);
  EXPECT_LT(tachometer.by_others.lower, 1.06);
  EXPECT_GT(tachometer.by_others.upper, 1.06);
  // The fit itself takes the stated scale, and is off; without it the truth is in the interval.
  EXPECT_LT(result.estimate.inertia, 0.98 * truth.drive.inertia);
  EXPECT_LT(tachometer.inertia.lower, truth.drive.inertia);
  EXPECT_GT(tachometer.inertia.upper, truth.drive.inertia);
  ASSERT_FALSE(result.conflict.contradicted.empty());
  EXPECT_TRUE(result.estimate.contradicted);
  std::vector<std::string> names;
  for (const auto& one : result.conflict.contradicted) names.push_back(one.name);
  EXPECT_THAT(names, testing::Contains("tachometer scale"));
}

StatedNumberCheck departing(const std::string& name, double departure, double spread) {
  StatedNumberCheck one;
  one.name = name;
  one.departure = departure;
  one.stated_uncertainty = 0.01;
  one.by_others = numerics::normal_interval(1.0, 0.01 * spread);
  one.moves_inertia = true;
  return one;
}

TEST(DepartingNumbers, AreThoseThatExplainTheRecordsNearlyAsWell) {
  std::vector<StatedNumberCheck> checks{departing("a", 3.2, 2.0), departing("b", -3.6, 2.0),
                                        departing("c", 2.9, 2.0), departing("d", 9.0, 2.0)};
  checks.back().moves_inertia = false;
  const auto found = departing_numbers(checks, 3.5);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "b");
  EXPECT_EQ(found[1].name, "a");
  EXPECT_TRUE(departing_numbers(checks, 3.7).empty());
  EXPECT_EQ(departing_numbers(checks, 3.5, StatedNumbers::all)[0].name, "d");
  // An error of more than tenfold explains nothing, unless all else would have to be as wrong.
  checks[1].by_others = numerics::lognormal_interval(1e-3, 0.01);
  EXPECT_EQ(departing_numbers(checks, 3.0)[0].name, "a");
  checks[0].by_others = checks[1].by_others;
  EXPECT_EQ(departing_numbers(checks, 3.0)[0].name, "b");
}

TEST(GrossErrorProbabilities, AreThoseOfTheDensities) {
  const std::vector<StatedNumberCheck> checks{departing("a", 3.0, 2.0), departing("b", 0.4, 5.0)};
  const auto probabilities = gross_error_probabilities(checks);
  // Density of what all else says of the number, its statement right or grossly wrong, in units of
  // the stated uncertainty.
  const auto density = [](const StatedNumberCheck& one, double stated) {
    const double spread = one.by_others.standard_uncertainty / one.stated_uncertainty;
    const double distance = one.departure * std::hypot(spread, 1.0);
    const double deviation = std::hypot(spread, stated);
    return std::exp(-0.5 * std::pow(distance / deviation, 2)) / deviation;
  };
  std::vector<double> odds;
  for (const auto& one : checks) {
    odds.push_back(0.02 / 0.98 * density(one, 10.0) / density(one, 1.0));
  }
  const double all = 1.0 + std::accumulate(odds.begin(), odds.end(), 0.0);
  for (std::size_t i = 0; i < checks.size(); ++i) {
    EXPECT_NEAR(probabilities[i], odds[i] / all, 1e-12);
  }
  EXPECT_GT(probabilities[0], 0.2);
  EXPECT_LT(probabilities[1], 0.02);
}

TEST(SamplesInDoubt, HoldWhatFollowsFromEitherStatement) {
  const Truth truth;
  Campaign campaign = synthetic::campaign(truth.parameters, truth.point, 0.005, 11);
  for (DriveRecord& record : campaign.records) record.motor_rate.values *= 1.06;
  const auto result = fit_grey_box(campaign, bulk, quick());
  std::vector<StatedNumberCheck> checks{check_of(result.stated_numbers, "tachometer scale")};
  checks[0].departure = 3.0;
  const double probability = gross_error_probabilities(checks)[0];
  ASSERT_GT(probability, 0.1);
  ASSERT_LT(probability, 0.9);
  GreyBoxPosterior posterior = result.posterior;  // widened: as narrow as before
  posterior.covariance = posterior.formal;
  const auto samples = samples_in_doubt(result.model.front(), posterior, checks, 2000, 3);
  const auto alone = posterior_samples(result.model.front(), posterior, 2000, 3);
  std::size_t others = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    others += samples[i].inertia != alone[i].inertia ? 1U : 0U;
  }
  EXPECT_NEAR(static_cast<double>(others) / 2000.0, probability, 0.002);
  const auto holds = [&](const std::vector<DriveEstimate>& all) {
    return std::ranges::count_if(
        all, [&](const auto& one) { return one.inertia > truth.drive.inertia; });
  };
  EXPECT_GT(holds(samples), 0.2 * probability * 2000.0);
  EXPECT_LT(holds(alone), 20);
}

}  // namespace
}  // namespace boresight::identification
