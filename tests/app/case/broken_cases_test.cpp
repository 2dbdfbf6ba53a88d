#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "app/program_run.hpp"
#include "io/edited_case.hpp"

namespace boresight::app {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// The 70-m case with one mistake, and what its message must say.
struct Mistake {
  std::string name;
  std::string old;
  std::string replacement;  // '^' marks the place to be blamed
  std::string key;          // empty for a syntax error
  std::string expected;
  std::string found;
  std::string blamed = {};  // the place by the first text like this, where it is not in the edit
};

void PrintTo(const Mistake& mistake, std::ostream* stream) {
  *stream << mistake.name;
}

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> list{
      // Keys.
      {"ReturnAboveSupply", "return_pressure = { value = \"60 psi\"",
       "return_pressure = ^{ value = \"3000 psi\"", "simulation.return_pressure",
       "a pressure below drive.supply_pressure", "one that is not"},
      {"BreakawayBelowCoulomb", "breakaway = { value = \"16.83 N.m\"",
       "breakaway = ^{ value = \"6.83 N.m\"", "friction_curve.breakaway",
       "at least the Coulomb torque", "less"},
      {"LeakageSharesBeyondOne", "case_leakage_share = { value = \"0.1\"",
       "case_leakage_share = ^{ value = \"0.95\"", "simulation.case_leakage_share",
       "leakage fractions that sum to at most 1", "more"},
      {"MissingKey", "[controller]\ndelay", "^[controller]\n# delay", "controller.delay",
       "a time (such as s, ms)", "nothing: key is missing"},
      {"LinesWithoutADensity", "[oil]\ndensity", "^[oil]\n# density", "oil.density",
       "a density of the oil for the pressure waves in its lines", "none"},
      {"MissingKeyForAMisspeltOne", "[motor]\ncount", "^[motor]\ncuont", "motor.count",
       "an integer", "nothing: key is missing (is 'cuont' misspelt?)"},
      {"MissingTableForAMisspeltOne", "[friction_curve]\n", "[^friction_curves]\n",
       "friction_curve", "a table", "nothing: key is missing (is 'friction_curves' misspelt?)"},
      {"MissingTable", "[controller]\ndelay", "[sensors.^more]\ndelay", "sensors.more",
       "one of the keys 'encoder_bits', 'encoder_noise'", "an unknown key"},
      {"UnknownKey", "[tachometer]\n", "[tachometer]\n^gain = \"1 V\"\n", "tachometer.gain",
       "one of the keys 'motor_teeth', 'recorder_limit'", "an unknown key"},
      {"UnknownKeyNearAKnownOne", "density = { value = \"7832", "^densty = { value = \"7832",
       "gear_train.densty", "one of the keys", "an unknown key (did you mean 'density'?)"},
      {"UnknownKeyOfAQuantity", "{ value = \"157 V\", basis", "{ value = \"157 V\", ^basics",
       "tachometer.voltage.basics", "one of the keys", "(did you mean 'basis'?)"},
      {"UnknownBasis", "basis = \"published\", source = \"Sommerville, title\"",
       "basis = ^\"publshed\", source = \"Sommerville, title\"", "antenna.dish_diameter.basis",
       "one of 'measured', 'published', 'inferred', 'assumed'",
       "'publshed' (did you mean 'published'?)"},
      {"DuplicateKey", "most_disks = 24\n", "most_disks = 24\nmost_disks = ^12\n", "", "valid TOML",
       "cannot redefine existing integer 'most_disks'"},
      {"NameTwice", "name = \"longest\"", "name = ^\"shortest\"", "oil.line[1].name",
       "a name of its own", "'shortest' again"},

      // Units.
      {"HertzForARateConstant", "\"1.219 1/s\"", "\"1.219 ^Hz\"", "drive.leakage_rate.value",
       "a rate constant (such as 1/s, 1/min)", "'1.219 Hz', a"},
      {"FlowForARateConstant", "\"1.219 1/s\"", "\"1.1 ^L/min\"", "drive.leakage_rate.value",
       "a rate constant (such as 1/s, 1/min)",
       "a flow (write 1/s, 1/min; leakage known as a flow is drive.leakage_flow with "
       "drive.leakage_pressure)"},
      {"RateConstantForHertz", "\"0.97 Hz\"", "\"0.97 ^1/s\"", "resonance.frequency.value",
       "a frequency (such as Hz, rad/s)", "write Hz or rad/s"},
      {"HyphenAndAmbiguousPound", "\"69.49 N.m\"", "\"51.25 lb^-ft\"",
       "friction_tests.constant_speed_coulomb.value", "a torque", "write lbf.ft"},
      {"TorqueForInertia", "\"0.012358 kg.m2\"", "\"0.012358 ^N.m\"", "motor.disk_inertia.value",
       "an inertia (such as kg.m2, lbf.ft.s2)", "'0.012358 N.m', a torque"},
      {"MassForForceInAnInertia", "also = \"0.22177 lbf.ft.s2\"", "also = \"0.22177 ^lbm.ft.s2\"",
       "motor.inertia.also", "an inertia", "write lbf for lbm"},
      {"AmbiguousGallon", "also = \"1498.1 in3\"", "also = \"6.485 ^gal\"", "oil.volume_1.also",
       "a volume", "write US_gal for 231 in3"},
      {"AmbiguousOunce", "\"14.12 N.m\"", "\"2000 ^oz.in\"", "friction_tests.slow_ramp_up.value",
       "a torque", "mass, force or volume? convert to lbm, lbf or in3"},
      {"MilesPerHour", "\"10 m/s\"", "\"22 ^mph\"", "wind.design_speed.value", "a speed",
       "write mile/h"},
      {"TwoDivisions", "\"0.9 N.m.s/rad\"", "\"0.9 N.m/rad^/s\"", "drive.viscous_friction.value",
       "a viscous friction", "a second division reads two ways"},

      // Types.
      {"NumberWithoutUnit", "frequency = { value = \"0.97 Hz\"", "frequency = { value = ^0.97",
       "resonance.frequency.value", "a frequency",
       "the number 0.97, which has no unit (write \"0.97 Hz\")"},
      {"DisplacementWithoutUnit", "displacement = { value = \"38.329 cm3/rev\"",
       "displacement = { value = ^38", "motor.displacement.value", "a displacement",
       "which has no unit (write \"38 cm3/rev\")"},
      {"TextForInteger", "[motor]\ncount = 4", "[motor]\ncount = ^\"four\"", "motor.count",
       "an integer from 1 to 1000", "'four'"},
      {"IntegerInQuotationMarks", "[motor]\ncount = 4", "[motor]\ncount = ^\"4\"", "motor.count",
       "an integer from 1 to 1000", "'4' (write 4, without quotation marks)"},
      {"TextForBoolean", "efficiency_in_stiffness = true", "efficiency_in_stiffness = ^\"yes\"",
       "oil.efficiency_in_stiffness", "true or false", "'yes'"},

      // Numbers.
      {"NotANumber", "torque_efficiency = { value = \"0.938\"",
       "torque_efficiency = { value = ^nan", "motor.torque_efficiency.value", "a number",
       "a number must be finite"},
      {"Infinite", "\"2000 psi\"", "\"^inf psi\"", "drive.supply_pressure.value", "a pressure",
       "a number must be finite"},
      {"DecimalComma", "\"13.11 m\"", "\"^13,11 m\"", "oil.line[0].length.value", "a length",
       "write 13.11"},
      {"NegativeInertia", "\"0.3007 kg.m2\"", "^\"-0.3007 kg.m2\"", "motor.inertia.value",
       "an inertia above 0 kg.m2", "'-0.3007 kg.m2'"},
      {"EfficiencyAboveOne", "\"0.938\"", "^\"1.066\"", "motor.torque_efficiency.value",
       "a number above 0 and at most 1", "'1.066'"},
      {"EfficiencyInPercentWithoutSign", "\"0.9412\"", "^\"94.12\"",
       "motor.volumetric_efficiency.value", "a number above 0 and at most 1", "'94.12'"},
      {"NegativeUncertainty", "uncertainty = \"0.01 Hz\"", "uncertainty = ^\"-0.01 Hz\"",
       "resonance.frequency.uncertainty", "an uncertainty of at least 0", "'-0.01 Hz'"},

      // TOML.
      {"UnterminatedText", "\"DSS-14, 70-m antenna, elevation axis\"\n",
       "\"DSS-14, 70-m antenna, elevation axis^\n", "", "valid TOML",
       "the text has no closing quotation mark on its line"},
      {"QuotesForgotten", "design_speed = { value = \"10 m/s\"", "design_speed = { value = 10 ^m/s",
       "", "valid TOML", "saw 'm'"},

      // What contradicts itself.
      {"ModeBelowTheLockedRotor", "frequency = { value = \"2.4 Hz\"",
       "frequency = ^{ value = \"1.8 Hz\"", "structure.mode[0].frequency",
       "a frequency above locked_rotor_frequency, 2 Hz", "'1.8 Hz'"},
      {"BeamWeightsNotOne", "beam_weight = { value = \"0.80\"", "beam_weight = { value = \"0.70\"",
       "structure.mode", "bull_gear_beam_weight and the modes' beam_weight to sum to 1", "0.9",
       "[[structure.mode]]"},
      {"WindFractionsNotOne", "wind_fraction = { value = \"0.75\"",
       "wind_fraction = { value = \"0.85\"", "structure.mode",
       "bull_gear_wind_fraction and the modes' wind_fraction to sum to 1", "1.1",
       "[[structure.mode]]"},
      {"NothingLeftForTheBullGear", "\"0.62\"", "\"0.80\"", "structure.mode",
       "inertia_fraction to sum to less than 1", "1.05", "[[structure.mode]]"},
      {"DisksAgainstMotor", "disk_inertia = { value = \"0.012358 kg.m2\"",
       "disk_inertia = ^{ value = \"0.024716 kg.m2\"", "motor.disk_inertia",
       "rotor_inertia + flywheel_disks x disk_inertia within 5 % of inertia (0.3007 kg.m2)",
       "0.597292 kg.m2"},
      {"BudgetForAnUnknownBand", "band = \"X\"", "band = ^\"Q\"", "pointing.budget[3].band",
       "one of 'Ka', 'X'", "'Q'"},
      {"BudgetWithLossAndRms", "convention = \"mean_loss_two_axes\"\n[[pointing.budget]]",
       "rms = ^{ value = \"2 mdeg\" }\n[[pointing.budget]]", "pointing.budget[0].rms",
       "either loss (dB) or rms (angle)", "both"},
      {"BudgetWithoutNumber",
       "[[pointing.budget]]\nname = \"stated Ka-band need\"\nband = \"Ka\"\nrms =",
       "^[[pointing.budget]]\nname = \"stated Ka-band need\"\nband = \"Ka\"\n# rms =",
       "pointing.budget[2].loss", "either loss (dB) or rms (angle)", "neither"},
      {"UnknownConvention", "\"loss_at_mean_radial_error\"", "^\"loss_at_mean_error\"",
       "pointing.budget[1].convention", "one of 'mean_loss_two_axes'", "'loss_at_mean_error'"},
      {"UnknownStatedQuantity", "quantity = \"band.X.frequency\"", "quantity = ^\"tacho.scale\"",
       "stated[0].quantity", "the id of a derived quantity", "'tacho.scale'"},
      {"StatedBandThatIsNone", "quantity = \"band.Ka.frequency\"",
       "quantity = ^\"band.Q.frequency\"", "stated[1].quantity", "the id of a derived quantity",
       "'band.Q.frequency'"},
      {"DiskWithoutDensity", "[gear_train]\ndensity =", "^[gear_train]\n# density =",
       "gear_train.density", "a density for the disks' dimensions", "none"},
      {"RadiusWithoutLength", "length = { value = \"38.1 cm\"", "# length = { value = \"38.1 cm\"",
       "gear_train.assembly[0].part[0].length", "radius and length together", "the radius alone",
       "[[gear_train.assembly.part]]"},
  };
  return list;
}

