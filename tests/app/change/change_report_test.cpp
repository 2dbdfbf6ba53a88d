#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/change/change_report.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

ChangeReport report_of(design::Change change, const design::RatioBand& ratio) {
  ChangeReport report;
  report.title = "Dish <70 m>";
  report.comparison.kind = design::WindComparisonKind::regression;
  report.comparison.at_reference = design::RatioAtSpeed{
      8.3, {2e-5, 1.9e-5, 2.1e-5}, {1e-5, 0.9e-5, 1.1e-5}, ratio, change, false, false};
  report.predicted = design::PredictedChange{2e-5, 1e-5, {0.49, 0.4, 0.6}, 31, true};
  report.checks = {{design::ChangeCheckKind::improvement, true},
                   {design::ChangeCheckKind::prediction, false},
                   {design::ChangeCheckKind::wind_direction, std::nullopt}};
  report.old_controller =
      RecordedController{"PI", "from the case", {{"kr", "rate gain", "0.2"}}, ""};
  report.new_controller = {"DPF", "of gains.toml", {{"kr", "rate gain", "1.2"}}, ""};
  return report;
}

TEST(ChangeDecision, SaysRatioVerdictAndPrediction) {
  EXPECT_THAT(decision(report_of(design::Change::better, {0.52, 0.47, 0.58})),
              ElementsAre("Boresight error rms after the change is 0.52 (0.47 to 0.58) times that "
                          "before, at a mean wind speed of 8.3 m/s: better, significant at 95 %; "
                          "the linear model predicted 0.49 (0.40 to 0.60): held."));
  auto none = report_of(design::Change::none, {0.98, 0.9, 1.06});
  none.predicted->held = false;
  EXPECT_THAT(decision(none),
              ElementsAre("Boresight error rms after the change is 0.98 (0.90 to 1.06) times that "
                          "before, at a mean wind speed of 8.3 m/s: no change that is significant "
                          "at 95 %; the linear model predicted 0.49 (0.40 to 0.60): NOT held."));
}

TEST(ChangeDecision, GivesNoVerdictWithoutCommonWind) {
  ChangeReport report = report_of(design::Change::none, {});
  report.comparison.at_reference.reset();
  report.predicted.reset();
  report.comparison.kind = design::WindComparisonKind::no_overlap;
  report.comparison.before.slowest = 2.0;
  report.comparison.before.fastest = 5.0;
  report.comparison.after.slowest = 8.0;
  report.comparison.after.fastest = 11.0;
  EXPECT_THAT(
      decision(report)[0],
      HasSubstr("No verdict: the mean wind speeds do not overlap, 2.0 to 5.0 m/s before and "
                "8.0 to 11.0 m/s after"));
  EXPECT_THAT(to_text(report), Not(HasSubstr("times that before")));
  report.comparison.kind = design::WindComparisonKind::too_few_records;
  EXPECT_THAT(decision(report)[0], HasSubstr("at least three of each"));
}

TEST(ChangeText, BeginsWithTheDecisionAndListsEveryCheck) {
  const std::string text = to_text(report_of(design::Change::better, {0.52, 0.47, 0.58}));
  EXPECT_LT(text.find("after the change is 0.52"), text.find("Evidence"));
  EXPECT_LT(text.find("Evidence"), text.find("Checks"));
  EXPECT_THAT(text, HasSubstr("pass"));
  EXPECT_THAT(text, HasSubstr("FAIL"));
  EXPECT_THAT(text, HasSubstr("not checked"));
}

TEST(ChangeRecord, HasGainsEvidenceChecksAndRoomToSign) {
  const std::string html = change_record(report_of(design::Change::better, {0.52, 0.47, 0.58}));
  for (const char* part :
       {"Change record: Dish &lt;70 m&gt;", "after the change is 0.52",
        "Before: PI (from the case)", "kr rate gain", "After: DPF (of gains.toml)", "Evidence",
        "Checks", "FAIL", "initials", "date"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("http")));
}

TEST(ChangeJson, KeepsWhatCouldNotBeChecked) {
  const std::string json = to_json(report_of(design::Change::better, {0.52, 0.47, 0.58}));
  EXPECT_THAT(json, HasSubstr("\"check\": \"wind_direction\",\n      \"passed\": null"));
  EXPECT_THAT(json, HasSubstr("\"wind_speed_m_per_s\": 8.3"));
}

}  // namespace
}  // namespace boresight::app
