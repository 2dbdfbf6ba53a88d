#include <cmath>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/simulation/position_run.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The tuned PI controller of the reference antenna.
control::Controller steady_controller(double position_gain = 10.258) {
  return {control::LoopStructure::pi_with_lag(), {0.1587, 0.42067, 2.6279, position_gain, 0.23531}};
}

// Gusts of a slow sine about 8 m/s, sampled at 4 Hz.
plant::WindRecord sine_wind(double duration) {
  plant::WindRecord record{0.25, VectorXd(static_cast<Index>(duration / 0.25) + 1), {}};
  for (Index i = 0; i < record.speed.size(); ++i) {
    record.speed[i] = 8.0 + 2.0 * std::sin(0.3 * static_cast<double>(i));
  }
  return record;
}

TEST(TrackingRun, TakesTheTorqueOfAMeasuredWind) {
  Mission mission = reference::demo_mission();
  mission.wind.model = plant::WindModel::uniform;
  mission.wind_record = sine_wind(66.0);
  const auto run = run_tracking(mission, steady_controller(), 1, {});
  EXPECT_NEAR(run.duration, 66.0, 0.01);
  EXPECT_EQ(run.duration, run.planned_duration);
  ASSERT_TRUE(run.tracking && run.tracking->measured);
  EXPECT_EQ(run.tracking->rate, mission.antenna.drive.tracking_rate);
  EXPECT_NEAR(run.tracking->mean_wind_speed, 8.0, 0.2);
  EXPECT_NEAR(run.tracking->measured->rms, 2.0 / std::sqrt(2.0), 0.1);
  EXPECT_EQ(run.tracking->measured->sample_time, 0.25);
  // 1/2 rho V^2 A D C at the motor, sample for sample.
  const auto& torque = run.channels.back();
  EXPECT_EQ(torque.name, "wind_torque_at_motor");
  for (const int i : {0, 7, 100, 263}) {
    const double speed = 8.0 + 2.0 * std::sin(0.3 * i);
    const double expected =
        plant::mean_wind_torque(mission.wind.site, speed) / plant::gear_ratio(mission.antenna);
    const auto k = static_cast<Index>(std::llround(0.25 * i / run.sample_time));
    EXPECT_NEAR(torque.values[k], expected, 1e-4 * std::abs(expected)) << i;
  }
  ASSERT_TRUE(run.predicted_rms);
  EXPECT_GT(*run.predicted_rms, 0.0);
  // The reference moves at the tracking rate.
  const VectorXd& reference = run.channels[1].values;
  EXPECT_NEAR((reference[reference.size() - 1] - reference[0]) * degree / run.duration,
              mission.antenna.drive.tracking_rate, 1e-6 * mission.antenna.drive.tracking_rate);
}

TEST(TrackingRun, TakesTheCoefficientFromTheTableWhereTheDishPoints) {
  Mission mission = reference::demo_mission();
  mission.wind.model = plant::WindModel::uniform;
  mission.wind_record = sine_wind(2.0);
  mission.wind_record->direction = VectorXd::Constant(mission.wind_record->speed.size(), 1.0);
  // Twice the site's coefficient, whatever the attitude.
  const double coefficient = mission.wind.site.torque_coefficient;
  mission.torque_table.emplace(Eigen::Vector2d(-two_pi / 2.0, two_pi / 2.0),
                               Eigen::Vector2d(0.0, two_pi / 4.0),
                               Eigen::Matrix2d::Constant(2.0 * coefficient));
  const auto without = run_tracking(mission, steady_controller(), 1, {});
  mission.pointing = plant::DishDirection{0.5, 0.5};
  const auto with = run_tracking(mission, steady_controller(), 1, {});
  EXPECT_NEAR(with.channels.back().values[0] / without.channels.back().values[0], 2.0, 1e-9);
}

// An azimuth axis at 60 deg of elevation: the motion is the same, its error at the sky half.
TEST(TrackingRun, BoresightErrorIsScaledByTheBoresightFactor) {
  Mission mission = reference::demo_mission();
  mission.wind_record = sine_wind(66.0);
  const auto whole = run_tracking(mission, steady_controller(), 1, {});
  mission.antenna.boresight_factor = 0.5;
  const auto half = run_tracking(mission, steady_controller(), 1, {});
  EXPECT_EQ(half.channels[2].values, whole.channels[2].values);
  EXPECT_NEAR((half.channels[3].values - 0.5 * whole.channels[3].values).cwiseAbs().maxCoeff() /
                  whole.channels[3].values.cwiseAbs().maxCoeff(),
              0.0, 1e-6);
  ASSERT_TRUE(whole.predicted_rms && half.predicted_rms && whole.boresight_rms &&
              half.boresight_rms);
  EXPECT_NEAR(*half.predicted_rms / *whole.predicted_rms, 0.5, 1e-9);
  EXPECT_NEAR(*half.boresight_rms / *whole.boresight_rms, 0.5, 1e-6);
  EXPECT_EQ(half.encoder_rms, whole.encoder_rms);
}

TEST(TrackingRun, EndsWhereItIsTold) {
  const auto run = run_tracking(reference::demo_mission(), steady_controller(), 1,
                                [](double done) { return done < 0.02; });
  EXPECT_FALSE(run.complete);
  EXPECT_NEAR(run.planned_duration, 660.0, 0.01);
  EXPECT_LT(run.duration, 60.0);
  EXPECT_FALSE(run.boresight_rms);  // not settled
  ASSERT_TRUE(run.tracking);
  EXPECT_FALSE(run.tracking->measured);
  EXPECT_EQ(run.tracking->mean_wind_speed, 10.0);
}

TEST(SlewRun, GoesTheWholeWayOnTheControllerItIsGiven) {
  const Mission mission = reference::demo_mission();
  const auto run = run_slew(mission, steady_controller(), 1, {});
  ASSERT_TRUE(run.slew);
  EXPECT_TRUE(run.complete);
  const SlewCourse& course = *run.slew;
  EXPECT_EQ(course.distance, degree);
  EXPECT_LE(course.largest_rate, course.wanted_rate * (1.0 + 1e-9));
  EXPECT_LE(course.attainable, course.wanted_rate);
  EXPECT_LE(course.acceleration, 0.2 * degree * (1.0 + 1e-9));
  const VectorXd& reference = run.channels[1].values;
  EXPECT_NEAR(reference[reference.size() - 1] - reference[0], 1.0, 1e-3);
  ASSERT_TRUE(run.overshoot);
  EXPECT_FALSE(run.predicted_rms);
  // Other gains move it otherwise.
  const auto slower = run_slew(mission, steady_controller(5.0), 1, {});
  ASSERT_TRUE(slower.complete);
  EXPECT_NE(slower.channels[2].values, run.channels[2].values);
  EXPECT_EQ(slower.channels[1].values, reference);
}

TEST(SlewRun, RefusesAnAntennaThatTheSupplyCannotMove) {
  Mission mission = reference::demo_mission();
  mission.antenna.friction_curve.coulomb_torque = 400.0;
  mission.antenna.friction_curve.breakaway_torque = 400.0;
  EXPECT_THROW(run_slew(mission, steady_controller(), 1, {}), InfeasibleRequirement);
}

TEST(PositionRun, NeedsWhatTheLinearPlantLeavesOut) {
  Mission mission = reference::demo_mission();
  mission.antenna.nonlinear.reset();
  EXPECT_THROW(run_tracking(mission, steady_controller(), 1, {}), InvalidInput);
  EXPECT_THROW(run_slew(mission, steady_controller(), 1, {}), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