class BrokenCase : public testing::TestWithParam<Mistake> {};

TEST_P(BrokenCase, IsRefusedAtItsPlaceInOneLine) {
  const Mistake& mistake = GetParam();
  EditedCase edited;
  edited.replace(mistake.old, mistake.replacement);
  if (!mistake.blamed.empty()) edited.mark(mistake.blamed);
  const ScratchFolder folder;
  const std::string path = folder.write("case.toml", edited.text());
  const ProgramResult result = run_program({"redesign", path, "--json", folder.file("r.json")});

  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
  EXPECT_EQ(result.errors.find_first_of("\r\t\033"), std::string::npos) << result.errors;
  EXPECT_THAT(result.errors, EndsWith("\n"));
  const std::string place = std::to_string(edited.line()) + ":" + std::to_string(edited.column());
  EXPECT_THAT(result.errors, StartsWith("boresight: " + path + ":" + place + ": " +
                                        (mistake.key.empty() ? "" : mistake.key + ": ") +
                                        "expected " + mistake.expected));
  const std::size_t found = result.errors.find(", found ");
  ASSERT_NE(found, std::string::npos) << result.errors;
  EXPECT_THAT(result.errors.substr(found), HasSubstr(mistake.found));
  EXPECT_EQ(folder.entries(), 1U) << "a report was written";
}

