#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/one_record.hpp"
#include "refused_call.hpp"
#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/campaign/identified_case.hpp>

namespace boresight::io {
namespace {

using identification::GreyBoxQuantity;
using numerics::normal_interval;
using testing::HasSubstr;

/// A section whose grey box has found these.
CampaignSection section_of(const std::vector<GreyBoxQuantity>& quantities) {
  CampaignSection section;
  section.grey_box.emplace();
  section.grey_box->quantities = quantities;
  return section;
}

GreyBoxQuantity learnt(const std::string& name, double posterior, double fraction) {
  GreyBoxQuantity quantity;
  quantity.name = name;
  quantity.prior = normal_interval(1.0, 0.1);
  quantity.posterior = normal_interval(posterior, 0.05);
  quantity.learnt = fraction;
  quantity.identified = fraction >= 0.5;
  quantity.prior_from_drawings = true;
  return quantity;
}

std::string first_of(const std::vector<std::string>& sentences) {
  return sentences.empty() ? "" : sentences.front();
}

TEST(Verdict, SaysDrawingsOnlyWhereTheyAgree) {
  const CampaignSection section = section_of({});
  EXPECT_EQ(verdict(section, learnt("inertia", 1.2, 0.3)), "drawings");
  EXPECT_EQ(verdict(section, learnt("inertia", 1.3, 0.3)), "contradicts drawings");
  EXPECT_EQ(verdict(section, learnt("inertia", 1.3, 0.9)), "identified");
  EXPECT_EQ(verdict(section, learnt("bulk modulus", 0.8, 0.3)), "slosh");
  EXPECT_EQ(verdict(section, learnt("bulk modulus", 0.7, 0.3)), "contradicts slosh");
  CampaignSection stated = section;
  stated.bulk_modulus_stated = true;
  EXPECT_EQ(verdict(stated, learnt("bulk modulus", 0.7, 0.3)), "contradicts drawings");
  GreyBoxQuantity guess = learnt("leakage rate", 1.0, 0.1);
  guess.prior_from_drawings = false;
  EXPECT_EQ(verdict(section, guess), "not identifiable");
  EXPECT_THAT(first_of(not_identifiable(section_of({learnt("bulk modulus", 0.7, 0.3)}))),
              HasSubstr("contradicts what the slosh test gives"));
}

TEST(Verdict, OfAContradictionComesFirstAndForAll) {
  CampaignSection section = section_of({learnt("inertia", 1.0, 0.9)});
  auto& conflict = section.grey_box->conflict;
  conflict = {400.0, 14, 36.1, "motor inertia", 15.0, {}, 28.0};
  EXPECT_EQ(verdict(section, section.grey_box->quantities[0]), "contradicts the case");
  section.contradiction = contradiction_with_case(*section.grey_box);
  EXPECT_THAT(first_of(not_identifiable(section)),
              HasSubstr("the motor inertia is 15.0 uncertainties off"));
  EXPECT_THAT(section.contradiction, HasSubstr("widened 5.3 times"));
  // The valve's scale alone: said, and nothing else is doubted.
  conflict.widening = 1.0;
  EXPECT_EQ(verdict(section, section.grey_box->quantities[0]), "identified");
  EXPECT_THAT(contradiction_with_case(*section.grey_box), testing::Not(HasSubstr("widened")));
  conflict.sum = 20.0;
  EXPECT_EQ(contradiction_with_case(*section.grey_box), "");
}

TEST(Verdict, NamesTheStatedNumbersThatAllElseContradicts) {
  CampaignSection section = section_of({learnt("inertia", 1.0, 0.9)});
  identification::StatedNumberCheck supply;
  supply.name = "supply pressure as torque";
  supply.departure = -4.0;
  supply.by_others = numerics::normal_interval(0.93, 0.01);
  section.grey_box->conflict.contradicted = {supply};
  EXPECT_THAT(
      contradiction_with_case(*section.grey_box),
      HasSubstr("one stated number (supply pressure as torque: 0.93 times the stated value, "
                "4.0 standard uncertainties)"));
  section.grey_box->conflict.contradicted.push_back(supply);
  EXPECT_THAT(contradiction_with_case(*section.grey_box), HasSubstr("one of these stated numbers"));
  section.grey_box->conflict.contradicted.clear();
  EXPECT_EQ(contradiction_with_case(*section.grey_box), "");
}

TEST(Verdict, SaysWhyMotionCannotTellFrictionFromOffset) {
  GreyBoxQuantity offset = learnt("offset torque as recorded", 1.0, 0.9);
  offset.identified = offset.prior_from_drawings = false;
  GreyBoxQuantity level = offset;
  level.name = "Coulomb level";
  CampaignSection section = section_of({offset, level});
  section.grey_box->posterior.one_way = 5.0;
  EXPECT_THAT(first_of(not_identifiable(section)), HasSubstr("the drive moves one way only"));
  section.grey_box->posterior.one_way = 0.0;
  section.grey_box->posterior.unsaturated = 1.0;
  section.grey_box->motion.highest_rate = 3.25;
  EXPECT_THAT(not_identifiable(section).at(1), HasSubstr("at 3.25 rad/s at most"));
}

CampaignSection section_of_methods(double resonance) {
  CampaignSection section;
  section.knowledge.motor_count = 2.0;
  section.knowledge.motor_inertia = {0.5, 0.01};
  section.knowledge.gear_inertia = {0.1, 0.01};
  section.knowledge.antenna_inertia = {0.7, 0.03};
  section.resonance.emplace();
  section.resonance->best.emplace();
  section.resonance->best->inertia = normal_interval(resonance, 0.03);
  return section;
}

TEST(AverageMethods, GivesNoMeanOfMethodsThatContradictOneAnother) {
  CampaignSection agree = section_of_methods(1.85);
  average_methods(agree);
  ASSERT_TRUE(agree.mean_of_methods);
  EXPECT_GT(agree.mean_of_methods->value, 1.8);
  EXPECT_EQ(agree.contradiction, "");
  CampaignSection apart = section_of_methods(2.4);
  average_methods(apart);
  EXPECT_FALSE(apart.mean_of_methods);
  EXPECT_THAT(apart.contradiction, HasSubstr("mass properties 1.8, resonance 2.4 kg m2"));
  EXPECT_THAT(first_of(not_identifiable(apart)), HasSubstr("The methods contradict one another"));
}

TEST(WithIdentified, RefusesADriveThatItsOwnCaseContradicts) {
  identification::DriveEstimate estimate;
  estimate.contradicted = true;
  EXPECT_THAT(reference::Call([&] { with_identified(case_of("small-dish"), estimate); }),
              testing::ThrowsMessage<NumericalFailure>(HasSubstr("no drive to design for")));
}

}  // namespace
}  // namespace boresight::io
