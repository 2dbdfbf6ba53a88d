#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measured_reference.hpp"
#include <boresight/control/measured/measured_confidence.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using reference::bins;
using ::testing::HasSubstr;

const plant::AntennaPlant& antenna() {
  static const plant::AntennaPlant plant = reference::antenna();
  return plant;
}

MeasuredChannels exact_channels(double lowest = 0.05, double highest = 10.0) {
  return {reference::measured_plant(antenna(), bins(200.0, lowest, highest), 1.0, 9.0),
          reference::oil_spring(antenna()), antenna().drive.tachometer_corner};
}

double difference(std::complex<double> x, std::complex<double> y) {
  return std::abs(x - y) / std::abs(y);
}

// The wind's entry: Y/(1 + H Y) of what was measured is what the two bodies' equations say, with
// the tachometer's lag.
TEST(MeasuredChannels, GiveWhatATorqueAtTheShaftDoes) {
  const MeasuredChannels channels = exact_channels();
  for (const double w : channels.frequency()) {
    const auto found = channels.at(w);
    const auto exact = reference::with_wind_at_motor(antenna(), w);
    EXPECT_LT(difference(found.tachometer_command, exact.tachometer_command), 1e-12);
    EXPECT_LT(difference(found.tachometer_wind, exact.tachometer_wind), 1e-11) << w;
    EXPECT_LT(difference(found.torque_wind, exact.torque_wind), 1e-11) << w;
    EXPECT_LT(difference(found.encoder_wind, exact.encoder_wind), 1e-11) << w;
    EXPECT_EQ(found.boresight_wind, found.encoder_wind);
    EXPECT_EQ(found.boresight_command, found.encoder_command);
  }
}

TEST(MeasuredChannels, FollowTheResponseBetweenPoints) {
  const MeasuredChannels channels = exact_channels();
  for (const double w : bins(373.0, 0.06, 9.9)) {
    const auto found = channels.at(w);
    const auto exact = reference::with_wind_at_motor(antenna(), w);
    // Least at the zero of the rate that the locked rotor makes, damped 1 %.
    EXPECT_LT(difference(found.tachometer_command, exact.tachometer_command), 3e-3) << w / two_pi;
    EXPECT_LT(difference(found.encoder_wind, exact.encoder_wind), 3e-3) << w / two_pi;
    EXPECT_EQ(channels.basis(w), ResponseBasis::measured);
  }
}

TEST(MeasuredChannels, TurnAsOneBodyBelowThePointsAndSaySo) {
  const MeasuredChannels channels = exact_channels(0.1);
  EXPECT_NEAR(channels.low_end_inertia(), plant::reflected_inertia(antenna()), 0.005);
  EXPECT_NEAR(channels.low_end_friction(), antenna().drive.viscous_friction, 0.005);
  for (const double f : {1e-4, 1e-3, 0.01, 0.05, 0.09}) {
    const auto found = channels.at(two_pi * f);
    const auto exact = reference::with_wind_at_motor(antenna(), two_pi * f);
    EXPECT_LT(difference(found.tachometer_command, exact.tachometer_command), 4e-3) << f;
    EXPECT_LT(difference(found.torque_command, exact.torque_command), 5e-3) << f;
    EXPECT_LT(difference(found.encoder_command, exact.encoder_command), 4e-3) << f;
    EXPECT_LT(difference(found.encoder_wind, exact.encoder_wind), 2e-3) << f;
    EXPECT_EQ(channels.basis(two_pi * f), ResponseBasis::assumed_below);
  }
}

TEST(MeasuredChannels, RollOffAboveThePointsAndSaySo) {
  const MeasuredChannels channels = exact_channels();
  const double highest = channels.highest_frequency();
  const auto last = channels.at(highest), beyond = channels.at(3.0 * highest);
  EXPECT_EQ(channels.basis(3.0 * highest), ResponseBasis::assumed_above);
  EXPECT_LT(difference(beyond.tachometer_command, last.tachometer_command / 9.0), 1e-12);
  EXPECT_LT(difference(beyond.encoder_command, last.encoder_command / 27.0), 1e-12);
}

