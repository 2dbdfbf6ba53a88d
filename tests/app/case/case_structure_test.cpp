// Structures that are stated by their frequencies with the motors held or by the stiffness of the
// gear train, and what an audit says.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/audit/audit_report.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/interpretations.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

io::Case parsed(const EditedCase& edited) {
  return io::parse_case(edited.text(), "case.toml");
}

EditedCase with_motors_held() {
  EditedCase edited;
  edited.replace("\ngear_damping_ratio =",
                 "\nmode_frequencies = \"motors_held\"\ngear_damping_ratio =");
  return edited;
}

// The 70-m antenna by the frequencies that it has with its motors held.
EditedCase restated() {
  const auto own =
      plant::motors_held_modes(make_plant(io::read_case(case_path("dss14-70m"))).structure);
  EditedCase edited = with_motors_held();
  std::size_t mode = 0;
  for (const std::string held : {"2.4 Hz", "3.4 Hz", "4.6 Hz", "6.2 Hz"}) {
    edited.replace("\nfrequency = { value = \"" + held,
                   fmt::format("\nfrequency = {{ value = \"{:.17g} Hz", own.at(++mode).frequency));
  }
  return edited;
}

// An antenna of one mode with a fraction of its inertia.
EditedCase of_one_mode(const std::string& frequency, const std::string& fraction) {
  EditedCase edited = with_motors_held();
  const std::string text = edited.text();
  const std::size_t first = text.find("[[structure.mode]]");
  const std::size_t end = text.find("\n# What a simulated test needs");
  edited.replace(text.substr(first, end - first),
                 "[[structure.mode]]\nfrequency = \"" + frequency +
                     "\"\ndamping_ratio = \"0.01\"\ninertia_fraction = \"" + fraction +
                     "\"\nwind_fraction = \"1\"\nbeam_weight = \"0.95\"\n");
  return edited;
}

// The same at 1.9 Hz and 3.4 Hz, by the fraction that a model with the motors braked gives.
EditedCase of_effective_fraction(const std::string& fraction) {
  return of_one_mode("3.4 Hz", "0.25")
      .replace("locked_rotor_frequency = { value = \"2.0 Hz\"",
               "locked_rotor_frequency = { value = \"1.9 Hz\"")
      .replace("inertia_fraction = \"0.25\"", "effective_fraction = \"" + fraction + "\"");
}

Implausibility found_in(const io::Case& antenna, const std::string& check) {
  for (const auto& one : audit_report(antenna).implausible) {
    if (one.check == check) return one;
  }
  return {};
}

TEST(MotorsHeldCase, IsTheAntennaThatHasTheseFrequencies) {
  const auto expected = make_plant(io::read_case(case_path("dss14-70m"))).structure;
  const io::Case antenna = parsed(restated());
  const auto found = make_plant(antenna).structure;
  EXPECT_NEAR(found.gear_stiffness / expected.gear_stiffness, 1.0, 1e-9);
  ASSERT_THAT(found.modes, SizeIs(4));
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    EXPECT_NEAR(found.modes[i].stiffness / expected.modes[i].stiffness, 1.0, 1e-9);
    EXPECT_NEAR(found.modes[i].damping / expected.modes[i].damping, 1.0, 1e-9);
  }
  EXPECT_THAT(found_in(antenna, "motors held").reasoning, IsEmpty());
}

// So that what the rms depends on moves what was measured.
TEST(MotorsHeldCase, MovesWithAStatedFrequency) {
  io::Case antenna = parsed(restated());
  auto expected = plant::motors_held_modes(make_plant(antenna).structure);
  antenna.structure->modes[1].frequency.value *= 1.01;
  expected[2].frequency *= 1.01;
  const auto moved = plant::motors_held_modes(make_plant(antenna).structure);
  const auto scaled = plant::motors_held_modes(
      make_plant(antenna, {plant::scaled_by("structure.frequencies", 0.9)}).structure);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_NEAR(moved[i].frequency / expected[i].frequency, 1.0, 1e-9);
    EXPECT_NEAR(scaled[i].frequency / moved[i].frequency, 0.9, 1e-9);
  }
}

