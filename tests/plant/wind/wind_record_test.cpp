#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "band_power.hpp"
#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/wind_record.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr WindModel models[] = {WindModel::uniform, WindModel::vickery, WindModel::coherence};

// Gusts about 10 m/s, made from Davenport's spectrum.
WindRecord windy(double duration = 600.0, double sample_time = 0.1, std::uint64_t seed = 11) {
  const StationarySeries gusts = gust_series(reference::wind_site(), 10.0, duration, sample_time);
  WindRecord record;
  record.sample_time = sample_time;
  record.speed = (10.0 + gusts.draw(seed).array()).abs();
  return record;
}

TEST(WindRecord, OfTheUniformModelIsTheQuasiStaticTorque) {
  const WindSite site = reference::wind_site();
  const WindRecord record = windy();
  const Eigen::VectorXd torque = wind_record_torque(record, site, {WindModel::uniform, false});
  const double area = std::numbers::pi * 35.0 * 35.0;
  const Eigen::VectorXd expected = 0.5 * 1.1 * area * 70.0 * 0.1 * record.speed.array().square();
  EXPECT_LT((torque - expected).norm(), 1e-13 * expected.norm());
}

TEST(WindRecord, KeepsTheMeanOfTheSquaresOrLeavesItOut) {
  const WindSite site = reference::wind_site();
  const WindRecord record = windy();
  const double mean = mean_wind_torque(site, 1.0) * record.speed.array().square().mean();
  for (const WindModel model : models) {
    const Eigen::VectorXd whole = wind_record_torque(record, site, {model, false});
    const Eigen::VectorXd rest = wind_record_torque(record, site, {model, true});
    EXPECT_NEAR(whole.mean() / mean, 1.0, 1e-13);
    EXPECT_NEAR(rest.mean() / mean, 0.0, 1e-13);
    EXPECT_LT((whole.array() - mean - rest.array()).abs().maxCoeff(), 1e-12 * mean);
  }
}

TEST(WindRecord, TakesOfASinusoidTheAdmittance) {
  // 10 m/s and a ripple small enough for V^2 to be linear; away from the ends.
  const WindSite site = reference::wind_site();
  const double step = 0.1;
  for (const WindModel model : models) {
    for (const double f : {0.02, 0.1, 0.7}) {
      WindRecord record{step, Eigen::VectorXd(6000), {}};
      for (Eigen::Index i = 0; i < 6000; ++i) {
        record.speed[i] = 10.0 + 1e-6 * std::cos(two_pi * f * step * static_cast<double>(i));
      }
      const Eigen::VectorXd torque = wind_record_torque(record, site, {model, true});
      const double gain =
          wind_admittance(site, model, 10.0, f) * wind_torque_sensitivity(site, 10.0) * 1e-6;
      double worst = 0.0;
      for (Eigen::Index i = 2000; i < 4000; ++i) {
        const double expected = gain * std::cos(two_pi * f * step * static_cast<double>(i));
        worst = std::max(worst, std::abs(torque[i] - expected));
      }
      EXPECT_LT(worst, (model == WindModel::uniform ? 1e-5 : 0.01) * gain)
          << to_string(model) << " " << f;
    }
  }
}

TEST(WindRecord, OfGustsHasTheSpectrumOfTheTorque) {
  // Small gusts, in which the square is linear, of Davenport's spectrum: the torque's bands are
  // those of the models' uniform part.
  WindSite site = reference::wind_site();
  site.surface_drag = 1e-7;
  const double duration = 900.0, step = 0.25;
  const StationarySeries gusts = gust_series(site, 10.0, duration, step);
  for (const WindModel model : {WindModel::vickery, WindModel::coherence}) {
    Eigen::ArrayXd powers = Eigen::ArrayXd::Zero(1800);
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      WindRecord record{step, 10.0 + gusts.draw(seed).array(), {}};
      powers +=
          reference::line_powers(wind_record_torque(record, site, {model, true}), true) / 40.0;
    }
    for (const reference::Band& band : {reference::Band{0.02, 0.08}, {0.08, 0.3}, {0.3, 1.2}}) {
      const double expected = reference::integral(
          [&](double f) {
            return wind_torque_spectrum(site, model, 10.0, f, WindTorquePart::uniform);
          },
          band);
      const double found = (powers * reference::fractions(1800, 1.0 / duration, band)).sum();
      EXPECT_NEAR(found / expected, 1.0, 0.06) << to_string(model) << " " << band.low;
    }
  }
}