TEST(MeasuredChannels, DoNotDependOnTheOrderOfPointsOrOnUnits) {
  auto measured = reference::measured_plant(antenna(), bins(100.0, 0.05, 10.0), 0.999, 9.0);
  const auto oil = reference::oil_spring(antenna());
  const double corner = antenna().drive.tachometer_corner;
  const MeasuredChannels channels(measured, oil, corner);
  auto reversed = measured;
  reversed.frequency.reverseInPlace();
  reversed.tachometer.reverseInPlace();
  reversed.motor_torque.reverseInPlace();
  reversed.encoder.reverseInPlace();
  std::ranges::reverse(reversed.covariance);
  const MeasuredChannels same(reversed, oil, corner);
  // Torque in other units: so is the oil's stiffness, and wind moves it by as much less.
  constexpr double unit = 4.448;
  auto scaled = measured;
  scaled.motor_torque *= unit;
  for (auto& covariance : scaled.covariance) {
    covariance.row(1) *= unit;
    covariance.col(1) *= unit;
  }
  const MeasuredChannels other(scaled, {oil.stiffness * unit, oil.loss_rate}, corner);
  for (const double w : bins(37.0, 0.02, 20.0)) {
    const auto point = channels.at(w);
    EXPECT_EQ(point.encoder_wind, same.at(w).encoder_wind);
    EXPECT_EQ(channels.covariance(w), same.covariance(w));
    EXPECT_LT(difference(other.at(w).encoder_wind * unit, point.encoder_wind), 1e-12);
    EXPECT_LT(difference(other.at(w).torque_wind, point.torque_wind), 1e-12);
    EXPECT_LT(difference(other.at(w).tachometer_command, point.tachometer_command), 1e-12);
  }
}

TEST(MeasuredChannels, TakeTheMotorsAngleWithoutAnEncoder) {
  auto measured = reference::measured_plant(antenna(), bins(100.0, 0.05, 10.0), 1.0, 9.0);
  measured.encoder.resize(0);
  const double corner = antenna().drive.tachometer_corner;
  const MeasuredChannels channels(measured, reference::oil_spring(antenna()), corner);
  EXPECT_FALSE(channels.has_encoder());
  for (const double w : channels.frequency()) {
    const auto point = channels.at(w);
    const std::complex<double> s(0.0, w);
    EXPECT_LT(difference(s * point.encoder_command, point.tachometer_command * (1.0 + s / corner)),
              1e-12);
  }
}

TEST(MeasuredChannels, AddABendingThatAModelPredicts) {
  MeasuredChannelOptions options;
  options.bending = [](double) { return BendingPoint{{0.9, 0.1}, {1e-3, 0.0}}; };
  const MeasuredChannels channels(
      reference::measured_plant(antenna(), bins(100.0, 0.05, 10.0), 1.0, 9.0),
      reference::oil_spring(antenna()), antenna().drive.tachometer_corner, options);
  const auto point = channels.at(3.0);
  const std::complex<double> per_encoder(0.9, 0.1);
  EXPECT_EQ(point.boresight_command, per_encoder * point.encoder_command);
  EXPECT_EQ(point.boresight_wind, per_encoder * point.encoder_wind + 1e-3);
}