TEST(MotorsHeldCase, IsRefusedWhereThereIsNoSuchAntenna) {
  EXPECT_THAT(refusal_of(with_motors_held().text()),
              HasSubstr("structure.mode_frequencies: expected inertia fractions of which an "
                        "antenna has these frequencies with the motors held, found none"));
  EXPECT_THAT(refusal_of(of_one_mode("4.2 Hz", "0.5").text()),
              HasSubstr("the mode of 4.2 Hz would need an inertia_fraction of some 0.38"));
  EXPECT_THAT(refusal_of(with_motors_held().replace("\"3.4 Hz\"", "\"2.3 Hz\"").text()),
              HasSubstr("expected frequencies with the motors held that rise from "
                        "locked_rotor_frequency, found '2.3 Hz' behind '2.4 Hz'"));
  EXPECT_THAT(refusal_of(EditedCase()
                             .replace("\ngear_damping_ratio =",
                                      "\nmode_frequencies = \"locked\"\ngear_damping_ratio =")
                             .text()),
              HasSubstr("structure.mode_frequencies"));
}

TEST(MotorsHeldCase, NamesTheOtherAntennaOfTheSameFrequencies) {
  const io::Case antenna = parsed(of_one_mode("4 Hz", "0.2"));
  // x^2 (1 + r) - (s0 + s1) x + s0 s1 = 0 with r = 1/4: 3.403 and 2.103 Hz. With the motors held
  // the lowest mode has (s1 - K_g/J)/(s1 - s0) of the inertia, with K_g/J = 0.8 s0 s1/x.
  const auto found = found_in(antenna, "motors held");
  EXPECT_THAT(found.reasoning,
              AllOf(HasSubstr("2 antennas with these inertia fractions"), HasSubstr("softest"),
                    HasSubstr("bull-gear-locked modes at 3.403 Hz, whose motors-locked modes have "
                              "inertia fractions 0.965, 0.035"),
                    HasSubstr("with 2.103 Hz, whose motors-locked modes have inertia fractions "
                              "0.369, 0.631. To select one, state effective_fraction")))
      << found.reasoning;
  ASSERT_THAT(found.numbers, SizeIs(2));
  EXPECT_NEAR(found.numbers[0].value, make_plant(antenna).structure.gear_stiffness,
              1e-6 * found.numbers[0].value);
  EXPECT_LT(found.numbers[0].value, found.numbers[1].value);
}

TEST(MotorsHeldCase, LetsTheOtherAntennaBeAChoiceOfTheRedesign) {
  const io::Case antenna = parsed(of_one_mode("4 Hz", "0.2"));
  const auto held = plant::motors_held_modes(make_plant(antenna).structure);
  const auto interpretations = plant_interpretations(antenna);
  const auto other = std::ranges::find_if(interpretations, [](const PlantInterpretation& choice) {
    return choice.result.name.starts_with("antenna of gear spring ");
  });
  ASSERT_NE(other, interpretations.end());
  const auto structure = linear_plant(other->antenna.value()).structure;
  EXPECT_GT(structure.gear_stiffness, 1.5 * make_plant(antenna).structure.gear_stiffness);
  EXPECT_EQ(other->result.name,
            fmt::format("antenna of gear spring {:.3g} N.m/rad", structure.gear_stiffness));
  EXPECT_FALSE(other->result.contradicts);
  const auto again = plant::motors_held_modes(structure);
  for (std::size_t i = 0; i < held.size(); ++i) {
    EXPECT_NEAR(again[i].frequency / held[i].frequency, 1.0, 1e-9);
  }
}

