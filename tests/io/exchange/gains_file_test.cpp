#include <algorithm>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"
#include <boresight/io/exchange/gains_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

const std::string pi_gains =
    "structure = \"PI\"\nkr = \"0.2\"\nwi = \"0.127 Hz\"\nwp = \"6 rad/s\"\nkp = \"0.2 1/s\"\n"
    "wip = \"0.02 rad/s\"\n";

std::string refusal(const std::string& text, const std::string& structure = {}) {
  const ScratchFolder folder;
  try {
    read_gains_file(folder.write("gains.toml", text), parse_case(EditedCase().text(), "case.toml"),
                    structure, design::Fitness::misses_member);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(GainsFile, ReadsTomlInOrOutOfItsTable) {
  const Case antenna = parse_case(EditedCase().text(), "case.toml");
  const ScratchFolder folder;
  for (const std::string& text : {pi_gains, "[gains]\n" + pi_gains}) {
    const auto file = read_gains_file(folder.write("gains.toml", text), antenna, "PI");
    EXPECT_EQ(file.controller.structure, control::LoopStructure::named("PI"));
    EXPECT_EQ(file.structure, "PI");
    EXPECT_EQ(file.tuned_for, "");
    ASSERT_EQ(file.controller.gains.size(), 5U);
    EXPECT_NEAR(file.controller.gains[1], 2.0 * std::numbers::pi * 0.127, 1e-12);
  }
}

TEST(GainsFile, RefusesWhatHoldsNoGainsOfTheStructure) {
  EXPECT_THAT(refusal(pi_gains + "kx = \"1\"\n"), HasSubstr("kx"));
  EXPECT_THAT(refusal("structure = \"PJ\"\n"), HasSubstr("found 'PJ'"));
  EXPECT_THAT(refusal(pi_gains, "DPF"),
              HasSubstr("gains.toml: expected gains of 'DPF', found those of 'PI'"));
  EXPECT_THAT(refusal("{\"tuned\": 1}"), HasSubstr("a report of `boresight tune`"));
  EXPECT_THAT(refusal("{\"tuned\": {\"controllers\": []}}"),
              HasSubstr("with a controller, found none that meets its constraints"));
  EXPECT_THROW(read_gains_file("none.json", parse_case(EditedCase().text(), "case.toml")),
               InvalidInput);
}

// To the last bit, as tuning found them: not the digits written for an engineer.
TEST(GainsFile, TakesTheBestControllerOfATuneReport) {
  const Case antenna = parse_case(EditedCase().text(), "case.toml");
  const ScratchFolder folder;
  const auto row = [](const char* purpose, const char* rms, const char* met, const char* kr) {
    std::string gains;
    for (auto gain : control::LoopStructure::named("PI-0").gains()) {
      std::ranges::replace(gain.name, ' ', '_');
      gains += (gains.empty() ? "\"" : ", \"") + gain.name + "_SI\": " + kr;
    }
    return std::string(R"({"structure": "PI-0", "tuned_for": ")") + purpose +
           R"(", "design_wind_speed_m_per_s": 10, "constraints_met": )" + met +
           R"(, "boresight_rms_mdeg": )" + rms + R"(, "design": {"gains": {)" + gains +
           R"(}}, "gains_as_written": [{"symbol": "kr", "value": "0.5"}]})";
  };
  const std::string path = folder.write(
      "report.json", R"({"tuned": {"controllers": [)" + row("nominal", "0.1", "true", "0.1") + "," +
                         row("robust", "0.3", "true", "0.3") + "," +
                         row("robust", "0.2", "false", "0.4") + "," +
                         row("robust", "0.25", "true", "0.50000001") + "]}}");
  const auto file = read_gains_file(path, antenna);
  EXPECT_EQ(file.controller.gains[0], 0.50000001);
  EXPECT_EQ(file.structure, "PI-0");
  EXPECT_EQ(file.tuned_for, "robust");
  EXPECT_THROW(read_gains_file(path, antenna, "DPF"), InvalidInput);
}

}  // namespace
}  // namespace boresight::io
