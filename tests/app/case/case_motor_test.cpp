#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/audit/audit_report.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;

// Lines of the 70-m case.
const std::string built = "inertia = { value = \"0.3007 kg.m2\"";
const std::string rotor = "rotor_inertia = { value = \"0.004108 kg.m2\"";
const std::string disk = "disk_inertia = { value = \"0.012358 kg.m2\", basis = \"inferred\"";

// The case with one of them replaced.
std::string edited(const std::string& line, const std::string& replacement) {
  return EditedCase().replace_line(line, replacement).text();
}

TEST(CaseMotor, FindsADisksInertiaByItsDimensions) {
  // The same inertia in steel: pi/2 rho L R^4.
  const double radius = std::pow(2.0 * 0.012358 / (std::numbers::pi * 7850.0 * 0.0127), 0.25);
  const std::string sizes = fmt::format(
      "disk_radius = {{ value = \"{:.15g} m\", uncertainty = \"1 %\" }}\n"
      "disk_length = {{ value = \"12.7 mm\", uncertainty = \"2 %\" }}",
      radius);
  const io::Case antenna = io::parse_case(edited(disk, sizes), "case.toml");
  const io::Quantity& inertia = antenna.motor->disk_inertia;
  EXPECT_NEAR(inertia.value, 0.012358, 1e-12 * 0.012358);
  EXPECT_EQ(inertia.kind, io::Kind::inertia);
  // The fourth power of 1 %, 2 %, and steel is taken as it is.
  EXPECT_NEAR(io::relative_uncertainty(inertia), std::hypot(0.04, 0.02), 1e-9);
  // That it is steel is an assumption, which is listed.
  const auto assumed = assumed_inputs(antenna);
  EXPECT_TRUE(std::ranges::any_of(
      assumed, [](const io::Quantity& one) { return one.key == "motor.disk_density"; }));
  const io::Case stated =
      io::parse_case(edited(disk, sizes + "\ndisk_density = \"7850 kg/m3\""), "c");
  EXPECT_EQ(stated.motor->disk_inertia.value, inertia.value);
  EXPECT_EQ(assumed_inputs(stated).size() + 1, assumed.size());
}

// What the audit says of a disk's inertia where its dimensions stand beside it.
std::vector<design::Finding> of_the_disk(const io::Case& antenna) {
  std::vector<design::Finding> found;
  for (const auto& one : audit_report(antenna).findings) {
    if (one.id == "motor.disk_inertia") found.push_back(one);
  }
  return found;
}

TEST(CaseMotor, KeepsAStatedInertiaBesideADisksDimensions) {
  const double radius = std::pow(2.0 * 0.012358 / (std::numbers::pi * 7850.0 * 0.0127), 0.25);
  const auto with_length = [&](const std::string& length, const std::string& more = "") {
    return io::parse_case(
        EditedCase()
            .replace(disk, fmt::format("disk_radius = \"{:.15g} m\"\ndisk_length = \"{}\"\n{}{}",
                                       radius, length, more, disk))
            .text(),
        "case.toml");
  };
  const io::Case plain = io::parse_case(EditedCase().text(), "case.toml");
  const io::Case same = with_length("12.7 mm");
  EXPECT_EQ(same.motor->disk_inertia.value, 0.012358);
  EXPECT_EQ(same.motor->disk_inertia.key, "motor.disk_inertia");
  EXPECT_THAT(of_the_disk(same), testing::IsEmpty());
  EXPECT_THAT(audit_report(same).compared, testing::Contains("motor.disk_inertia"));
  // No result rests on its being of steel.
  EXPECT_EQ(assumed_inputs(same).size(), assumed_inputs(plain).size());
  const auto found = of_the_disk(with_length("25.4 mm"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, design::FindingKind::derivation);
  ASSERT_EQ(found[0].forms.size(), 1U);
  EXPECT_EQ(found[0].forms[0].text, "0.012358 kg.m2");
  EXPECT_NEAR(found[0].forms[0].would_be, 2.0 * 0.012358, 1e-12);
  EXPECT_THAT(of_the_disk(with_length("25.4 mm", "disk_density = \"3925 kg/m3\"\n")),
              testing::IsEmpty());
  EXPECT_THAT(audit_report(plain).compared, testing::Not(testing::Contains("motor.disk_inertia")));
}

TEST(CaseMotor, FindsOneInertiaByTheOtherAndTheDisks) {
  const io::Case both = io::parse_case(EditedCase().text(), "case.toml");
  const io::MotorEntry& motor = *both.motor;
  const double disks = 24.0 * motor.disk_inertia.value;
  const io::Case without_rotor = io::parse_case(edited(rotor, ""), "case.toml");
  EXPECT_DOUBLE_EQ(without_rotor.motor->rotor_inertia.value, motor.inertia.value - disks);
  EXPECT_EQ(without_rotor.motor->inertia.value, motor.inertia.value);
  const io::Case without_built = io::parse_case(edited(built, ""), "case.toml");
  EXPECT_DOUBLE_EQ(without_built.motor->inertia.value, motor.rotor_inertia.value + disks);
  EXPECT_NEAR(without_built.motor->inertia.standard_uncertainty,
              std::hypot(motor.rotor_inertia.standard_uncertainty,
                         24.0 * motor.disk_inertia.standard_uncertainty),
              1e-15);
}

TEST(CaseMotor, RefusesWhatSaysTooLittleOrTwice) {
  EXPECT_THAT(refusal_of(edited(disk, "")),
              HasSubstr("motor.disk_inertia: expected disk_inertia, or disk_radius and "
                        "disk_length, found neither"));
  EXPECT_THAT(refusal_of(edited(disk, "disk_radius = \"0.2 m\"")),
              HasSubstr("motor.disk_length: expected disk_radius and disk_length together"));
  EXPECT_THAT(refusal_of(edited(disk, "disk_length = \"0.2 m\"")),
              HasSubstr("motor.disk_radius: expected disk_radius and disk_length together"));
  EXPECT_THAT(refusal_of(edited(disk,
                                "disk_inertia = \"0.012358 kg.m2\"\n"
                                "disk_density = \"7850 kg/m3\"")),
              HasSubstr("motor.disk_density: expected disk_radius and disk_length beside it, found "
                        "neither"));
  EXPECT_THAT(refusal_of(edited(disk,
                                "disk_inertia = \"0.012358 kg.m2\"\n"
                                "disk_radius = \"0.2 m\"")),
              HasSubstr("motor.disk_length: expected disk_radius and disk_length together"));
  EXPECT_THAT(refusal_of(edited(disk, "disk_radius = \"0.5 m\"\ndisk_length = \"2 cm\"")),
              HasSubstr("motor.disk_radius: expected rotor_inertia + flywheel_disks x"));
  EXPECT_THAT(
      refusal_of(EditedCase()
                     .replace_line(disk, "disk_inertia = \"0.0126 kg.m2\"")
                     .replace_line(rotor, "")
                     .text()),
      HasSubstr("motor.disk_inertia: expected flywheel_disks x disk_inertia below inertia"));
  EXPECT_THAT(refusal_of(EditedCase().replace_line(built, "").replace_line(rotor, "").text()),
              HasSubstr("motor.inertia: expected inertia, rotor_inertia or both"));
  // A misspelt key is named, and not its absence.
  EXPECT_THAT(refusal_of(edited(disk, "disk_inertai = \"0.012358 kg.m2\"")),
              HasSubstr("disk_inertai"));
}

}  // namespace
}  // namespace boresight::app
