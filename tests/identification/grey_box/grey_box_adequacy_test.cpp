#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/synthetic_drive.hpp"
#include "refused_call.hpp"
#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using synthetic::bulk;
using synthetic::P;
using synthetic::quick;
using synthetic::Truth;
using testing::HasSubstr;
using testing::ThrowsMessage;

bool covers(const numerics::Interval& interval, double truth) {
  return interval.lower <= truth && truth <= interval.upper;
}

TEST(GreyBoxConflict, CountsWhatIsStatedAndWidensForWhatInertiaRestsOn) {
  const GreyBoxParameters parameters = synthetic::truth_parameters();
  VectorXd point = VectorXd::Zero(parameters.size());
  point(P::coulomb_torque) = 9.0;  // a guess of ours: nobody has stated it
  auto conflict = grey_box_conflict(parameters, point, {});
  EXPECT_EQ(conflict.sum, 0.0);
  EXPECT_FALSE(conflict.beyond_scatter());
  point(P::valve_gain) = -20.0;
  conflict = grey_box_conflict(parameters, point, {});
  EXPECT_TRUE(conflict.beyond_scatter());
  EXPECT_EQ(conflict.largest, "valve scale");
  EXPECT_EQ(conflict.departure, -20.0);
  EXPECT_EQ(conflict.widening, 1.0);
  point(P::motor_inertia) = 10.0;
  conflict = grey_box_conflict(parameters, point, {});
  EXPECT_EQ(conflict.sum, 500.0);
  // Two of those counted, valve and supply, do not widen.
  EXPECT_DOUBLE_EQ(conflict.widening, 100.0 / (conflict.count - 2));

  GreyBoxPosterior posterior;
  posterior.covariance = VectorXd::Constant(parameters.size(), 0.25).asDiagonal();
  widen(posterior, parameters, conflict);
  EXPECT_NEAR(posterior.covariance(P::motor_inertia, P::motor_inertia), 0.25 * conflict.widening,
              1e-9);
  EXPECT_NEAR(posterior.covariance(P::coulomb_torque, P::coulomb_torque), 1.0, 1e-9);
}

TEST(GreyBoxConflict, WidensByOneNumberThatAllOthersContradict) {
  const GreyBoxParameters parameters = synthetic::truth_parameters();
  const VectorXd point = VectorXd::Zero(parameters.size());
  StatedNumberCheck supply;
  supply.name = "supply pressure as torque";
  supply.moves_inertia = true;
  supply.departure = 3.0;
  EXPECT_EQ(grey_box_conflict(parameters, point, {supply}).widening, 1.0);
  supply.departure = -4.0;
  StatedNumberCheck valve;
  valve.departure = 6.0;  // the inertia does not rest on it
  const auto conflict = grey_box_conflict(parameters, point, {valve, supply});
  ASSERT_EQ(conflict.contradicted.size(), 1U);
  EXPECT_EQ(conflict.contradicted[0].name, supply.name);
  EXPECT_DOUBLE_EQ(conflict.widening, 16.0);
}

TEST(CheckStatedNumbers, AlwaysCountTheSupplyWhichWitnessesAllPressures) {
  const Truth truth;
  const auto result =
      fit_grey_box(synthetic::campaign(truth.parameters, truth.point, 0.005, 11), bulk, quick());
  const auto supply = std::ranges::find(result.stated_numbers, "supply pressure as torque",
                                        &StatedNumberCheck::name);
  ASSERT_NE(supply, result.stated_numbers.end());
  EXPECT_TRUE(supply->moves_inertia);
}

TEST(FitGreyBox, SaysWhenRecordsContradictADrawingAndNoLongerHidesIt) {
  const Truth truth;
  Campaign campaign = synthetic::campaign(truth.parameters, truth.point, 0.005, 11);
  const auto right = fit_grey_box(campaign, bulk, quick());
  EXPECT_FALSE(right.conflict.beyond_scatter()) << right.conflict.sum;
  EXPECT_EQ(right.conflict.widening, 1.0);
  EXPECT_FALSE(right.estimate.contradicted);
  // Half of the displacement: torque per pressure by half, flow per rate by half.
  campaign.knowledge.displacement = {5e-6, 1e-8};
  const auto wrong = fit_grey_box(campaign, bulk, quick());
  EXPECT_TRUE(wrong.conflict.beyond_scatter());
  EXPECT_GT(wrong.conflict.widening, 2.0);
  EXPECT_TRUE(wrong.estimate.contradicted);
  const auto width = [](const GreyBoxResult& result) {
    const auto& interval = result.quantity("inertia").posterior;
    return (interval.upper - interval.lower) / interval.value;
  };
  EXPECT_GT(width(wrong), 1.4 * width(right));
}

