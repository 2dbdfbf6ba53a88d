// The measured hydraulic frequency against that of the flexible antenna.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/oil_case.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/redesign/interpretations.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::app {
namespace {

using io::with_oil;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

Report report_of(const io::Case& antenna) {
  Report report;
  report.command = "redesign";
  report.identification = identify(antenna, {});
  report.resonance = resonance_verdict(antenna);
  return report;
}

TEST(ResonanceVerdict, SaysWhatContradictsAndWhichOilWouldNot) {
  const auto verdict = resonance_verdict(with_oil(1.229e9));
  ASSERT_TRUE(verdict);
  EXPECT_TRUE(verdict->contradicts());
  EXPECT_EQ(resonance_sentence(*verdict),
            fmt::format("The measured hydraulic frequency, 0.97 Hz, contradicts the {:.3g} Hz of "
                        "the case's flexible antenna (more than 5 standard uncertainties apart): "
                        "raising the bulk modulus from 1.23 to {:.3g} GPa would reconcile the two.",
                        verdict->expected, *verdict->bulk_modulus / 1e9));
  const auto agreeing = resonance_verdict(with_oil(*verdict->bulk_modulus));
  ASSERT_TRUE(agreeing);
  EXPECT_LT(agreeing->deviation(), 0.01);
  EXPECT_THAT(resonance_sentence(*agreeing), HasSubstr("does not contradict"));
  const auto stiff = resonance_verdict(with_oil(1.229e9, "20 Hz"));
  ASSERT_TRUE(stiff);
  EXPECT_THAT(
      resonance_sentence(*stiff),
      EndsWith("no bulk modulus within a factor of 30 of the case's 1.23 GPa reconciles the two."));
}

TEST(ResonanceVerdict, StandsFirstAmongConclusionsAndInTheDecision) {
  Report report = report_of(with_oil(1.229e9));
  EXPECT_THAT(
      conclude(report).front(),
      AllOf(StartsWith("The measured hydraulic frequency, 0.97 Hz, contradicts"),
            HasSubstr("If the antenna were rigid, 0.97 Hz would imply an antenna inertia of -0.0"),
            EndsWith("the masses and the reading of the resonance.")));
  EXPECT_THAT(decision(report).front(), StartsWith("The measured hydraulic frequency"));
  report.resonance = resonance_verdict(with_oil(*report.resonance->bulk_modulus));
  EXPECT_THAT(conclude(report).front(), Not(HasSubstr("Check the oil stiffness")));
  EXPECT_THAT(decision(report), Each(Not(HasSubstr("The measured hydraulic frequency"))));
}

TEST(ResonanceVerdict, WarnsWhereNoPlantHasTheOilThatWasMeasured) {
  io::ResonanceVerdict verdict{.measured = 1.05,
                               .expected = 1.73,
                               .standard_uncertainty = 0.1,
                               .stated_bulk_modulus = 1.24e9,
                               .bulk_modulus = 0.361e9,
                               .min_oil = 0.654,
                               .max_oil = 1.346};
  const auto none = EndsWith(
      " The uncertainty set has 0.654 to 1.35 times the case's oil stiffness, and that would be "
      "0.291 times: no member represents the measured antenna.");
  EXPECT_THAT(resonance_warning(verdict), AllOf(StartsWith(resonance_sentence(verdict)), none));
  // First among what `tune`, `evaluate` and `match` conclude, and below their decision.
  Report report;
  report.command = "tune";
  report.resonance = verdict;
  report.conclusions = {"Tuned."};
  lead_with_resonance(report);
  EXPECT_THAT(report.conclusions, ElementsAre(none, "Tuned."));
  EXPECT_THAT(reservations(report), ElementsAre(none));
  verdict.min_oil = 0.293;  // within rounding of what is wanted
  EXPECT_EQ(resonance_warning(verdict), resonance_sentence(verdict));
  verdict.expected = 1.1;
  EXPECT_EQ(resonance_warning(verdict), "");
  report.resonance = verdict;
  lead_with_resonance(report);
  EXPECT_EQ(report.conclusions.size(), 2U);
  EXPECT_THAT(reservations(report), IsEmpty());
  const auto read = resonance_verdict(with_oil(1.229e9));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->min_oil, member_ranges(with_oil(1.229e9)).oil_stiffness.lower);
}

TEST(ResonanceVerdict, SaysThatTheMethodsFigureIsOfARigidAntenna) {
  Report report = report_of(with_oil(1.229e9));
  EXPECT_THAT(conclude(report), Each(Not(HasSubstr("assumes a rigid antenna"))));
  report.resonance = resonance_verdict(with_oil(*report.resonance->bulk_modulus));
  EXPECT_THAT(conclude(report),
              Contains(AllOf(StartsWith("The methods put the reflected inertia between"),
                             HasSubstr("; the resonance method assumes a rigid antenna, and the "
                                       "flexible one does not contradict the masses."))));
  // Neither end of the range is the resonance's.
  std::erase_if(report.identification->inertia.methods, [](const auto& method) {
    return method.kind == identification::MethodKind::resonance;
  });
  EXPECT_THAT(conclude(report), Each(Not(HasSubstr("assumes a rigid antenna"))));
}

