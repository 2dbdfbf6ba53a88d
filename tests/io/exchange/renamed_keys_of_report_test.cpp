#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/io/exchange/reported_controller.hpp>
#include <boresight/io/files/input_files.hpp>

namespace boresight::io {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

// A report of `boresight tune`, version 0.1.
std::string report_of_version_0_1() {
  std::string gains;
  for (auto gain : control::LoopStructure::named("PI-0").gains()) {
    std::ranges::replace(gain.name, ' ', '_');
    gains += (gains.empty() ? "\"" : ", \"") + gain.name + "_SI\": 0.25";
  }
  return R"({"tuned": {"laws": [{"structure": "PI-0", "tuned_for": "robust", "goals_met": true,
             "beam_rms_mdeg": 0.3, "design": {"gains": {)" +
         gains + "}}}]}}";
}

TEST(ControllerOfReport, ReadsKeysOfVersion01AndWarns) {
  const std::string path = "old.json";
  const auto found = controller_of_report(parse_case(EditedCase().text(), "case.toml"),
                                          report_of_version_0_1(), path, "");
  EXPECT_EQ(found.structure, "PI-0");
  EXPECT_EQ(found.tuned_for, "robust");
  EXPECT_THAT(warnings_noted(),
              Contains(AllOf(HasSubstr(path), HasSubstr("'laws' is now 'controllers'"),
                             HasSubstr("'beam_rms_mdeg' is now 'boresight_rms_mdeg'"))));
}

}  // namespace
}  // namespace boresight::io
