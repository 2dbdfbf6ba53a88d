#include <cmath>

#include <gtest/gtest.h>

#include "identification/synthetic_drive.hpp"
#include <boresight/identification/grey_box/grey_box.hpp>

namespace boresight::identification {
namespace {

using synthetic::bulk;
using synthetic::quick;
using synthetic::Truth;

Campaign campaign() {
  const Truth truth;
  return synthetic::campaign(truth.parameters, truth.point, 0.005, 11);
}

TEST(RecordInfluences, AreWhatAFitWithoutTheRecordGives) {
  const Campaign all = campaign();
  const auto result = fit_grey_box(all, bulk, quick());
  ASSERT_EQ(result.influences.size(), all.records.size());
  for (std::size_t k = 0; k < all.records.size(); ++k) {
    Campaign others = all;
    others.records.erase(others.records.begin() + static_cast<std::ptrdiff_t>(k));
    const auto without = fit_grey_box(others, bulk, quick());
    const auto& influence = result.influences[k];
    EXPECT_EQ(influence.record, all.records[k].name);
    const double uncertainty = result.quantity("inertia").posterior.standard_uncertainty;
    EXPECT_NEAR(influence.inertia.value, without.estimate.inertia, 0.5 * uncertainty)
        << influence.record;
    EXPECT_NEAR(influence.change, result.estimate.inertia / influence.inertia.value - 1.0, 1e-9);
    EXPECT_GE(influence.information, 0.0);
    EXPECT_LT(influence.information, 1.0);
  }
}

TEST(RecordInfluences, ShowTheRecordOfATachometerOnAnotherScale) {
  Campaign one = campaign();
  const auto before = fit_grey_box(one, bulk, quick());
  // The record that the inertia rests on most.
  std::size_t place = 0;
  for (std::size_t k = 0; k < before.influences.size(); ++k) {
    if (before.influences[k].information > before.influences[place].information) place = k;
  }
  one.records[place].motor_rate.values *= 1.05;
  const auto after = fit_grey_box(one, bulk, quick());
  const auto& spoilt = after.influences[place];
  // Without it the inertia is again that of before.
  EXPECT_LT(std::abs(spoilt.inertia.value / before.estimate.inertia - 1.0),
            0.6 * std::abs(after.estimate.inertia / before.estimate.inertia - 1.0));
  for (std::size_t k = 0; k < after.influences.size(); ++k) {
    if (k == place) continue;
    EXPECT_LT(std::abs(after.influences[k].change), std::abs(spoilt.change));
  }
}

}  // namespace
}  // namespace boresight::identification