TEST(MeasuredChannels, LeaveOutWhatIsNotCoherentAndSaySo) {
  auto measured = reference::measured_plant(antenna(), bins(100.0, 0.05, 10.0), 1.0, 9.0);
  const auto point_at = [&](double hertz) {
    return static_cast<Eigen::Index>(std::lround(100.0 * hertz)) - 5;
  };
  for (Eigen::Index i = point_at(1.2); i <= point_at(1.3); ++i) {
    measured.coherence(i, 1) = 0.3;
    measured.motor_torque[i] *= 50.0;
  }
  for (Eigen::Index i = point_at(5.0); i < measured.frequency.size(); ++i) {
    measured.coherence(i, 2) = 0.1;
    measured.encoder[i] = 1e3;
  }
  const MeasuredChannels channels(measured, reference::oil_spring(antenna()),
                                  antenna().drive.tachometer_corner);
  EXPECT_EQ(channels.points_left_out(), 11U);
  ASSERT_EQ(channels.unresolved().size(), 1U);
  EXPECT_NEAR(channels.unresolved()[0].lowest, two_pi * 1.19, 1e-9);
  EXPECT_NEAR(channels.unresolved()[0].highest, two_pi * 1.31, 1e-9);
  EXPECT_EQ(channels.basis(two_pi * 1.25), ResponseBasis::unresolved);
  EXPECT_EQ(channels.basis(two_pi * 4.9), ResponseBasis::measured);
  EXPECT_EQ(channels.basis(two_pi * 6.0), ResponseBasis::encoder_assumed);
  EXPECT_NEAR(channels.resolved_fraction(), 1.0 - std::log(1.31 / 1.19) / std::log(200.0), 1e-9);
  // The interpolation crosses the gap; the assumed encoder is uncertain by all of itself.
  const auto exact = reference::with_wind_at_motor(antenna(), two_pi * 1.25);
  EXPECT_LT(difference(channels.at(two_pi * 1.25).torque_command, exact.torque_command), 0.05);
  const auto covariance = channels.covariance(two_pi * 6.0);
  EXPECT_NEAR(covariance(2, 2).real(), std::norm(channels.at(two_pi * 6.0).encoder_command),
              1e-9 * covariance(2, 2).real());
}

TEST(MeasuredChannels, RefuseWhatTheyCannotUse) {
  const auto good = reference::measured_plant(antenna(), bins(100.0, 0.05, 10.0), 1.0, 9.0);
  const auto message =
      [&](const std::function<void(MeasuredPlant&, OilSpring&, MeasuredChannelOptions&)>& spoil) {
        MeasuredPlant measured = good;
        OilSpring oil = reference::oil_spring(antenna());
        MeasuredChannelOptions options;
        spoil(measured, oil, options);
        try {
          const MeasuredChannels channels(measured, oil, antenna().drive.tachometer_corner,
                                          options);
        } catch (const Error& error) {
          return std::string(error.what());
        }
        return std::string("nothing thrown");
      };
  EXPECT_THAT(message([](auto& measured, auto&, auto&) { measured.encoder.conservativeResize(3); }),
              HasSubstr("as many as frequencies"));
  EXPECT_THAT(message([](auto& measured, auto&, auto&) { measured.frequency[3] = -1.0; }),
              HasSubstr("positive frequencies, found -1 rad/s at position 3"));
  EXPECT_THAT(
      message([](auto& measured, auto&, auto&) { measured.frequency[3] = measured.frequency[7]; }),
      HasSubstr("twice: average such points first"));
  EXPECT_THAT(message([](auto& measured, auto&, auto&) { measured.tachometer[0] = NAN; }),
              HasSubstr("is not finite"));
  EXPECT_THAT(message([](auto& measured, auto&, auto&) { measured.coherence(4, 1) = 1.5; }),
              HasSubstr("coherences from 0 to 1, found 1.5"));
  EXPECT_THAT(message([](auto&, auto& oil, auto&) { oil.stiffness = 0.0; }),
              HasSubstr("positive oil stiffness"));
  EXPECT_THAT(message([](auto&, auto&, auto& options) { options.roll_off = 0.0; }),
              HasSubstr("a positive roll-off"));
  EXPECT_THAT(message([](auto& measured, auto&, auto&) { measured.tachometer *= -1.0; }),
              HasSubstr("Turn the sign"));
  EXPECT_THAT(message([](auto& measured, auto&, auto&) { measured.coherence.setConstant(0.4); }),
              HasSubstr("0 of 996 points are usable"));
  EXPECT_THAT(message([](auto& measured, auto&, auto&) {
                measured.coherence.bottomRows(960).setConstant(0.4);
              }),
              HasSubstr("960 points have a coherence below 0.6"));
  EXPECT_THAT(
      message([](auto& measured, auto&, auto&) { measured.coherence.col(2).setConstant(0.4); }),
      HasSubstr("Leave it out"));
}

