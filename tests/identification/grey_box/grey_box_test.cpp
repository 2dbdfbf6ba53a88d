#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/synthetic_drive.hpp"
#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/grey_box/grey_box_hold_out.hpp>
#include <boresight/identification/grey_box/grey_box_information_gain.hpp>
#include <boresight/identification/grey_box/grey_box_mechanics.hpp>
#include <boresight/identification/grey_box/grey_box_search.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using synthetic::bulk;
using synthetic::P;
using synthetic::quick;
using synthetic::Truth;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

// One campaign and its fit serve several tests.
const Campaign& reference_campaign() {
  static const Truth truth;
  static const Campaign campaign = synthetic::campaign(truth.parameters, truth.point, 0.005, 11);
  return campaign;
}

const GreyBoxResult& reference_result() {
  static const GreyBoxResult result = fit_grey_box(reference_campaign(), bulk, quick());
  return result;
}

bool covers(const numerics::Interval& interval, double truth) {
  return interval.lower <= truth && truth <= interval.upper;
}

TEST(GreyBoxParameters, CoefficientsFollowThePointAsTheirDerivativesSay) {
  const Truth truth;
  const auto expect = [&](const auto& coefficients) {
    const Eigen::MatrixXd by = coefficients(truth.point).by_point;
    for (Index i = 0; i < truth.point.size(); ++i) {
      VectorXd moved = truth.point;
      constexpr double step = 1e-4;
      moved(i) += step;
      const VectorXd more = coefficients(moved).values;
      moved(i) -= 2.0 * step;
      const VectorXd difference = (more - coefficients(moved).values) / (2.0 * step);
      EXPECT_LT((difference - by.col(i)).norm(), 1e-7 * (by.col(i).norm() + 1e-3))
          << truth.parameters.list()[static_cast<std::size_t>(i)].name;
    }
  };
  expect([&](const VectorXd& x) { return truth.parameters.mechanical(x); });
  expect([&](const VectorXd& x) { return truth.parameters.hydraulic(x, true); });
  expect([&](const VectorXd& x) { return truth.parameters.hydraulic(x, false); });
}

TEST(GreyBoxParameters, AllInertiaIsInTheCoefficientsAsTheRecorderShowsIt) {
  const Truth truth;
  const auto c = truth.parameters.mechanical(truth.point).values;
  const double sum =
      c(MechanicalCoefficients::rigid_inertia) + c(MechanicalCoefficients::inertia(0));
  EXPECT_NEAR(sum, truth.drive.inertia_as_recorded, 1e-12);
  EXPECT_NEAR(truth.drive.inertia, 1.004 + 0.19 + 0.55, 1e-12);
  EXPECT_NEAR(truth.drive.rigid_inertia + truth.drive.mode_inertia.sum(), truth.drive.inertia,
              1e-12);
}

TEST(GreyBoxSearch, FindsTheTruthExactlyInRecordsWithoutErrors) {
  // The rate is the model's own at the truth; the search starts at the priors.
  const Truth truth;
  GreyBoxRecord record = synthetic::glance();
  const Index samples = record.rate.size();
  record.name = "own";
  for (Index k = 0; k < samples; ++k) {
    const double t = 0.02 * static_cast<double>(k);
    record.torque(k) = -2.5 + 30.0 * std::sin(0.8 * t) + 12.0 * std::sin(0.31 * t * t);
  }
  record.common = VectorXd::Zero(samples);
  record.valve.resize(0);
  record.rate_known.assign(1000, true);
  record.rate_restarts.assign(1000, false);
  record.rate_restarts[0] = true;
  record.rate.setZero();
  const auto c = truth.parameters.mechanical(truth.point).values;
  MechanicalStepper motor(c, record.sample_time, false);
  const double zero = c(MechanicalCoefficients::tachometer_zero);
  record.rate(0) = zero;
  motor.restart(0.0, record.torque(0));
  for (Index k = 0; k + 1 < samples; ++k) {
    ASSERT_TRUE(motor.step(0.5 * (record.torque(k) + record.torque(k + 1)), 0.0, 0.0, VectorXd()));
    record.rate(k + 1) = motor.tachometer() + zero;
  }
  const std::vector<GreyBoxRecord> records{record};
  GreyBoxObjective objective(records, truth.parameters, 1);
  objective.reweigh(VectorXd::Zero(truth.point.size()));
  VectorXd point = search_with_scales(objective, VectorXd::Zero(truth.point.size())).x;
  const DriveEstimate found = drive_estimate(truth.parameters, point);
  // What this one record shows is found to the priors' pull, which without errors has no weight.
  EXPECT_NEAR(found.inertia_as_recorded, truth.drive.inertia_as_recorded,
              1e-6 * truth.drive.inertia_as_recorded);
  EXPECT_NEAR(found.offset_as_recorded, -2.5, 1e-5);
  EXPECT_NEAR(found.lowest_frequency, 2.55, 1e-5);
  for (const double rate : {0.5, 2.0, 10.0}) {
    const double factor = found.inertia_as_recorded / found.inertia;  // transducers' gains
    const double expected = friction_torque(truth.drive.friction, rate);
    EXPECT_NEAR(friction_torque(found.friction, rate) * factor,
                expected * truth.drive.inertia_as_recorded / truth.drive.inertia, 1e-3 * expected)
        << rate;
  }
}