TEST(WindRecord, ReadBackwardsGivesTheTorqueBackwards) {
  // Smoothing without phase, and the same at both ends.
  WindRecord record = windy(123.4);
  const WindSite site = reference::wind_site();
  for (const WindModel model : models) {
    const Eigen::VectorXd forwards = wind_record_torque(record, site, {model, false});
    WindRecord turned = record;
    turned.speed = record.speed.reverse();
    const Eigen::VectorXd backwards = wind_record_torque(turned, site, {model, false});
    EXPECT_LT((backwards.reverse() - forwards).norm(), 1e-3 * forwards.norm());
    EXPECT_LT(
        (forwards.array() - forwards.mean()).square().sum(),
        1.0000001 * (wind_record_torque(record, site, {WindModel::uniform, true}).squaredNorm()));
  }
}

TEST(WindRecord, OfASteadyWindIsTheMeanTorque) {
  const WindSite site = reference::wind_site();
  for (const Eigen::Index samples : {2, 3, 7, 997, 1024}) {
    const WindRecord record{0.1, Eigen::VectorXd::Constant(samples, 9.0), {}};
    for (const WindModel model : models) {
      const Eigen::VectorXd torque = wind_record_torque(record, site, {model, false});
      ASSERT_EQ(torque.size(), samples);
      EXPECT_LT((torque.array() / mean_wind_torque(site, 9.0) - 1.0).abs().maxCoeff(), 1e-13);
    }
  }
}

TEST(WindRecord, WithDirectionsFollowsTheTable) {
  Eigen::VectorXd yaw(3), elevation(2);
  yaw << -180.0 * degree, 0.0, 180.0 * degree;
  elevation << 0.0, 90.0 * degree;
  Eigen::MatrixXd values(3, 2);
  values << 0.2, 0.1, -0.1, 0.0, 0.2, 0.1;
  const TorqueCoefficientTable table(yaw, elevation, values);
  WindRecord record = windy(60.0);
  record.direction = Eigen::ArrayXd::LinSpaced(600, 0.0, 4.0 * two_pi);
  const DishDirection pointing{250.0 * degree, 30.0 * degree};
  const WindSite site = reference::wind_site();
  const Eigen::VectorXd torque =
      wind_record_torque(record, site, table, pointing, {WindModel::uniform, false});
  const double volume = std::numbers::pi / 4.0 * std::pow(70.0, 3);
  for (Eigen::Index i = 0; i < 600; ++i) {
    const double coefficient = table.at(record.direction[i] - pointing.azimuth, pointing.elevation);
    EXPECT_NEAR(torque[i], 0.55 * std::pow(record.speed[i], 2) * volume * coefficient,
                1e-12 * torque.cwiseAbs().maxCoeff());
  }
  // Into the wind all the time: as with the coefficient of that yaw.
  record.direction.setConstant(pointing.azimuth);
  const Eigen::VectorXd facing = wind_record_torque(record, site, table, pointing);
  const Eigen::VectorXd constant =
      wind_record_torque(record, at_attitude(site, table, 0.0, pointing.elevation));
  EXPECT_LT((facing - constant).norm(), 1e-13 * constant.norm());
  // Where the table ends, it says so.
  const TorqueCoefficientTable front(yaw.head(2) / 2.0, elevation, values.topRows(2));
  record.direction.setLinSpaced(0.0, two_pi);
  EXPECT_THAT(reference::Call([&] { wind_record_torque(record, site, front, pointing); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a yaw of")));
}

TEST(WindRecord, RefusesWhatNoAnemometerRecords) {
  const WindSite site = reference::wind_site();
  const auto refused = [&](const WindRecord& record, const char* words) {
    EXPECT_THAT(reference::Call([&] { wind_record_torque(record, site); }),
                ThrowsMessage<InvalidInput>(HasSubstr(words)));
  };
  const Eigen::VectorXd speed = Eigen::VectorXd::Constant(5, 8.0);
  for (const double bad : {0.0, -0.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
    refused({bad, speed, {}}, "wind_record_torque: expected a sample_time above 0");
  }
  refused({0.1, {}, {}}, "2 to 2^26 samples, found 0");
  refused({0.1, speed.head(1), {}}, "2 to 2^26 samples, found 1");
  for (const double bad : {-0.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
    Eigen::VectorXd wrong = speed;
    wrong[3] = bad;
    refused({0.1, wrong, {}}, "m/s at sample 3");
  }
  refused({0.1, 0.0 * speed, {}}, "speeds that are all 0");
  refused({0.1, speed, speed.head(4)}, "expected 5 directions or none, found 4");
  refused({0.1, speed, speed * std::nan("")}, "finite directions");
  const Eigen::VectorXd axis = Eigen::VectorXd::LinSpaced(2, 0.0, 1.0);
  const TorqueCoefficientTable table(axis, axis, Eigen::MatrixXd::Zero(2, 2));
  EXPECT_THAT(reference::Call([&] {
                wind_record_torque({0.1, speed, {}}, site, table, {});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("a record with directions")));
  EXPECT_THROW(wind_record_torque({0.1, speed, {}}, site, {static_cast<WindModel>(8), false}),
               InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
