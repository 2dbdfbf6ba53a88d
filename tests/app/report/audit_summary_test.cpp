// What an audit comes to: printed numbers and physical checks are told apart.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

AuditReport report_of(std::size_t checked, const std::vector<std::string>& failing) {
  AuditReport report;
  report.checked = checked;
  if (checked > 0) report.compared = {"load_inertia"};
  for (const std::string& check : failing) {
    Implausibility implausible;
    implausible.check = check;
    report.implausible.push_back(implausible);
  }
  return report;
}

// Of a printed number that moves the motor-to-load ratio by so much.
design::Finding finding_of(const std::string& id, double change) {
  design::Finding finding;
  finding.id = id;
  finding.forms.resize(1);
  finding.forms[0].text = "1.2 kg.m2";
  finding.derived_quantities.resize(1);
  finding.derived_quantities[0].id = "motor_to_load_ratio";
  finding.derived_quantities[0].as_printed = 1.0 + change;
  finding.derived_quantities[0].as_corrected = 1.0;
  return finding;
}

std::vector<std::string> decided(const AuditReport& audited) {
  Report report;
  report.command = "audit";
  report.audit = audited;
  return decision(report);
}

TEST(AuditSummary, StandsWithAFewFailingChecksInOtherReports) {
  Report report;
  report.command = "redesign";
  report.audit = report_of(0, {"resonance damping", "motors held"});
  report.audit->implausible[0].reasoning = "It dies sooner than leakage and friction make it.";
  EXPECT_THAT(to_text(document_of(report)), HasSubstr("  It dies sooner than leakage"));
  report.audit->implausible.resize(5);
  EXPECT_THAT(to_text(document_of(report)), testing::Not(HasSubstr("It dies sooner")));
}

TEST(AuditSummary, DoesNotBelittleAFailedPhysicalCheck) {
  const AuditReport bare = report_of(0, {"valve stroke"});
  EXPECT_EQ(audit_summary(bare),
            "The case states no derived numbers to compare ([[stated]]); 1 physical check fails: "
            "valve stroke.");
  EXPECT_THAT(decided(bare), ElementsAre("The case states no derived numbers to compare.",
                                         "1 physical check fails: valve stroke. Explain or correct "
                                         "it before designing on the case."));
  const AuditReport sound = report_of(5, {"wave speed", "recorder limit", "wave speed"});
  EXPECT_EQ(audit_summary(sound),
            "All 5 stated derived values are consistent (load_inertia); 3 physical checks fail: "
            "wave speed (2), recorder limit.");
  EXPECT_THAT(decided(sound), ElementsAre("All 5 stated derived values are consistent.",
                                          HasSubstr("3 physical checks fail: wave speed (2)")));
}

TEST(AuditSummary, SaysWhichPrintedNumbersMatter) {
  AuditReport report = report_of(5, {});
  report.findings = {finding_of("load_inertia", 1e-4)};
  EXPECT_EQ(audit_summary(report),
            "Of 5 stated values compared, 1 is inconsistent; no physical check fails. None of them "
            "changes a headline result by more than 0.1 %.");
  EXPECT_THAT(decided(report),
              ElementsAre(HasSubstr("1 of 5 stated values is inconsistent"), HasSubstr("0.01 %")));
  report.findings.push_back(finding_of("reflected_inertia", 0.05));
  EXPECT_THAT(
      audit_summary(report),
      HasSubstr(
          "2 are inconsistent; no physical check fails. Correct those that change a headline "
          "result by more than 0.1 %: reflected_inertia '1.2 kg.m2' (motor_to_load_ratio +5 %)"));
  report.findings.push_back(finding_of("load_inertia", 0.02));
  EXPECT_THAT(
      audit_summary(report),
      HasSubstr(
          "Correct those that change a headline result by more than 0.1 %: reflected_inertia"));
}

TEST(AuditSummary, SaysThatNothingIsWrong) {
  EXPECT_EQ(audit_summary(report_of(0, {})),
            "The case states no derived numbers to compare ([[stated]]), and nothing in it is "
            "physically implausible.");
  EXPECT_EQ(audit_summary(report_of(1, {})),
            "The one stated derived value is consistent (load_inertia), and nothing in the case is "
            "physically implausible.");
  EXPECT_THAT(decided(report_of(7, {})),
              ElementsAre("All 7 stated derived values are consistent: design on the case."));
}

}  // namespace
}  // namespace boresight::app
