#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"

namespace boresight::io {
namespace {

using testing::HasSubstr;

// What the small dish's case says with one text of it replaced.
std::string refusal(const std::string& old, const std::string& replacement) {
  std::string text = content_of(BORESIGHT_SOURCE_DIR "/tests/data/campaigns/small-dish/case.toml");
  const std::size_t at = text.find(old);
  if (at == std::string::npos) return "not in the case: " + old;
  return refusal_of(text.replace(at, old.size(), replacement));
}

TEST(CaseCampaign, RefusesARecordWithItsPlace) {
  EXPECT_THAT(refusal("test = \"slosh\"", "test = \"slush\""),
              HasSubstr("record[0].test: expected one of 'slosh', 'fast-ramp'"));
  EXPECT_THAT(refusal("rate_loop = \"open\"", "rate_loop = \"ajar\""),
              HasSubstr("record[0].rate_loop: expected one of 'open', 'closed', found 'ajar'"));
  EXPECT_THAT(refusal("file = \"fast_ramp.csv\"", "file = \"slosh.csv\""),
              HasSubstr("record[1].file: expected a name of its own, found 'slosh' again"));
  EXPECT_THAT(refusal("file = \"slosh.csv\"", "file = \"\""),
              HasSubstr("record[0].file: expected a file's name"));
  EXPECT_THAT(refusal("rate_loop = \"open\"", "rate_lop = \"open\""),
              HasSubstr("(did you mean 'rate_loop'?)"));
}

TEST(CaseCampaign, RefusesColumns) {
  EXPECT_THAT(refusal("\"p1_in\", \"p2_in\"", "\"p1_in\""),
              HasSubstr("record_columns.inlet: expected a column for each of 2 motors, found 1"));
  EXPECT_THAT(refusal("tachometer = \"tach\"", "tachometer = \"[rpm]\""),
              HasSubstr("record_columns.tachometer: expected a column's name"));
  EXPECT_THAT(refusal("tachometer = \"tach\"", "tachometer = \"tach [rpms]\""),
              HasSubstr("record_columns.tachometer: expected a unit"));
  EXPECT_THAT(refusal("time = \"time\"", "time = \"time\"\nsample_rate = \"200 Hz\""),
              HasSubstr("record_columns.sample_rate: expected either time or sample_rate"));
  EXPECT_EQ(refusal("tachometer = \"tach\"", "tachometer = \"tach [rpm]\"\nreversed = [\"tach\"]"),
            "taken");
}

TEST(CaseCampaign, RefusesScalesAndShafts) {
  EXPECT_THAT(refusal("\"11 rad/(s.V)\"", "\"11 N.m\""),
              HasSubstr("instruments.valve_command_scale: expected a rate per recorded volt"));
  EXPECT_THAT(refusal("\"11 rad/(s.V)\"", "\"-11 rad/(s.V)\""), HasSubstr("above 0"));
  // What else is wrong with it is said as of any quantity.
  EXPECT_THAT(refusal("\"11 rad/(s.V)\", uncertainty = \"3 %\"",
                      "\"11 rad/(s.V)\", uncertainty = \"3 foo\""),
              HasSubstr("instruments.valve_command_scale.uncertainty"));
  EXPECT_THAT(refusal("\"11 rad/(s.V)\", uncertainty = \"3 %\", basis = \"published\"",
                      "\"11 rad/(s.V)\", basis = \"guess\""),
              HasSubstr("instruments.valve_command_scale.basis: expected one of"));
  EXPECT_THAT(refusal("\"11 rad/(s.V)\"", "\"11 N.m\""), HasSubstr("found '11 N.m'"));
  for (const std::string scale : {"11 rad/(s.V)", "2 rad/(s.mA)", "150 rad/s"}) {
    EXPECT_EQ(refusal("\"11 rad/(s.V)\"", "\"" + scale + "\""), "taken") << scale;
  }
  EXPECT_THAT(
      refusal("rate_command_shaft = \"antenna\"", "rate_command_scale = \"2 rad/(s.V)\""),
      HasSubstr("instruments.rate_command_shaft: expected 'motor', 'tachometer' or 'antenna'"));
  EXPECT_THAT(
      refusal("pressure_range = { value = \"250 bar\"", "pressure_range = { value = \"5 V\""),
      HasSubstr("instruments.pressure_range.value: expected a pressure"));
}

TEST(CaseCampaign, RefusesATachometerThatCannotBeScaled) {
  EXPECT_THAT(refusal("[tachometer]", "[tachometer]\nvoltage = \"5 V\""),
              HasSubstr("tachometer.recorder_limit.value: expected a voltage"));
  EXPECT_THAT(refusal("recorder_limit = { value = \"200 rpm\"",
                      "voltage = \"5 V\"\nrecorder_limit = { value = \"10 V\""),
              HasSubstr("tachometer.shaft_speed: expected voltage and shaft_speed together"));
  EXPECT_THAT(refusal("[tachometer]", "[tachometer]\nshaft = \"antenna\""),
              HasSubstr("tachometer.motor_teeth: expected no motor_teeth beside shaft"));
  EXPECT_THAT(refusal("motor_teeth = { value = \"48\", basis = \"published\" }", ""),
              HasSubstr("tachometer.motor_teeth: expected motor_teeth and tachometer_teeth"));
}

TEST(CaseCampaign, RefusesPredictionsThatDoNotRise) {
  EXPECT_THAT(refusal("frequency = { value = \"6.22 Hz\"", "frequency = { value = \"4.0 Hz\""),
              HasSubstr("structure.prediction[1].frequency: expected frequencies that rise"));
}

}  // namespace
}  // namespace boresight::io
