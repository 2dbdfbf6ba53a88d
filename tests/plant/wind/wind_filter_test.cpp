#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/wind.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Eigen::ArrayXd frequencies(Eigen::Index points = 200) {
  return Eigen::ArrayXd::LinSpaced(points, std::log(5e-4), std::log(5.0)).exp();
}

Eigen::ArrayXd spectrum_of(const ShapingFilter& filter, const Eigen::ArrayXd& f) {
  return f.unaryExpr([&](double x) { return filter_spectrum(filter, x); });
}

Eigen::ArrayXd wind_spectrum(WindModel model, const Eigen::ArrayXd& f) {
  const double ratio = reference::gear_ratio();
  return f.unaryExpr([&](double x) {
    return wind_torque_spectrum(reference::wind_site(), model, 10.0, x) / (ratio * ratio);
  });
}

TEST(FitShapingFilter, FindsASpectrumThatIsRational) {
  const ShapingFilter one{3.0, {}, {0.5}, 0.0};
  const ShapingFilter two{50.0, {0.9}, {0.02, 4.0}, 0.0};
  const ShapingFilter three{7.0, {0.05, 1.5}, {0.01, 0.3, 9.0}, 0.0};
  for (const auto& truth : {one, two, three}) {
    const Eigen::ArrayXd target = spectrum_of(truth, frequencies());
    const auto fit =
        fit_shaping_filter(frequencies(), target, static_cast<int>(truth.poles.size()));
    EXPECT_LT(fit.worst_log_error, 1e-6);
    EXPECT_LT((spectrum_of(fit, frequencies()) / target - 1.0).abs().maxCoeff(), 1e-6);
    EXPECT_NEAR(fit.gain / truth.gain, 1.0, 1e-5);
    for (std::size_t i = 0; i < truth.poles.size(); ++i) {
      EXPECT_NEAR(fit.poles[i] / truth.poles[i], 1.0, 1e-4);
    }
  }
}

TEST(FitShapingFilter, StatesItsWorstError) {
  for (const auto model : {WindModel::uniform, WindModel::vickery, WindModel::coherence}) {
    const Eigen::ArrayXd target = wind_spectrum(model, frequencies());
    const auto fit = fit_shaping_filter(frequencies(), target, 4);
    const double worst = (spectrum_of(fit, frequencies()) / target).log().abs().maxCoeff();
    EXPECT_NEAR(fit.worst_log_error, worst, 1e-12);
    // Real poles turn Vickery's steep corner too slowly.
    EXPECT_LT(worst, model == WindModel::vickery ? 0.5 : 0.11) << to_string(model);
    EXPECT_EQ(fit.poles.size(), 4u);
    EXPECT_EQ(fit.zeros.size(), 3u);
    EXPECT_GT(*std::min_element(fit.poles.begin(), fit.poles.end()), 0.0);
  }
}

TEST(FitShapingFilter, FitsTheTorqueOfEverySpectrum) {
  WindSite site = reference::wind_site();
  for (const auto& gusts :
       {von_karman_gusts(0.16, 111.0), kaimal_gusts(0.16, 37.0), eurocode_gusts(37.0, 0.05, 2.0)}) {
    site.gusts = gusts;
    for (const auto model : {WindModel::uniform, WindModel::coherence}) {
      const Eigen::ArrayXd target = frequencies().unaryExpr(
          [&](double f) { return wind_torque_spectrum(site, model, 10.0, f); });
      const auto fit = fit_shaping_filter(frequencies(), target, 4);
      EXPECT_LT(fit.worst_log_error, 0.11) << to_string(gusts.kind) << " " << to_string(model);
      EXPECT_NEAR(fit.worst_log_error,
                  (spectrum_of(fit, frequencies()) / target).log().abs().maxCoeff(), 1e-12);
    }
  }
}

TEST(FitShapingFilter, FitsBetterWithEveryOrder) {
  const Eigen::ArrayXd target = wind_spectrum(WindModel::coherence, frequencies());
  double previous = HUGE_VAL;
  for (int order = 1; order <= 5; ++order) {
    const auto fit = fit_shaping_filter(frequencies(), target, order);
    const double cost = (spectrum_of(fit, frequencies()) / target).log().square().sum();
    EXPECT_LT(cost, previous) << order;
    previous = cost;
  }
}

TEST(FitShapingFilter, FollowsUnitsOfTorqueAndTime) {
  const Eigen::ArrayXd f = frequencies();
  const Eigen::ArrayXd target = wind_spectrum(WindModel::coherence, f);
  const auto fit = fit_shaping_filter(f, target, 3);
  const auto torque = fit_shaping_filter(f, 100.0 * target, 3);
  EXPECT_NEAR(torque.gain / fit.gain, 10.0, 1e-5);
  EXPECT_NEAR(torque.poles[1] / fit.poles[1], 1.0, 1e-5);
  const auto time = fit_shaping_filter(60.0 * f, target, 3);
  EXPECT_NEAR(time.poles[1] / fit.poles[1], 60.0, 1e-3);
}

TEST(ShapingFilter, AsAStateSpaceHasItsSpectrum) {
  const auto fit =
      fit_shaping_filter(frequencies(), wind_spectrum(WindModel::coherence, frequencies()), 4);
  const StateSpace system = to_state_space(fit, "wind_torque");
  EXPECT_THAT(system.inputs, testing::ElementsAre("white_noise"));
  EXPECT_THAT(system.outputs, testing::ElementsAre("wind_torque"));
  EXPECT_EQ(system.a.rows(), 4);
  for (const double f : {1e-5, 1e-3, 0.04, 1.0, 30.0}) {
    const double square = std::norm(frequency_response(system, two_pi * f)(0, 0));
    EXPECT_NEAR(2.0 * square / filter_spectrum(fit, f), 1.0, 1e-12);
  }
}

TEST(FitShapingFilter, RefusesTooFewPointsAndValuesThatAreNotPositive) {
  const Eigen::ArrayXd f = frequencies(7);
  const Eigen::ArrayXd s = Eigen::ArrayXd::Ones(7);
  EXPECT_THAT(reference::Call([&] { fit_shaping_filter(f, s, 4); }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least 8 points")));
  EXPECT_THROW(fit_shaping_filter(f, s, 0), InvalidInput);
  EXPECT_THROW(fit_shaping_filter(f, Eigen::ArrayXd::Ones(6), 1), InvalidInput);
  EXPECT_THAT(reference::Call([&] { fit_shaping_filter(f, -s, 1); }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive finite")));
  EXPECT_THROW(fit_shaping_filter(-f, s, 1), InvalidInput);
  EXPECT_THROW(fit_shaping_filter(f, s * std::nan(""), 1), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
