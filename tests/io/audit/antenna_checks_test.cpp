// What of sizes, bands and the ensemble an audit holds against physics and the case.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/audit/failed_checks.hpp"
#include "io/uncertain_case.hpp"

namespace boresight::io {
namespace {

using testing::IsEmpty;

TEST(InertiaAgainstTheDish, FindsAnotherUnitAndARadius) {
  const std::string check = "inertia_against_dish";
  EXPECT_THAT(failed(EditedCase(), check), IsEmpty());
  EXPECT_THAT(
      failed(read_case(BORESIGHT_SOURCE_DIR "/tests/data/campaigns/small-dish/case.toml"), check),
      IsEmpty());
  const auto light =
      failed(EditedCase().replace("2.41667e8 lbf.ft.s2", "2.41667e8 lbm.ft2"), check);
  ASSERT_EQ(light.size(), 1U);
  EXPECT_EQ(light[0].quantity, "antenna.inertia");
  EXPECT_NEAR(light[0].numbers.at(0).value, 0.0061, 0.0001);
  EXPECT_NEAR(light[0].numbers[0].lower, 0.0126, 1e-12);
  const auto small =
      failed(EditedCase().replace("{ value = \"70 m\"", "{ value = \"35 m\""), check);
  ASSERT_EQ(small.size(), 1U);
  EXPECT_GT(small[0].numbers.at(0).value, small[0].numbers[0].upper);
}

TEST(Flywheel, MustNotBurstNorExceedTheInertiaOfTheAntenna) {
  EXPECT_THAT(failed(EditedCase(), "flywheel_inertia"), IsEmpty());
  // 125 rad/s of the motors: 12.5 m/s at the rim, or 250 m/s.
  EditedCase usual("dss14-64m"), burst("dss14-64m");
  for (EditedCase* edited : {&usual, &burst})
    edited->replace_line("inertia = { value = \"0.17712", "");
  usual.replace_line("disk_inertia", "disk_radius = \"10 cm\"\ndisk_length = \"1 cm\"");
  burst.replace_line("disk_inertia", "disk_radius = \"2 m\"\ndisk_length = \"1 mm\"");
  EXPECT_THAT(failed(usual, "flywheel_rim"), IsEmpty());
  EXPECT_THAT(failed(usual, "flywheel_inertia"), IsEmpty());
  const auto rim = failed(burst, "flywheel_rim");
  ASSERT_EQ(rim.size(), 1U);
  EXPECT_EQ(rim[0].quantity, "motor.disk_radius");
  EXPECT_NEAR(rim[0].numbers[0].value * 2.0, rim[0].numbers[1].value, 1e-9);
  EXPECT_EQ(rim[0].numbers[1].upper, 150.0);
  const auto inertia = failed(burst, "flywheel_inertia");
  ASSERT_EQ(inertia.size(), 1U);
  EXPECT_EQ(inertia[0].quantity, "motor.disk_radius");
  EXPECT_GT(inertia[0].numbers[0].value, 10.0 * inertia[0].numbers[1].value);
}

TEST(CarrierFrequency, MakesABeamThatNeedsPointing) {
  const auto found = failed(read_case(case_path("dss14-70m")), "carrier_frequency");
  // 8 MHz and 32 MHz, printed for 8.4 GHz and 32 GHz.
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].quantity, "band.X.frequency");
  EXPECT_NEAR(found[0].number("wavelength").value, 37.474, 1e-3);
  EXPECT_EQ(found[0].entries.at(0).text, "8 MHz");
  EXPECT_GT(found[0].number("beam width").value, found[0].number("beam width").upper);
}

TEST(EnsembleRange, IsAsWideAsTheCasesUncertainties) {
  const std::string stated =
      "[ensemble]\nstructure_frequency = { lower = \"0.95\", upper = \"1.05\" }\n";
  const auto found = failed(uncertain_case("10 %", "10 %", stated), "ensemble_range");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].quantity, "ensemble.structure_frequency");
  EXPECT_EQ(found[0].entries.at(1).id, "structure.locked_rotor_frequency");
  const auto& lower = found[0].number("structure_frequency lower");
  const auto& upper = found[0].number("structure_frequency upper");
  EXPECT_NEAR(lower.value, 0.95, 1e-12);
  EXPECT_NEAR(lower.upper, 1.0 - 0.1 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(upper.value, 1.05, 1e-12);
  EXPECT_NEAR(upper.lower, 1.0 + 0.1 * std::sqrt(3.0), 1e-12);
  EXPECT_THAT(failed(uncertain_case("1 %", "10 %", stated), "ensemble_range"), IsEmpty());
  EXPECT_THAT(failed(uncertain_case("10 %", "10 %", ""), "ensemble_range"), IsEmpty());
}

}  // namespace
}  // namespace boresight::io
