#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/audit/case_audit.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_statements.hpp>

namespace boresight::io {
namespace {

using design::DepartingForm;
using design::Finding;
using design::FindingKind;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;

constexpr double pi = std::numbers::pi;
constexpr double inch = 0.0254;
constexpr double pound_foot = 0.45359237 * 9.80665 * 0.3048;  // lbf ft s2 in kg m2
constexpr double slug_per_cubic_foot = 0.45359237 * 9.80665 / 0.3048 / (0.3048 * 0.3048 * 0.3048);
constexpr double ratio_1 = 134.0 / 20.0;
constexpr double ratio_2 = ratio_1 * 101.0 / 21.0;
constexpr double ratio_3 = ratio_2 * 113.0 / 23.0;
constexpr double ratio_4 = ratio_3 * 77.0 / 20.0;
constexpr double ratio_5 = ratio_4 * 754.0 / 16.0;

const Case& big() {
  static const Case antenna = read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/case.toml");
  return antenna;
}

const Case& small() {
  static const Case antenna = read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-64m/case.toml");
  return antenna;
}

const CaseAudit& big_report() {
  static const CaseAudit report = audit(big());
  return report;
}

const CaseAudit& small_report() {
  static const CaseAudit report = audit(small());
  return report;
}

struct Expectation {
  FindingKind kind;
  std::string id;
  std::string printed;
  double would_be;  // SI
};

const Finding* find(const CaseAudit& report, FindingKind kind, const std::string& id,
                    const std::string& printed) {
  for (const Finding& finding : report.findings) {
    if (finding.kind != kind || finding.id != id) continue;
    for (const DepartingForm& form : finding.forms) {
      if (form.text == printed) return &finding;
    }
  }
  return nullptr;
}

void expect(const CaseAudit& report, const std::vector<Expectation>& expectations) {
  for (const Expectation& expected : expectations) {
    const Finding* finding = find(report, expected.kind, expected.id, expected.printed);
    ASSERT_NE(finding, nullptr) << expected.id << " " << expected.printed;
    for (const DepartingForm& form : finding->forms) {
      if (form.text != expected.printed) continue;
      EXPECT_NEAR(form.would_be, expected.would_be, 1e-9 * std::abs(expected.would_be))
          << expected.id << " " << expected.printed;
    }
    EXPECT_FALSE(finding->source.empty());
  }
}

double disk(double radius, double length, double density) {
  return 0.5 * pi * density * radius * radius * radius * radius * length;
}

constexpr auto conversion = FindingKind::conversion;
constexpr auto derivation = FindingKind::derivation;
constexpr auto restatement = FindingKind::restatement;

TEST(Audit, FindsWhereTheColumnsOfThePaperDisagree) {
  expect(big_report(),
         {{conversion, "gear_train.density", "15.28 slug/ft3", 7832.0},
          {conversion, "gear_train.density", "7832 kg/m3", 15.28 * slug_per_cubic_foot},
          {conversion, "part.J32.radius", "36.4998 cm", 14.375 * inch},
          {conversion, "part.J41.inertia", "39.49798 kg.m2", 29.1326 * pound_foot},
          {conversion, "part.J42.inertia", "155.0439 kg.m2", 114.356 * pound_foot},
          {conversion, "assembly.J4.inertia", "194.5418 kg.m2", 143.4886 * pound_foot},
          {conversion, "part.JC2.inertia", "0.00021 kg.m2", 0.00155 * pound_foot}});
  for (const std::string id : {"part.J41.inertia", "part.J42.inertia", "assembly.J4.inertia"}) {
    for (const Finding& finding : big_report().findings) {
      if (finding.kind != conversion || finding.id != id) continue;
      EXPECT_THAT(finding.explanations,
                  Contains(HasSubstr("converted with 1.3558 instead of 1.355818")));
    }
  }
  EXPECT_THAT(find(big_report(), conversion, "part.JC2.inertia", "0.00021 kg.m2")->explanations,
              Contains(HasSubstr("with a factor of 10")));
}

TEST(Audit, FindsTheDisksOfTable1ThatDoNotFollowFromTheirDimensions) {
  expect(
      big_report(),
      {{derivation, "part.J12.inertia", "1.5777 kg.m2", disk(0.2242, 0.0508, 7832.0)},
       {derivation, "part.J21.inertia", "0.075518 kg.m2", disk(0.06667, 0.3429, 7832.0)},
       {derivation, "part.J21.inertia", "0.0557 lbf.ft.s2",
        disk(2.625 * inch, 13.5 * inch, 7832.0)},
       {derivation, "part.J22.inertia", "5.182 kg.m2", disk(0.2667, 0.08255, 7832.0)},
       {derivation, "part.J31.inertia", "0.7688 kg.m2", disk(0.10795, 0.4953, 7832.0)},
       {derivation, "part.J32.inertia", "30.525 kg.m2", disk(14.375 * inch, 0.1397, 7832.0)},
       {derivation, "part.J41.inertia", "39.49798 kg.m2", disk(0.26162, 0.6858, 7832.0)},
       {derivation, "part.J42.inertia", "155.0439 kg.m2", disk(0.4953, 0.20955, 7832.0)},
       {derivation, "part.JC1.inertia", "0.009897 kg.m2", disk(0.0381, 0.3861, 7832.0)},
       {derivation, "part.JC1.inertia", "0.0073 lbf.ft.s2", disk(1.5 * inch, 15.2 * inch, 7832.0)},
       {derivation, "assembly.Jct.inertia", "0.01207 kg.m2", 0.009897 + 0.00155 * pound_foot}});
  // 1.5777, 30.525, 39.49798 and 155.0439 were all made with one other density.
  for (const std::string part : {"J12", "J32", "J41", "J42"}) {
    for (const Finding& finding : big_report().findings) {
      if (finding.kind != derivation || finding.id != "part." + part + ".inertia") continue;
      EXPECT_THAT(finding.explanations, Contains(HasSubstr("'15.186 slug/ft3'"))) << part;
    }
  }
}

TEST(Audit, FindsTheRowsOfTable3ThatDoNotFollow) {
  expect(big_report(),
         {{derivation, "load_inertia.J3", "0.004989 kg.m2", 4.0 * 31.294 / (ratio_3 * ratio_3)},
          {derivation, "load_inertia.J4", "0.002088 kg.m2", 4.0 * 194.5418 / (ratio_4 * ratio_4)},
          {derivation, "load_inertia.Jct", "0.048402 kg.m2", 4.0 * 0.01207},
          {derivation, "load_inertia.antenna", "0.26261 lbf.ft.s2",
           2.41667e8 * pound_foot / (ratio_5 * ratio_5)},
          {derivation, "motor_to_load_ratio", "2.09", 4.0 * 0.22177 / 0.42281},
          {derivation, "reflected_inertia.one_train", "1.31 lbf.ft.s2",
           pound_foot * (0.22177 + 0.10434 / 4 + 0.01494 / 4 + 0.00368 / 4 + 0.00154 / 4 +
                         0.03570 / 4 + 0.26261)}});
  const Finding* antenna =
      find(big_report(), derivation, "load_inertia.antenna", "0.26261 lbf.ft.s2");
  ASSERT_NE(antenna, nullptr);
  EXPECT_THAT(antenna->explanations, Contains(HasSubstr("antenna.inertia were '2.1666")));
  // J 1.77 for 1.81 with the disks recomputed: the antenna's row alone moves it.
  bool moves_reflected_inertia = false;
  for (const auto& derived_quantity : antenna->derived_quantities) {
    if (derived_quantity.id != "reflected_inertia") continue;
    moves_reflected_inertia = true;
    EXPECT_NEAR(derived_quantity.as_corrected - derived_quantity.as_printed,
                (2.41667e8 / (ratio_5 * ratio_5) - 0.262606) * pound_foot, 2e-5);
  }
  EXPECT_TRUE(moves_reflected_inertia);
}

TEST(Audit, FindsTheResultsOfTheTestsThatDoNotFollow) {
  const double displacement = 4.0 * 38.329e-6 / (2.0 * pi);
  const double stiffness =
      0.938 * 0.9412 * 1229e6 * displacement * displacement * (1.0 / 0.02455 + 1.0 / 0.02457);
  const double resonance = 2.0 * pi * 0.97;
  const double motors = 4.0 * 0.3007;
  expect(big_report(),
         {{derivation, "line.shortest.bulk_modulus", "1245.5 MPa",
           850.0 * std::pow(2.0 * 13.11 * 46.3, 2)},
          {derivation, "resonance.reflected_inertia", "1.45 kg.m2",
           stiffness / (resonance * resonance)},
          {derivation, "resonance.motor_to_load_ratio", "4.63", motors / (1.45 - motors)},
          {derivation, "resonance.motor_to_load_ratio", "4.6", motors / (1.45 - motors)},
          {derivation, "impulse.slow-ramp.motor_to_load_ratio", "4.63", motors / (1.45 - motors)},
          {derivation, "impulse.constant-speed.motor_to_load_ratio", "2.51",
           motors / (1.668 - motors)},
          {derivation, "reflected_inertia", "1.7759 kg.m2", motors + 0.57324},
          {derivation, "tachometer.scale", "2.261 rad/(s.V)",
           600.0 / 157.0 / 60.0 * 2.0 * pi * 130.0 / 23.0},
          {restatement, "line.longest.slosh_frequency", "33.3 Hz", 38.3},
          {restatement, "band.X.frequency", "8 MHz", 8.4e9},
          {restatement, "band.Ka.frequency", "32 MHz", 32e9}});
  for (const auto& [id, printed] :
       {std::pair{"resonance.motor_to_load_ratio", "4.63"},
        std::pair{"impulse.slow-ramp.motor_to_load_ratio", "4.63"},
        std::pair{"impulse.constant-speed.motor_to_load_ratio", "2.51"}}) {
    EXPECT_THAT(find(big_report(), derivation, id, printed)->explanations,
                Contains(HasSubstr("motor.inertia '0.22177 lbf.ft.s2' rounded to 0.22")));
  }
  // Consequence of 1.45 for 1.416: the ratio with the inertia from the lines as measured.
  const Finding* inertia =
      find(big_report(), derivation, "resonance.reflected_inertia", "1.45 kg.m2");
  ASSERT_FALSE(inertia->derived_quantities.empty());
  EXPECT_EQ(inertia->derived_quantities[0].id, "resonance.motor_to_load_ratio");
  EXPECT_NEAR(inertia->derived_quantities[0].as_corrected,
              motors / (stiffness / (resonance * resonance) - motors), 1e-6);
}

TEST(Audit, LeavesAloneWhatFollows) {
  for (const Finding& finding : big_report().findings) {
    EXPECT_NE(finding.id, "part.J11.inertia");
    EXPECT_NE(finding.id, "assembly.J1.inertia");
    EXPECT_NE(finding.id, "load_inertia.J2");
    EXPECT_NE(finding.id, "bulk_modulus");
    EXPECT_NE(finding.id, "friction.slow_ramp.coulomb");
    EXPECT_NE(finding.id, "oil.density");
    EXPECT_NE(finding.id, "motor.inertia");
  }
}

TEST(Audit, FindsTheMisprintsOfTable2) {
  const double rows = 0.14164 + 0.0194 + 0.04989 + 0.002088 + 0.048402 + 0.164323;
  expect(small_report(),
         {{conversion, "load_inertia.J1", "0.14164 kg.m2", 0.10434 * pound_foot},
          {conversion, "load_inertia.J2", "0.0194 kg.m2", 0.01494 * pound_foot},
          {conversion, "load_inertia.J3", "0.04989 kg.m2", 0.00368 * pound_foot},
          {derivation, "load_inertia.J1", "0.14164 kg.m2", 4.0 * 1.5876 / (ratio_1 * ratio_1)},
          {derivation, "load_inertia.J2", "0.0194 kg.m2", 4.0 * 5.2576 / (ratio_2 * ratio_2)},
          {derivation, "load_inertia.J3", "0.04989 kg.m2", 4.0 * 31.294 / (ratio_3 * ratio_3)},
          {derivation, "load_inertia", "0.3815 kg.m2", rows},
          {derivation, "load_inertia.antenna", "0.164323 kg.m2",
           1e8 * pound_foot / (ratio_5 * ratio_5)},
          {derivation, "load_inertia.antenna", "0.12120 lbf.ft.s2",
           1e8 * pound_foot / (ratio_5 * ratio_5)}});
  const auto explanations = [](const std::string& id, const std::string& printed) {
    return find(small_report(), derivation, id, printed)->explanations;
  };
  EXPECT_THAT(explanations("load_inertia.J1", "0.14164 kg.m2"),
              Contains(HasSubstr("'0.14146 kg.m2', two digits swapped")));
  EXPECT_THAT(explanations("load_inertia.J2", "0.0194 kg.m2"),
              Contains(HasSubstr("'0.01494 lbf.ft.s2' with a digit lost")));
  EXPECT_THAT(explanations("load_inertia.J3", "0.04989 kg.m2"),
              Contains(HasSubstr("with a factor of 0.1")));
  EXPECT_THAT(explanations("load_inertia", "0.3815 kg.m2"),
              Contains(HasSubstr("load_inertia.J3 '0.00368 lbf.ft.s2' from the other column")));
  EXPECT_THAT(explanations("load_inertia.antenna", "0.164323 kg.m2"),
              Contains(HasSubstr("'0.164332 kg.m2', two digits swapped")));
}

TEST(Audit, ChecksThePhysicsToo) {
  const auto failing = [](const CaseAudit& audited) {
    std::vector<std::string> ids;
    for (const auto& check : audited.physics.checks) {
      if (!check.holds) ids.push_back(check.id);
    }
    return ids;
  };
  EXPECT_THAT(
      failing(big_report()),
      IsSupersetOf({"inertia_remainder", "resonance_expected", "impulse_order", "coincidence",
                    "friction_slope", "friction_against_supply", "coulomb_levels", "recorder_limit",
                    "wave_speed", "structural_bound", "carrier_frequency"}));
  // Its friction is the 70-m antenna's, and so is its supply.
  EXPECT_THAT(failing(small_report()), ElementsAre("friction_against_supply"));
}

TEST(Audit, FindsNothingInACaseThatFollows) {
  Case clean = small();
  clean.remarks.clear();
  clean.stated.clear();
  clean.gear_train->density.reset();
  clean.friction_curve->viscous.value = 0.2;
  double load = clean.antenna->inertia.value / (ratio_5 * ratio_5);
  const double ratios[] = {1.0, ratio_1, ratio_2, ratio_3, ratio_4};
  for (RotatingAssembly& assembly : clean.gear_train->assemblies) {
    assembly.parts.clear();
    assembly.inertia->also.clear();
    load += 4.0 * assembly.inertia->value / (ratios[assembly.stages] * ratios[assembly.stages]);
  }
  StatedEntry stated;
  stated.quantity = "load_inertia";
  stated.value.kind = Kind::inertia;
  stated.value.value = std::round(load * 1e4) / 1e4;
  stated.value.half_unit = 0.5e-4;
  stated.value.text = std::to_string(stated.value.value).substr(0, 6) + " kg.m2";
  clean.stated.push_back(stated);
  const CaseAudit report = audit(clean);
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_THAT(report.physics.checks, Each(Field(&design::PhysicalCheck::holds, true)));
  EXPECT_GT(report.checked, 0U);
  EXPECT_THAT(report.compared, Contains("load_inertia"));

  clean.stated[0].value.value += 3e-3;
  EXPECT_EQ(audit(clean).findings.size(), 1U);
}

}  // namespace
}  // namespace boresight::io