TEST(EffectiveFractionCase, IsTheOneAntenna) {
  const io::Case antenna = parsed(of_effective_fraction("0.25"));
  const auto& mode = antenna.structure->modes.at(0);
  // The bull gear has (sum e f^2)^2/sum e f^4.
  const double lowest = 0.75 * 1.9 * 1.9, second = 0.25 * 3.4 * 3.4;
  const double bull_gear =
      (lowest + second) * (lowest + second) / (lowest * 1.9 * 1.9 + second * 3.4 * 3.4);
  EXPECT_NEAR(mode.inertia_fraction.value, 1.0 - bull_gear, 1e-12);
  EXPECT_EQ(mode.inertia_fraction.text, "0.2744");
  EXPECT_THAT(mode.inertia_fraction.key, IsEmpty());
  EXPECT_EQ(mode.effective_fraction.value().key, "structure.mode[0].effective_fraction");
  EXPECT_EQ(mode.frequency.value, 3.4);
  const auto antennas = io::structure_specifications(*antenna.structure);
  ASSERT_THAT(antennas, SizeIs(1));
  EXPECT_NEAR(antennas[0].modes.at(0).frequency, 2.326, 5e-4);
  EXPECT_NEAR(antennas[0].modes.at(0).inertia_fraction, mode.inertia_fraction.value, 1e-15);
  EXPECT_EQ(antennas[0].modes.at(0).wind_fraction, 1.0);
  EXPECT_EQ(antennas[0].modes.at(0).beam_weight, 0.95);
  const auto held = plant::motors_held_modes(make_plant(antenna).structure);
  EXPECT_NEAR(held.at(0).frequency, 1.9, 1e-9);
  EXPECT_NEAR(held.at(1).frequency, 3.4, 1e-9);
  EXPECT_NEAR(held.at(1).inertia_fraction, 0.25, 1e-9);
  EXPECT_THAT(found_in(antenna, "motors held").reasoning, IsEmpty());
  EXPECT_THAT(to_text(document_of(describe_plant(antenna))),
              AllOf(ContainsRegex("bull gear +- +0\\.7256"),
                    ContainsRegex("structure\\.mode\\[0\\] +2\\.3258 +0\\.2744")));
}

TEST(EffectiveFractionCase, IsTheAntennaThatHasThem) {
  const io::Case stated = io::read_case(case_path("dss14-70m"));
  const auto expected = make_plant(stated).structure;
  const auto own = plant::motors_held_modes(expected);
  EditedCase edited = restated();
  std::size_t mode = 0;
  for (const std::string held : {"0.62", "0.14", "0.07", "0.04"}) {
    edited.replace("\ninertia_fraction = { value = \"" + held,
                   fmt::format("\neffective_fraction = {{ value = \"{:.17g}",
                               own.at(++mode).inertia_fraction));
  }
  const io::Case antenna = parsed(edited);
  const auto found = make_plant(antenna).structure;
  EXPECT_NEAR(found.gear_stiffness / expected.gear_stiffness, 1.0, 1e-9);
  ASSERT_THAT(found.modes, SizeIs(4));
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    EXPECT_NEAR(found.modes[i].stiffness / expected.modes[i].stiffness, 1.0, 1e-9);
    EXPECT_NEAR(found.modes[i].inertia / expected.modes[i].inertia, 1.0, 1e-9);
    EXPECT_NEAR(antenna.structure->modes[i].inertia_fraction.value,
                stated.structure->modes[i].inertia_fraction.value, 1e-9);
  }
}

TEST(EffectiveFractionCase, MovesWithAStatedNumber) {
  io::Case antenna = parsed(of_effective_fraction("0.25"));
  antenna.structure->modes[0].effective_fraction.value().value = 0.3;
  antenna.structure->locked_rotor_frequency.value = 1.8;
  const auto held = plant::motors_held_modes(make_plant(antenna).structure);
  EXPECT_NEAR(held.at(0).frequency, 1.8, 1e-9);
  EXPECT_NEAR(held.at(0).inertia_fraction, 0.7, 1e-9);
  EXPECT_NEAR(held.at(1).frequency, 3.4, 1e-9);
}

