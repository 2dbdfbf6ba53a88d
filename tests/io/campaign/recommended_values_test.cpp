#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/io/campaign/recommended_values.hpp>

namespace boresight::io {
namespace {

using identification::DefectHandling;
using identification::DefectKind;
using identification::GreyBoxQuantity;
using numerics::normal_interval;
using testing::ElementsAre;

CampaignSection fitted() {
  CampaignSection section;
  section.grey_box.emplace();
  for (const auto& [name, value] : {std::pair{"inertia", 1.8}, {"motor to load ratio", 2.0}}) {
    GreyBoxQuantity quantity;
    quantity.name = name;
    quantity.posterior = normal_interval(value, 0.01);
    section.grey_box->quantities.push_back(quantity);
  }
  return section;
}

RecordNotes record(const std::string& name, DefectKind kind, DefectHandling handling,
                   Eigen::Index samples) {
  RecordNotes notes;
  notes.name = name;
  notes.rows = 1000;
  notes.defects.push_back({kind, handling, "tach", 0, 0.0, samples, "why"});
  return notes;
}

TEST(RecommendedValues, AreThoseOfAFitThatContradictsNothing) {
  const auto values = recommended(fitted());
  ASSERT_TRUE(values);
  EXPECT_EQ(values->inertia.value, 1.8);
  EXPECT_EQ(values->motor_to_load_ratio.value, 2.0);
  EXPECT_EQ(rejection(fitted()), Rejection::none);
}

TEST(RecommendedValues, AreNoneOfAFitThatContradictsItsCase) {
  CampaignSection section = fitted();
  section.grey_box->conflict.widening = 28.0;
  EXPECT_EQ(rejection(section), Rejection::contradicts_case);
  EXPECT_FALSE(recommended(section));
  section = fitted();
  section.grey_box->estimate.contradicted = true;
  EXPECT_FALSE(recommended(section));
}

TEST(RecommendedValues, AreNoneWhereTheFitFailedWhateverTheMeanOfMethods) {
  CampaignSection section;
  section.mean_of_methods.emplace();
  section.mean_of_methods->value = 20.762;
  EXPECT_EQ(rejection(section), Rejection::fit_failed);
  EXPECT_FALSE(recommended(section));
}

TEST(Suspicions, PutRefusedRecordsFirstAndCountedSamplesLast) {
  CampaignSection section = fitted();
  section.notes.records = {record("a", DefectKind::missing_samples, DefectHandling::bridged, 20),
                           record("b", DefectKind::dead_channel, DefectHandling::replaced, 1000),
                           record("c", DefectKind::wrong_scale, DefectHandling::refused, 1000),
                           record("d", DefectKind::dead_channel, DefectHandling::replaced, 1000)};
  const auto found = suspicions(section);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_THAT(found[0].records, ElementsAre("c"));
  EXPECT_TRUE(found[0].record_refused);
  EXPECT_THAT(found[1].records, ElementsAre("b", "d"));
  EXPECT_THAT(found[1].channels, ElementsAre("tach"));
  EXPECT_EQ(found[2].finding, "missing samples");
  EXPECT_DOUBLE_EQ(found[2].fraction, 0.02);
}

TEST(Suspicions, LeaveWhatEveryCampaignHas) {
  CampaignSection section = fitted();
  section.notes.records = {record("a", DefectKind::clipped, DefectHandling::masked, 300),
                           record("b", DefectKind::missing_samples, DefectHandling::masked, 3),
                           record("c", DefectKind::jitter, DefectHandling::resampled, 1000)};
  EXPECT_TRUE(suspicions(section).empty());
  section.notes.records.front().defects.front().count = 600;
  EXPECT_EQ(suspicions(section).size(), 1U);
}

TEST(Suspicions, NameARecordThatTheFitMisses) {
  CampaignSection section = fitted();
  for (const auto& [name, rms] : {std::pair{"a", 0.02}, {"b", 0.03}, {"c", 0.025}, {"d", 1.2}}) {
    identification::GreyBoxResidual residual;
    residual.record = name;
    residual.rms = rms;
    section.grey_box->residuals.push_back(residual);
  }
  const auto found = suspicions(section);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].finding, "not explained");
  EXPECT_THAT(found[0].records, ElementsAre("d"));
  // A slosh test rings with lines that the fit does not have.
  RecordNotes slosh;
  slosh.name = "d";
  slosh.test = identification::TestKind::slosh;
  section.notes.records = {slosh};
  EXPECT_TRUE(suspicions(section).empty());
}