TEST(FitGreyBox, DoesNotTellOffsetFromFrictionWhereTheDriveMovesOneWay) {
  const Truth truth;
  Campaign campaign = synthetic::campaign(truth.parameters, truth.point, 0.005, 11);
  std::erase_if(campaign.records, [](const DriveRecord& record) { return record.name != "sweep"; });
  const auto result = fit_grey_box(campaign, bulk, quick());
  EXPECT_FALSE(result.motion.both_ways());
  EXPECT_GT(result.motion.upward, 10.0);
  for (const auto* name : {"offset torque as recorded", "Coulomb level"}) {
    EXPECT_FALSE(result.quantity(name).identified) << name;
  }
  const auto& offset = result.quantity("offset torque as recorded").posterior;
  EXPECT_TRUE(covers(offset, truth.drive.offset_as_recorded)) << offset.lower << offset.upper;
  EXPECT_TRUE(covers(result.quantity("Coulomb level").posterior, truth.drive.coulomb_level));
  EXPECT_GT(offset.upper - offset.lower, 5.0);
  // What one way does show, both together, is as sure as ever.
  VectorXd sums(static_cast<Index>(result.random_samples.size()));
  for (Index i = 0; i < sums.size(); ++i) {
    const auto& draw = result.random_samples[static_cast<std::size_t>(i)];
    sums(i) = draw.offset_as_recorded + friction_torque(draw.friction, 8.0);
  }
  EXPECT_LT(numerics::interval_from_samples(sums.mean(), sums).standard_uncertainty,
            0.3 * offset.standard_uncertainty);
}

TEST(FitGreyBox, DoesNotTellALevelThatTheDriveIsTooSlowToReach) {
  GreyBoxRecord slow = synthetic::glance();
  slow.rate *= 0.08;  // 2 rad/s, friction saturates at 1.5
  const auto motion = motion_of({slow});
  EXPECT_TRUE(motion.both_ways());
  EXPECT_NEAR(motion.highest_rate, 2.0, 0.01);
  const Truth truth;
  GreyBoxPosterior posterior;
  posterior.point = truth.point;
  posterior.covariance = 1e-6 * Eigen::MatrixXd::Identity(truth.point.size(), truth.point.size());
  add_unidentifiable_directions(posterior, truth.parameters, motion);
  EXPECT_EQ(posterior.one_way, 0.0);
  EXPECT_GT(posterior.unsaturated, 0.5);
  double minimum = 1e9, maximum = 0.0;
  for (const auto& draw : posterior_samples(truth.parameters, posterior, 200, 3)) {
    minimum = std::min(minimum, draw.coulomb_level);
    maximum = std::max(maximum, draw.coulomb_level);
    // Slow friction, which was seen, stays.
    EXPECT_NEAR(friction_torque(draw.friction, 0.02), friction_torque(truth.drive.friction, 0.02),
                0.05 * friction_torque(truth.drive.friction, 0.02));
  }
  EXPECT_GT(maximum, 2.0 * minimum);
  GreyBoxPosterior fast = posterior;
  fast.unsaturated = 0.0;
  add_unidentifiable_directions(fast, truth.parameters, motion_of({synthetic::glance()}));
  EXPECT_EQ(fast.unsaturated, 0.0);
  // Faster than what a fit takes for saturation, friction rises on: 25 rad/s at 1 N m s/rad, over a
  // level of 18 N m.
  fast.point = synthetic::point_of(truth.parameters, {{P::coulomb_torque, 4.0},
                                                      {P::saturating_torque, 14.0},
                                                      {P::saturating_rate, 1.5},
                                                      {P::viscous_friction, 1.0}});
  add_unidentifiable_directions(fast, truth.parameters, motion_of({synthetic::glance()}));
  EXPECT_GT(fast.unsaturated, 0.5);
}