TEST(FitGreyBox, FindsTheDriveAndItsIntervalsHoldTheTruth) {
  const Truth truth;
  const auto& result = reference_result();
  for (const auto& quantity : drive_quantities()) {
    const auto& found = result.quantity(quantity.name);
    EXPECT_TRUE(covers(found.posterior, truth.drive.*quantity.member))
        << quantity.name << ": " << found.posterior.lower << " to " << found.posterior.upper
        << ", truth " << truth.drive.*quantity.member;
  }
  const auto& j = result.quantity("inertia as recorded").posterior;
  EXPECT_NEAR(j.value, truth.drive.inertia_as_recorded, 0.01 * j.value);
  EXPECT_LT(j.upper - j.lower, 0.04 * j.value);
  EXPECT_NEAR(result.quantity("leakage rate").posterior.value, truth.drive.leakage_rate,
              0.1 * truth.drive.leakage_rate);
  for (const double rate : {1.0, 4.0, 12.0}) {
    const double expected = friction_torque(truth.drive.friction, rate);
    const numerics::Interval found = friction_interval(result, rate);
    EXPECT_NEAR(found.value, expected, 0.02 * expected) << rate;
    EXPECT_TRUE(covers(found, expected)) << rate;
  }
  EXPECT_TRUE(result.quantity("leakage rate").identified);
  EXPECT_EQ(result.random_samples.size(), 400u);
  EXPECT_EQ(result.records.size(), 5u);
  EXPECT_TRUE(result.without_valve.empty());
  EXPECT_GT(result.rank, 10);
  EXPECT_LE(result.rank, result.varied);
}

TEST(FitGreyBox, IsTheSameForAnyNumberOfThreads) {
  auto options = quick();
  options.threads = 3;
  const auto three = fit_grey_box(reference_campaign(), bulk, options);
  const auto& alone = reference_result();
  EXPECT_EQ(alone.posterior.point, three.posterior.point);
  EXPECT_EQ(alone.posterior.covariance, three.posterior.covariance);
  EXPECT_EQ(alone.quantity("leakage rate").posterior.lower,
            three.quantity("leakage rate").posterior.lower);
}

TEST(FitGreyBox, OfTheMirroredCampaignIsTheSameDriveWithTheOffsetTurned) {
  Campaign mirrored = reference_campaign();
  for (auto& record : mirrored.records) {
    std::swap(record.inlet_pressure, record.outlet_pressure);
    record.motor_rate.values *= -1.0;
    record.valve_command->values *= -1.0;
    record.rate_command->values *= -1.0;
  }
  const auto result = fit_grey_box(mirrored, bulk, quick());
  const auto& reference = reference_result();
  for (const auto& q : reference.quantities) {
    const double sign = q.name == "offset torque as recorded" ? -1.0 : 1.0;
    EXPECT_NEAR(sign * result.quantity(q.name).posterior.value, q.posterior.value,
                0.05 * q.posterior.standard_uncertainty)
        << q.name;
  }
}

TEST(FitGreyBox, SaysWhatIsNotIdentifiable) {
  Campaign blind = reference_campaign();
  for (auto& record : blind.records) {
    record.valve_command.reset();
    record.rate_command.reset();
  }
  const auto result = fit_grey_box(blind, bulk, quick());
  const auto& leakage = result.quantity("leakage rate");
  EXPECT_FALSE(leakage.identified);
  EXPECT_GT(leakage.posterior.upper, 5.0 * leakage.posterior.lower);
  EXPECT_THAT(result.notes,
              Contains(HasSubstr("The leakage rate is not identifiable from these records")));
  EXPECT_THAT(result.notes, Contains(HasSubstr("Nothing is known of the valve in slow, middle")));
  EXPECT_TRUE(result.quantity("inertia as recorded").identified);
  EXPECT_EQ(result.without_valve.size(), 5u);
  EXPECT_EQ(result.pressure_scale, 0.0);
  EXPECT_THAT(reference_result().notes, Not(Contains(HasSubstr("leakage rate is not"))));
}