TEST(EffectiveFractionCase, IsRefusedWhereFractionsAreNoneOrOthers) {
  const std::string second = "\ninertia_fraction = { value = \"0.14\"";
  const std::string effective = "\neffective_fraction = { value = \"0.14\"";
  const auto refused = [](const EditedCase& edited, const std::string& words) {
    EXPECT_THAT(refusal_of(edited.text()), HasSubstr(words));
  };
  const auto one = [] { return of_effective_fraction("0.25"); };
  const std::string line = "effective_fraction = \"0.25\"\n";
  refused(one().replace(line, line + "inertia_fraction = \"0.2744\"\n"),
          "structure.mode[0].effective_fraction: expected either inertia_fraction or, of a mode "
          "with the motors held, effective_fraction, found both");
  refused(one().replace(line, ""), "structure.mode[0].inertia_fraction: expected either");
  refused(one().replace(line, ""), "found neither");
  refused(with_motors_held().replace(second, effective),
          "structure.mode[1].effective_fraction: expected inertia_fraction as of the modes before "
          "it, found effective_fraction");
  refused(EditedCase().replace(second, effective),
          "structure.mode[1].effective_fraction: expected mode_frequencies = \"motors_held\" in "
          "[structure] with it");
  refused(of_effective_fraction("1"),
          "structure.mode: expected effective_fraction to sum to less than 1 (the rest belongs to "
          "the lowest mode with the motors held), found 1");
  refused(of_effective_fraction("0"), "structure.mode[0].effective_fraction: expected");
}

TEST(StructuralPredictions, AreComparedWithThePlant) {
  const auto predicting = [](const std::string& second) {
    const std::string axis = "lowest_predicted_axis = \"azimuth\"";
    return parsed(
        EditedCase().replace(axis, axis +
                                       "\n[[structure.prediction]]\nfrequency = \"2.05 Hz\"\n"
                                       "[[structure.prediction]]\nfrequency = \"" +
                                       second + "\"\n"));
  };
  EXPECT_THAT(found_in(predicting("3.3 Hz"), "structural predictions").reasoning, IsEmpty());
  const auto found = found_in(predicting("4 Hz"), "structural predictions");
  EXPECT_THAT(found.reasoning, AllOf(HasSubstr("3.226 Hz for '4 Hz' (-19 %)"),
                                     HasSubstr("structure.mode_frequencies")))
      << found.reasoning;
  EXPECT_THAT(found.numbers, SizeIs(2));
}

double spring_at_axis(const io::Case& antenna) {
  return make_plant(antenna).structure.gear_stiffness * std::pow(io::gear_ratio(antenna), 2);
}

// The 70-m antenna by its gear train's stiffness instead of the locked-rotor frequency.
EditedCase by_gear_stiffness(const std::string& stiffness) {
  return EditedCase().replace_line(
      "locked_rotor_frequency",
      "gear_stiffness = { value = \"" + stiffness +
          "\", uncertainty = \"10 %\", basis = \"assumed\", source = \"drawing\" }");
}