TEST(FitGreyBox, TakesWindThatLastsForOneObservationARecord) {
  const Truth truth;
  Campaign calm = synthetic::campaign(truth.parameters, truth.point, 0.005, 11);
  Campaign windy = calm;
  const double pressure = 1.0 / (torque_per_pressure(calm.knowledge) * calm.knowledge.motor_count);
  // Of mean zero over the records, half a N m each: what a mean over five of them is off by.
  const double winds[] = {0.5, -0.6, 0.4, -0.5, 0.2};
  for (std::size_t i = 0; i < windy.records.size(); ++i) {
    for (auto& signal : windy.records[i].inlet_pressure) {
      signal.values.array() += winds[i] * pressure;
    }
  }
  const auto spread = [](const Campaign& campaign) {
    return fit_grey_box(campaign, bulk, quick())
        .quantity("offset torque as recorded")
        .posterior.standard_uncertainty;
  };
  EXPECT_GT(spread(windy), 0.15);
  EXPECT_LT(spread(calm), 0.12);
  // A pressure that stands for another does not know its zero.
  calm.instruments.unknown_pressure_sum = 2.0 * calm.knowledge.motor_count * pressure;
  EXPECT_GT(spread(calm), 1.8);
}

TEST(GreyBoxParameters, TakeNoGearsForKnownAndABulkModulusForWhatItIs) {
  Campaign campaign{synthetic::knowledge(), synthetic::instruments(), {}};
  campaign.knowledge.gear_inertia = {0.0, 0.0};
  const GreyBoxParameters without(campaign, {synthetic::glance()}, bulk);
  EXPECT_EQ(without.list()[P::gear_inertia].prior, 0.0);
  EXPECT_EQ(without.list()[P::gear_inertia].spread, 0.0);
  EXPECT_TRUE(without.values(VectorXd::Zero(without.size())).allFinite());
  EXPECT_TRUE(without.list()[P::bulk_modulus].from_drawings);
  const GreyBoxParameters guessed(campaign, {synthetic::glance()}, bulk, true);
  EXPECT_FALSE(guessed.list()[P::bulk_modulus].from_drawings);
  EXPECT_EQ(guessed.list()[P::bulk_modulus].prior, 1.3e9);
  campaign.knowledge.gear_inertia = {-0.1, 0.0};
  EXPECT_THAT(reference::Call([&] { GreyBoxParameters(campaign, {synthetic::glance()}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("gear inertia")));
}

TEST(GreyBoxParameters, KnowTheSupplyAsWellAsStatedAndNoBetterThanOnePercent) {
  Campaign campaign{synthetic::knowledge(), synthetic::instruments(), {}};
  const auto spread = [&](double relative) {
    campaign.knowledge.supply_uncertainty = relative * campaign.knowledge.supply_pressure;
    return GreyBoxParameters(campaign, {synthetic::glance()}, bulk).list()[P::supply_torque].spread;
  };
  EXPECT_EQ(spread(0.0), 0.01);
  EXPECT_EQ(spread(0.001), 0.01);
  EXPECT_DOUBLE_EQ(spread(0.04), 0.04);
}

TEST(GreyBoxParameters, TakeBothEfficienciesIntoTheSpringWhateverTheConvention) {
  Campaign campaign{synthetic::knowledge(), synthetic::instruments(), {}};
  const GreyBoxParameters with(campaign, {synthetic::glance()}, bulk);
  campaign.knowledge.efficiency_in_stiffness = plant::EfficiencyInStiffness::none;
  const GreyBoxParameters without(campaign, {synthetic::glance()}, bulk);
  const VectorXd zero = VectorXd::Zero(with.size());
  EXPECT_DOUBLE_EQ(with.oil_stiffness(with.values(zero)),
                   without.oil_stiffness(without.values(zero)));
  EXPECT_EQ(with.hydraulic(zero, true).values, without.hydraulic(zero, true).values);
}

}  // namespace
}  // namespace boresight::identification