// A gear spring far softer than the oil.
TEST(ResonanceVerdict, SaysWhereItsModeTellsLittleOfTheOil) {
  io::Case antenna = with_oil(1.229e9);
  EXPECT_EQ(which_was_measured(resonance_verdict(antenna).value()), "");
  antenna.structure->locked_rotor_frequency.value = 0.2;
  const auto verdict = resonance_verdict(antenna);
  ASSERT_TRUE(verdict);
  EXPECT_LT(verdict->mode.oil_fraction, 0.1);
  EXPECT_GT(verdict->oil_mode.oil_fraction, 0.9);
  EXPECT_THAT(resonance_sentence(*verdict),
              EndsWith(fmt::format(
                  "Only {:.0f} % of that mode's elastic energy is in the oil, {:.0f} % in the "
                  "gearbox spring and the rest in the structure. The dominant hydraulic mode is at "
                  "{:.3g} Hz, damping ratio {:.3g}, with {:.0f} % in the oil. Check which of them "
                  "was measured and state it in resonance.mode.",
                  100.0 * verdict->mode.oil_fraction, 100.0 * verdict->mode.gear_fraction,
                  verdict->oil_mode.frequency, verdict->oil_mode.damping_ratio,
                  100.0 * verdict->oil_mode.oil_fraction)));
  // Where the case says so it is compared with that mode, and with the oil that makes it.
  antenna.resonance->of_oil = true;
  const auto of_oil = resonance_verdict(antenna);
  ASSERT_TRUE(of_oil);
  EXPECT_EQ(of_oil->expected, verdict->oil_mode.frequency);
  EXPECT_THAT(
      resonance_sentence(*of_oil),
      AllOf(HasSubstr("Hz of the case's flexible antenna, in its dominant hydraulic mode ("),
            Not(HasSubstr("Check which"))));
  ASSERT_TRUE(of_oil->bulk_modulus);
  io::Case other = with_oil(*of_oil->bulk_modulus);
  other.structure->locked_rotor_frequency.value = 0.2;
  other.resonance->of_oil = true;
  EXPECT_NEAR(resonance_verdict(other)->expected, 0.97, 1e-5);
  antenna.resonance->of_oil = false;
  EXPECT_THAT(to_text(document_of(describe_plant(antenna))),
              HasSubstr("of that mode's elastic energy"));
  // Motors and gear train alone on the oil spring.
  const auto drive = make_plant(antenna).drive;
  EXPECT_NEAR(verdict->oil_mode.frequency,
              plant::hydraulic_frequency(drive.oil_stiffness, drive.motor_inertia),
              0.05 * verdict->oil_mode.frequency);
}

TEST(RingsAsRigid, NeedsTheOilInTheMode) {
  io::Case antenna = with_oil(1.229e9);
  EXPECT_TRUE(rings_as_rigid(antenna));
  antenna.resonance->of_oil = true;  // the same mode
  EXPECT_TRUE(rings_as_rigid(antenna));
  const auto of_resonance = [](const io::Case& one) {
    return std::ranges::count(identify(one, {}).inertia.methods,
                              identification::MethodKind::resonance,
                              &identification::InertiaMethod::kind);
  };
  EXPECT_EQ(of_resonance(antenna), 1);
  antenna.structure->locked_rotor_frequency.value = 0.2;
  for (const bool of_oil : {true, false}) {
    antenna.resonance->of_oil = of_oil;
    EXPECT_FALSE(rings_as_rigid(antenna));
    EXPECT_EQ(of_resonance(antenna), 0);
    for (const auto& choice : plant_interpretations(antenna)) {
      EXPECT_THAT(choice.result.says, Not(HasSubstr("rigid masses")));
    }
  }
}

TEST(RingsAsRigid, IsToldWhereNoInertiaIsReadOffTheResonance) {
  Report report = report_of(with_oil(1.229e9));
  const auto unread = HasSubstr("The measured 0.97 Hz give no inertia");
  EXPECT_THAT(conclude(report), Each(Not(unread)));
  io::Case soft = with_oil(1.229e9);
  soft.structure->locked_rotor_frequency.value = 0.2;
  report = report_of(soft);
  EXPECT_THAT(conclude(report), Contains(unread));
  EXPECT_EQ(unread_resonance({}), "");
}

TEST(ResonatingMode, IsSaidByTheCase) {
  const auto with_mode = [](const std::string& mode) {
    return EditedCase().replace("[resonance]\n", "[resonance]\nmode = \"" + mode + "\"\n").text();
  };
  EXPECT_TRUE(io::parse_case(with_mode("oil"), "case.toml").resonance->of_oil);
  EXPECT_FALSE(io::parse_case(with_mode("lowest"), "case.toml").resonance->of_oil);
  EXPECT_THAT(refusal_of(with_mode("second")), HasSubstr("resonance.mode: expected one of"));
}

// Of 3 so many that both sides of the limit read "3" say nothing.
TEST(ResonanceVerdict, TellsDeviationsAtTheLimitApart) {
  const io::ResonanceVerdict below{.measured = 2.97, .expected = 0.0, .standard_uncertainty = 1.0};
  const io::ResonanceVerdict above{.measured = 3.02, .expected = 0.0, .standard_uncertainty = 1.0};
  EXPECT_THAT(resonance_sentence(below), HasSubstr("(2.97 standard uncertainties apart)"));
  EXPECT_THAT(resonance_sentence(above), HasSubstr("(3.02 standard uncertainties apart)"));
}

}  // namespace
}  // namespace boresight::app