TEST(MeasuredConfidence, HasTheRadiusOfItsDistribution) {
  EXPECT_EQ(confidence_radius(0.0, 9.0), 0.0);
  EXPECT_NEAR(confidence_radius(0.95, 0.0), std::sqrt(std::log(20.0)), 1e-12);
  // F(2, 18) at 95 % is 3.5546 (tables).
  EXPECT_NEAR(std::pow(confidence_radius(0.95, 9.0), 2), 3.5546, 1e-4);
  EXPECT_NEAR(confidence_radius(0.95, 1e9), std::sqrt(std::log(20.0)), 1e-6);
  EXPECT_THROW(confidence_radius(1.0, 9.0), InvalidInput);
  EXPECT_THROW(confidence_radius(0.5, -1.0), InvalidInput);
}

// d ln S by central differences of the responses, at each break.
TEST(MeasuredConfidence, KnowsHowErrorsMoveTheSensitivity) {
  const auto full = LoopStructure::full().with_compliance_compensation();
  Controller controller{full, {}};
  for (const auto& gain : gain_descriptions(full)) {
    controller.gains.push_back(std::sqrt(gain.lower * gain.upper));
  }
  const MeasuredChannels channels = exact_channels();
  constexpr double delay = 0.03;
  for (const double w : {0.4, 3.0, 20.0}) {
    for (const LoopBreak loop_break : loop_breaks) {
      const auto point = measured_loop_point(channels, controller, delay, loop_break, w);
      const auto log_s = [&](const Eigen::Vector3cd& change) {
        return -std::log(1.0 +
                         loop_gain(channels.changed(w, change), w, controller, delay, loop_break));
      };
      for (Eigen::Index c = 0; c < 3; ++c) {
        Eigen::Vector3cd step = Eigen::Vector3cd::Zero();
        const auto exact = channels.at(w);
        step[c] = 1e-5 * std::abs(c == 0   ? exact.tachometer_command
                                  : c == 1 ? exact.torque_command
                                           : exact.encoder_command);
        const auto slope = (log_s(step) - log_s(-step)) / (2.0 * step[c]);
        EXPECT_LT(std::abs(slope - point.log_sensitivity[c]),
                  1e-7 * point.log_sensitivity.norm() + 1e-8 / std::abs(step[c]))
            << to_string(loop_break) << " " << w;
      }
    }
  }
}

// At the valve the circle of errors around 1 + L is met where it comes nearest to 0; no error of
// that size does worse.
TEST(MeasuredConfidence, FindsTheLeastFavourableResponse) {
  const auto measured = reference::measured_plant(antenna(), bins(100.0, 0.05, 10.0), 0.99, 9.0);
  const MeasuredChannels channels(measured, reference::oil_spring(antenna()),
                                  antenna().drive.tachometer_corner);
  const Controller controller = reference::cautious_gains();
  constexpr double delay = 0.03, radius = 1.7;
  const Eigen::ArrayXd grid = bins(50.0, 0.1, 8.0);
  reference::RandomNumbers random(1);
  for (const LoopBreak loop_break : loop_breaks) {
    const LoopChannels worst =
        least_favourable(channels, controller, delay, loop_break, radius, grid);
    const auto sensitivity = [&](const plant::ResponsePoint& point, double w) {
      return 1.0 / std::abs(1.0 + loop_gain(point, w, controller, delay, loop_break));
    };
    for (Eigen::Index i = 0; i < grid.size(); i += 7) {
      const double w = grid[i];
      const auto loop = measured_loop_point(channels, controller, delay, loop_break, w);
      const double largest = sensitivity(plant::point(worst.response, i), w);
      const double measured_one = 1.0 / std::abs(1.0 + loop.loop_gain);
      EXPECT_EQ(largest, sensitivity(worst.at(w), w));
      if (loop_break != LoopBreak::position_loop) {
        EXPECT_NEAR(largest, measured_one / (1.0 - radius * loop.relative_error), 1e-9 * largest);
      }
      for (int trial = 0; trial < 20; ++trial) {
        // Covariances here are diagonal.
        Eigen::Vector3cd direction;
        for (auto& one : direction) one = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
        direction.normalize();
        const Eigen::Vector3cd error =
            radius * channels.covariance(w).diagonal().real().cwiseSqrt().cwiseProduct(direction);
        EXPECT_LT(sensitivity(channels.changed(w, error), w), largest * 1.01);
      }
    }
  }
}

}  // namespace
}  // namespace boresight::control
