#include <string>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/structure_dynamics.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;

// The reference antenna with its structure from modes.csv.
EditedCase case_with_file() {
  EditedCase edited;
  const std::string& text = edited.text();
  const auto from = text.find("bull_gear_wind_fraction");
  const auto bound = text.find("lowest_predicted =");
  edited.replace(text.substr(from, bound - from), "modes_file = \"modes.csv\"\n");
  const auto modes = edited.text().find("[[structure.mode]]");
  const auto end = edited.text().find("# What a simulated test");
  edited.replace(edited.text().substr(modes, end - modes),
                 "# The modes are those of the file.\n\n");
  return edited;
}

// Its free modes as a finite-element program would give them: shapes of any scale, in lbm.ft2.
std::string free_modes(const io::Case& antenna, double inertia_factor = 1.0) {
  const double gear = io::gear_ratio(antenna);
  const auto modes = plant::to_vibration_modes(make_plant(antenna).structure);
  std::string text =
      "# export\nfrequency [rad/s],damping_ratio,bull_gear,encoder,beam,wind_1,"
      "wind_2,modal_inertia [lbm.ft2]";
  for (Eigen::Index i = 0; i < modes.frequency.size(); ++i) {
    const double scale = 0.1 + 0.3 * static_cast<double>(i);
    const auto shape = scale * modes.displacement_shape.col(i);
    const double wind = scale * modes.force_shape(i, 1);
    text += fmt::format("\n{:.15g},{:.15g},{:.15g},{:.15g},{:.15g},{:.15g},{:.15g},{:.15g}",
                        modes.frequency[i], modes.damping_ratio[i], shape[0], shape[1], shape[2],
                        0.25 * wind, 0.75 * wind,
                        inertia_factor * scale * scale * gear * gear / (0.45359237 * 0.09290304));
  }
  return text;
}

std::string refusal(const ScratchFolder& folder, const std::string& text) {
  try {
    io::read_case(folder.write("case.toml", text));
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(ModesFile, GivesTheStructureItWasExportedFrom) {
  const ScratchFolder folder;
  const io::Case reference = io::read_case(case_path("dss14-70m"));
  folder.write("modes.csv", free_modes(reference));
  const io::Case antenna = io::read_case(folder.write("case.toml", case_with_file().text()));
  const auto expected = make_plant(reference).structure;
  const auto found = make_plant(antenna).structure;
  EXPECT_NEAR(found.gear_stiffness, expected.gear_stiffness, 1e-9 * expected.gear_stiffness);
  EXPECT_NEAR(found.bull_gear_inertia, expected.bull_gear_inertia,
              1e-9 * expected.bull_gear_inertia);
  EXPECT_NEAR(found.bull_gear_wind_fraction, expected.bull_gear_wind_fraction, 1e-9);
  EXPECT_NEAR(found.bull_gear_beam_weight, expected.bull_gear_beam_weight, 1e-9);
  ASSERT_EQ(found.modes.size(), expected.modes.size());
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    EXPECT_NEAR(found.modes[i].inertia, expected.modes[i].inertia, 1e-9);
    EXPECT_NEAR(found.modes[i].stiffness, expected.modes[i].stiffness,
                1e-9 * expected.modes[i].stiffness);
    EXPECT_NEAR(found.modes[i].wind_fraction, expected.modes[i].wind_fraction, 1e-9);
    EXPECT_NEAR(found.modes[i].beam_weight, expected.modes[i].beam_weight, 1e-9);
    EXPECT_GT(found.modes[i].damping, 0.0);
  }
}

TEST(ModesFile, IsRefusedWithItsNameAndReason) {
  const ScratchFolder folder;
  const io::Case reference = io::read_case(case_path("dss14-70m"));
  const std::string text = case_with_file().text();
  EXPECT_THAT(refusal(folder, text), HasSubstr("modes.csv: expected a readable table file"));
  folder.write("modes.csv", free_modes(reference, 1.3));
  EXPECT_THAT(refusal(folder, text), HasSubstr("within 20 % of antenna.inertia"));
  folder.write("modes.csv",
               "frequency [Hz],damping_ratio,modal_inertia [kg.m2],bull_gear,beam,"
               "wind\n0,0,0,1,1,1\n");
  EXPECT_THAT(refusal(folder, text), HasSubstr("modal inertias above 0"));
  folder.write("modes.csv",
               "frequency [Hz],damping_ratio,modal_inertia [kg.m2],bull_gear,beam,"
               "wind\n1,0,1,1,1,1\n");
  EXPECT_THAT(refusal(folder, text), HasSubstr("modes.csv: structure: expected one mode of"));
  folder.write("modes.csv", free_modes(reference));
  EXPECT_EQ(refusal(folder, text), "");
  EditedCase stiff = case_with_file();
  stiff.replace("locked_rotor_frequency = { value = \"2.0 Hz\"",
                "locked_rotor_frequency = { value = \"2.5 Hz\"");
  EXPECT_THAT(refusal(folder, stiff.text()),
              HasSubstr("expected modes above locked_rotor_frequency, 2.5 Hz"));
  EditedCase both;
  both.replace("bull_gear_wind_fraction =",
               "modes_file = \"modes.csv\"\nbull_gear_wind_fraction =");
  EXPECT_THAT(refusal(folder, both.text()),
              HasSubstr("expected either a modes_file or what it says, found both"));
}

}  // namespace
}  // namespace boresight::app