TEST(FitGreyBox, SaysWhereRecordsContradictTheDrawings) {
  Campaign wrong = reference_campaign();
  wrong.knowledge.locked_rotor_frequencies = {{2.0, 0.02}};
  const auto result = fit_grey_box(wrong, bulk, quick());
  EXPECT_THAT(result.notes, Contains(AllOf(HasSubstr("of the stated locked-rotor frequency 1"),
                                           HasSubstr("standard uncertainties away"))));
}

TEST(FitGreyBox, TakesKnowledgeWithoutUncertaintyAndADriveWithoutStructure) {
  Campaign campaign = reference_campaign();
  campaign.knowledge.locked_rotor_frequencies.clear();
  campaign.instruments = {};
  campaign.knowledge.volume_1.standard_uncertainty = 0.0;
  campaign.knowledge.motor_inertia.standard_uncertainty = 0.0;
  const auto result = fit_grey_box(campaign, {}, quick());
  EXPECT_EQ(result.quantity("lowest locked-rotor frequency").posterior.value, 0.0);
  EXPECT_FALSE(result.quantity("lowest locked-rotor frequency").identified);
  EXPECT_EQ(result.parameters[P::motor_inertia].value, 1.0);
  EXPECT_EQ(result.parameters[P::volume_1].departure, 0.0);
  const auto& bulk_modulus = result.quantity("bulk modulus");
  EXPECT_TRUE(bulk_modulus.identified);
  EXPECT_TRUE(covers(bulk_modulus.posterior, 1.3e9));
}

TEST(FitGreyBox, IntervalsHoldOverAFamilyOfDrives) {
  // Truths drawn from the priors, transducers off by their standard uncertainties: of four drives
  // and five quantities, 20 intervals of 95 %, fewer than 16 have a probability of 3e-3.
  const Truth reference;
  reference::RandomNumbers random(3);
  const auto normal = [&] {
    return std::sqrt(-2.0 * std::log(random.uniform(1e-12, 1.0))) *
           std::cos(random.uniform(0.0, 6.283185307179586));
  };
  int covered = 0;
  for (int drive = 0; drive < 4; ++drive) {
    VectorXd point = reference.point;
    for (const Index i : {P::motor_inertia, P::gear_inertia, P::antenna_inertia, P::pressure_gain,
                          P::torque_factor, P::flow_factor, P::tachometer_gain, P::bulk_modulus,
                          P::volume_1, P::volume_2, P::valve_gain, P::common_torque}) {
      point(i) = normal();
    }
    for (const Index i : {P::coulomb_torque, P::saturating_torque, P::saturating_rate,
                          P::viscous_friction, P::cross_leakage}) {
      point(i) += 0.3 * normal();
    }
    const DriveEstimate truth = drive_estimate(reference.parameters, point);
    const Campaign campaign = synthetic::campaign(reference.parameters, point, 0.01,
                                                  100 + 10 * static_cast<std::uint64_t>(drive));
    const auto result = fit_grey_box(campaign, bulk, quick());
    for (const auto* name :
         {"inertia", "oil stiffness", "leakage rate", "Coulomb level", "inertia as recorded"}) {
      const auto quantity =
          std::find_if(drive_quantities().begin(), drive_quantities().end(),
                       [&](const DriveQuantity& q) { return std::string(q.name) == name; });
      const bool in = covers(result.quantity(name).posterior, truth.*quantity->member);
      covered += in ? 1 : 0;
    }
  }
  EXPECT_GE(covered, 16);
}