TEST(GearStiffnessCase, HasTheLockedRotorFrequencyThatMakesIt) {
  const double own = spring_at_axis(io::read_case(case_path("dss14-70m")));
  for (const double factor : {0.1, 1.0, 5.0}) {
    const io::Case antenna =
        parsed(by_gear_stiffness(fmt::format("{:.17g} N.m/rad", factor * own)));
    EXPECT_NEAR(spring_at_axis(antenna) / (factor * own), 1.0, 1e-9);
    const io::Quantity& frequency = antenna.structure->locked_rotor_frequency;
    EXPECT_LT(frequency.value, antenna.structure->modes.at(0).frequency.value);
    EXPECT_EQ(std::abs(frequency.value - 2.0) < 1e-9, factor == 1.0);
    EXPECT_EQ(frequency.kind, io::Kind::frequency);
    EXPECT_EQ(frequency.key, "structure.gear_stiffness");
    EXPECT_EQ(frequency.source, "drawing");
    // A rigid antenna has half the stiffness' 10 %; modes close above leave less.
    EXPECT_GT(io::relative_uncertainty(frequency), 0.0);
    EXPECT_LT(io::relative_uncertainty(frequency), 0.05);
    const auto assumed = assumed_inputs(antenna);
    EXPECT_THAT(assumed, Contains(Field(&io::Quantity::key, "structure.gear_stiffness")));
    EXPECT_THAT(assumed,
                Not(Contains(Field(&io::Quantity::key, "structure.locked_rotor_frequency"))));
    EXPECT_THAT(found_in(antenna, "gear stiffness").reasoning, IsEmpty());
  }
}

TEST(GearStiffnessCase, IsStatedInAnyUnitOfItsKind) {
  const io::Case antenna = parsed(by_gear_stiffness("1.2e11 lbf.ft/rad"));
  ASSERT_TRUE(antenna.structure->gear_stiffness.has_value());
  EXPECT_NEAR(spring_at_axis(antenna) / (1.2e11 * 0.3048 * 4.4482216152605), 1.0, 1e-9);
  EXPECT_THAT(refusal_of(by_gear_stiffness("1.2e11 lbf.ft").text()),
              HasSubstr("structure.gear_stiffness.value: expected a stiffness"));
}

TEST(GearStiffnessCase, OfARigidAntennaIsThatOfOneBody) {
  EditedCase edited = by_gear_stiffness("1e11 N.m/rad");
  const std::string text = edited.text();
  const std::size_t first = text.find("[[structure.mode]]");
  edited.replace(text.substr(first, text.find("\n# What a simulated test needs") - first), "");
  edited.replace_line("bull_gear_wind_fraction", "bull_gear_wind_fraction = \"1\"");
  edited.replace_line("bull_gear_beam_weight", "bull_gear_beam_weight = \"1\"");
  const io::Case antenna = parsed(edited);
  ASSERT_THAT(antenna.structure->modes, IsEmpty());
  EXPECT_NEAR(antenna.structure->locked_rotor_frequency.value,
              std::sqrt(1e11 / antenna.antenna->inertia.value) / (2.0 * std::numbers::pi), 1e-9);
}

TEST(GearStiffnessCase, IsRefusedWhereItMakesNoFrequency) {
  const auto refused = [](const EditedCase& edited, const std::string& words) {
    EXPECT_THAT(refusal_of(edited.text()), HasSubstr(words));
  };
  refused(EditedCase().replace_line("locked_rotor_frequency", ""),
          "structure.locked_rotor_frequency: expected locked_rotor_frequency or gear_stiffness, "
          "found neither");
  refused(EditedCase().replace("\nlocked_rotor_frequency =", "\nlocked_rotor_frequancy ="),
          "did you mean 'locked_rotor_frequency'?");
  refused(by_gear_stiffness("0 N.m/rad"), "structure.gear_stiffness.value: expected");
  refused(by_gear_stiffness("1e40 N.m/rad"),
          "structure.gear_stiffness: expected a stiffness that leaves the locked-rotor frequency "
          "above 0 and below every mode, found one that takes it to 2.4 Hz ('1e40 N.m/rad')");
  refused(by_gear_stiffness("1e11 N.m/rad")
              .replace("\ngear_damping_ratio =",
                       "\nmode_frequencies = \"motors_held\"\ngear_damping_ratio ="),
          "structure.locked_rotor_frequency: expected it beside frequencies with the motors held, "
          "found gear_stiffness alone");
}

}  // namespace
}  // namespace boresight::app