INSTANTIATE_TEST_SUITE_P(Mistakes, BrokenCase, testing::ValuesIn(mistakes()),
                         [](const auto& instance) { return instance.param.name; });

std::string refusal_of_file(const std::string& path) {
  const ScratchFolder folder;
  const ProgramResult result = run_program({"audit", path, "--json", folder.file("r.json")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
  EXPECT_EQ(folder.entries(), 0U) << "a report was written";
  return result.errors;
}

TEST(BrokenFile, MissingIsNamed) {
  const ScratchFolder folder;
  const std::string path = folder.file("none.toml");
  EXPECT_EQ(refusal_of_file(path),
            "boresight: " + path +
                ": expected a readable file, found none (No such file or directory)\n");
}

TEST(BrokenFile, FolderIsNamed) {
  const ScratchFolder folder;
  EXPECT_EQ(refusal_of_file(folder.file("")),
            "boresight: " + folder.file("") + ": expected a readable file, found a folder\n");
}

TEST(BrokenFile, UnreadableIsNamed) {
  const ScratchFolder folder;
  const std::string path = folder.write("secret.toml", EditedCase().text());
  std::filesystem::permissions(path, std::filesystem::perms::none);
  if (access(path.c_str(), R_OK) == 0) GTEST_SKIP() << "this user may read everything";
  EXPECT_THAT(refusal_of_file(path),
              HasSubstr(path + ": expected a readable file, found none (Permission denied)"));
}

TEST(BrokenFile, LinkToItselfIsNamed) {
  const ScratchFolder folder;
  const std::string path = folder.file("loop.toml");
  std::filesystem::create_symlink(path, path);
  EXPECT_THAT(refusal_of_file(path), HasSubstr(path + ": expected a readable file, found none"));
}

TEST(BrokenFile, EmptySaysWhatIsMissingFirst) {
  const ScratchFolder folder;
  const std::string path = folder.write("empty.toml", "");
  EXPECT_EQ(refusal_of_file(path),
            "boresight: " + path + ":1:1: title: expected a text, found nothing: key is missing\n");
}

TEST(BrokenFile, BinaryDoesNotReachTheTerminal) {
  const ScratchFolder folder;
  const std::string path = folder.write("binary.toml", std::string("\x7f"
                                                                   "ELF\x02\x01\x00\x1b[31m",
                                                                   12));
  const std::string message = refusal_of_file(path);
  EXPECT_THAT(message, HasSubstr(path + ":1:"));
  EXPECT_EQ(message.find('\033'), std::string::npos);
}

}  // namespace
}  // namespace boresight::app