TEST(FitGreyBox, RefusesAndStopsAsAsked) {
  auto options = quick();
  options.random_samples = 10;
  EXPECT_THAT(reference::Call([&] { fit_grey_box(reference_campaign(), bulk, options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least 100 samples")));
  options = quick();
  options.progress = [](const std::string&, double fraction) { return fraction < 0.3; };
  EXPECT_THAT(reference::Call([&] { fit_grey_box(reference_campaign(), bulk, options); }),
              ThrowsMessage<Interrupted>(HasSubstr("stopped as asked")));
  Campaign empty = reference_campaign();
  empty.records.clear();
  EXPECT_THAT(reference::Call([&] { fit_grey_box(empty, bulk, quick()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least one record")));
  Campaign still = reference_campaign();
  for (auto& record : still.records) record.motor_rate.values.setZero();
  EXPECT_THAT(reference::Call([&] { fit_grey_box(still, bulk, quick()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("records that move")));
  Campaign unknown = reference_campaign();
  unknown.knowledge.volume_2.value = 0.0;
  EXPECT_THAT(reference::Call([&] { fit_grey_box(unknown, bulk, quick()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a positive volume of side 2")));
  EXPECT_THAT(reference::Call([] { static_cast<void>(reference_result().quantity("colour")); }),
              ThrowsMessage<InvalidInput>(HasSubstr("'colour' is not among the quantities")));
}

TEST(CompareWith, NormalisesDifferencesByBothUncertainties) {
  const auto& result = reference_result();
  const numerics::Interval& own = result.quantity("inertia").posterior;
  const double s = own.standard_uncertainty;
  const auto compared = compare_with(
      result, "inertia", {{"simple", numerics::normal_interval(own.value + 5.0 * s, 3.0 * s)}});
  ASSERT_EQ(compared.size(), 1u);
  EXPECT_EQ(compared[0].name, "simple");
  EXPECT_NEAR(compared[0].normalised, 5.0 / std::sqrt(10.0), 1e-9);
  EXPECT_NEAR(compared[0].relative, 5.0 * s / own.value, 1e-12);
}

TEST(RankTests, RanksByWhatATestWouldTeach) {
  // Without any fast motion in the campaign a fast test teaches most about friction's level.
  Campaign slow = reference_campaign();
  slow.records.erase(slow.records.begin() + 1, slow.records.end());
  const auto result = fit_grey_box(slow, bulk, quick());
  const auto ranked = rank_tests(result, reference_campaign(), "leakage rate");
  ASSERT_EQ(ranked.size(), 8u);
  double before = 0.0;
  for (const auto& gain : ranked) {
    ASSERT_EQ(gain.remaining.size(), drive_quantities().size());
    EXPECT_GE(gain.remaining[5], before);
    before = gain.remaining[5];
    for (const double fraction : gain.remaining) {
      EXPECT_GT(fraction, 0.0);
      EXPECT_LE(fraction, 1.0 + 1e-9);
    }
  }
  // The slow test once more teaches less than the best new one.
  const auto slowly = std::find_if(
      ranked.begin(), ranked.end(),
      [](const GreyBoxInformationGain& g) { return g.test == "constant speed, slow"; });
  EXPECT_LT(ranked[0].remaining[5], 0.9);
  EXPECT_GT(slowly->remaining[5], ranked[0].remaining[5]);
  EXPECT_TRUE(slowly->done_before);
  EXPECT_THAT(reference::Call([&] { rank_tests(result, slow, "colour"); }),
              ThrowsMessage<InvalidInput>(HasSubstr("is not among the quantities")));
}

TEST(ValidateDrive, DrivenByTheValveAloneDoesWhatWasRecorded) {
  // A record that was not fitted: slow valve steps.
  const Truth truth;
  const auto steps = simulate_drive(
      truth.parameters, truth.point,
      synthetic::manoeuvre("steps", TestKind::valve_steps, 20.0, false, [](double t) {
        return t < 1.0 ? 0.0 : std::fmod(t, 7.0) < 3.0 ? 6.0 : 9.0;
      }));
  const auto& result = reference_result();
  const auto good = validate_drive(result.model.at(0), result.posterior.point, steps);
  EXPECT_LT(good.rate_error, 0.02);
  EXPECT_LT(good.torque_error, 0.02);
  // The drawings alone do worse.
  const auto drawn =
      validate_drive(result.model.at(0), VectorXd::Zero(result.posterior.point.size()), steps);
  EXPECT_GT(drawn.rate_error, 3.0 * good.rate_error);
  GreyBoxRecord blind = steps;
  blind.valve.resize(0);
  EXPECT_THAT(
      reference::Call([&] { validate_drive(result.model.at(0), result.posterior.point, blind); }),
      ThrowsMessage<InvalidInput>(HasSubstr("has no valve command")));
}

TEST(HoldOutRecord, ForetellsATestThatWasNotFitted) {
  const auto held = hold_out_record(reference_campaign(), "ramp", bulk, quick());
  EXPECT_LT(held.error.rate_error, 0.02);
  EXPECT_LT(held.error.torque_error, 0.03);
  EXPECT_EQ(held.simulated.samples(), held.recorded.samples());
  EXPECT_THAT(reference::Call([] { hold_out_record(reference_campaign(), "none", bulk, quick()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("no record of the campaign is named 'none'")));
}

TEST(Autocorrelations, AreOneOverTheLagForASawtoothAndNoneForNoise) {
  VectorXd alternating(100);
  for (Index k = 0; k < 100; ++k) alternating(k) = k % 2 == 0 ? 1.0 : -1.0;
  const VectorXd found = autocorrelations(alternating, 3);
  EXPECT_NEAR(found(0), -0.99, 1e-12);
  EXPECT_NEAR(found(1), 0.98, 1e-12);
  EXPECT_EQ(autocorrelations(VectorXd::Zero(10), 2), VectorXd::Zero(2));
}

}  // namespace
}  // namespace boresight::identification