TEST(Suspicions, NameAllPressuresWhereTheirCommonGainIsContradicted) {
  CampaignSection section = fitted();
  section.grey_box->conflict.widening = 16.0;
  RecordNotes notes;
  notes.name = "a";
  for (const char* motor : {"1", "2"}) {
    notes.sources.push_back(
        {std::string("inlet pressure ") + motor, std::string("in_") + motor, "Pa", false, ""});
    notes.sources.push_back(
        {std::string("outlet pressure ") + motor, std::string("out_") + motor, "Pa", false, ""});
  }
  section.notes.records = {notes};
  identification::StatedNumberCheck supply;
  supply.name = "supply pressure as torque";
  supply.moves_inertia = true;
  supply.departure = 4.0;
  section.grey_box->stated_numbers = {supply};
  const auto found = suspicions(section);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].channels, ElementsAre("in_1", "out_1", "in_2", "out_2"));
  EXPECT_THAT(found[0].stated_numbers, ElementsAre("supply pressure as torque"));
}

TEST(Suspicions, NameTheChannelWhoseScaleTheRecordsContradict) {
  CampaignSection section = fitted();
  section.grey_box->conflict.widening = 9.0;
  section.grey_box->records = {"a", "b"};
  RecordNotes notes;
  notes.name = "a";
  notes.sources.push_back({"tachometer", "tach_volts", "V", false, ""});
  section.notes.records = {notes};
  identification::StatedNumberCheck scale, inertia;
  scale.name = "tachometer scale";
  scale.by_others = normal_interval(1.2, 0.003);
  scale.departure = 60.0;
  scale.moves_inertia = true;
  inertia.name = "motor inertia";
  inertia.by_others = normal_interval(0.8, 0.01);
  inertia.departure = -59.8;
  inertia.moves_inertia = true;
  section.grey_box->stated_numbers = {inertia, scale};
  const auto found = suspicions(section);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].finding, "contradicts the case");
  EXPECT_THAT(found[0].channels, ElementsAre("tach_volts"));
  EXPECT_THAT(found[0].records, ElementsAre("a", "b"));
  EXPECT_THAT(found[0].stated_numbers, ElementsAre("tachometer scale", "motor inertia"));
  // Where none of those that move the inertia departs, the one that departs most.
  section.grey_box->stated_numbers[0].departure = 1.0;
  section.grey_box->stated_numbers[1].departure = -2.0;
  EXPECT_THAT(suspicions(section)[0].stated_numbers, ElementsAre("tachometer scale"));
}

TEST(WeakestCheck, IsTheOneWhoseErrorsChangeTheInertiaMostUnseen) {
  CampaignSection section = fitted();
  EXPECT_EQ(weakest_check(section), nullptr);
  for (const auto& [name, visible, effect] : {std::tuple{"tachometer scale", 0.05, -0.8},
                                              {"antenna inertia", 0.4, 0.01},
                                              {"displacement", 0.03, 1.0}}) {
    identification::StatedNumberCheck one;
    one.name = name;
    one.visible_error = visible;
    one.inertia_effect = effect;
    section.grey_box->stated_numbers.push_back(one);
  }
  ASSERT_NE(weakest_check(section), nullptr);
  EXPECT_EQ(weakest_check(section)->name, "tachometer scale");
  section.grey_box->conflict.widening = 4.0;
  EXPECT_EQ(weakest_check(section), nullptr);
}

}  // namespace
}  // namespace boresight::io
