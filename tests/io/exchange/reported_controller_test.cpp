#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/io/exchange/reported_controller.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Case antenna_of_test() {
  return parse_case(EditedCase().text(), "case.toml");
}

// Gains "name_unit": `first`, twice that and so on.
std::string design_of(const std::string& structure, double first) {
  std::string text = R"({"structure": ")" + structure + R"(", "gains": {)";
  double value = first;
  for (auto gain : control::LoopStructure::named("PI-0").gains()) {
    std::ranges::replace(gain.name, ' ', '_');
    if (value != first) text += ", ";
    text += "\"" + gain.name + "_SI\": " + std::to_string(value);
    value += first;
  }
  return text + "}}";
}

struct Row {
  std::string purpose = "robust";
  double rms = 0.3;  // mdeg
  bool meets = true;
  double first_gain = 0.1;
  std::string more = {};
};

std::string row_of(const Row& row) {
  return R"({"structure": "PI-0", "tuned_for": ")" + row.purpose +
         R"(", "design_wind_speed_m_per_s": 10, "constraints_met": )" +
         (row.meets ? "true" : "false") + R"(, "boresight_rms_mdeg": )" + std::to_string(row.rms) +
         row.more + R"(, "design": )" + design_of("PI-0", row.first_gain) + "}";
}

std::string tune_report(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) text += (text.empty() ? "" : ",") + row_of(row);
  return R"({"tuned": {"controllers": [)" + text + "]}}";
}

double first_gain(const std::vector<Row>& rows) {
  return controller_of_report(antenna_of_test(), tune_report(rows), "report.json", "")
      .controller.gains.at(0);
}

TEST(ControllerOfReport, IsTheOneThatTheReportRecommends) {
  EXPECT_EQ(first_gain({{.rms = 0.2, .first_gain = 0.1},
                        {.rms = 0.3, .first_gain = 0.2, .more = R"(, "recommended": true)"}}),
            0.2);
}

TEST(ControllerOfReport, IsTheRobustOneOfLeastRmsWhereNoneIsRecommended) {
  EXPECT_EQ(first_gain({{.purpose = "nominal", .rms = 0.1, .first_gain = 0.1},
                        {.rms = 0.3, .first_gain = 0.2},
                        {.rms = 0.2, .meets = false, .first_gain = 0.3},
                        {.rms = 0.25, .first_gain = 0.5}}),
            0.5);
  // One that misses its goals where no other is stable.
  EXPECT_EQ(first_gain({{.purpose = "present", .rms = 0.1, .first_gain = 0.1},
                        {.rms = 0.2, .meets = false, .first_gain = 0.3}}),
            0.3);
}

TEST(ControllerOfReport, HasAllGainsOfItsDesign) {
  const Case antenna = antenna_of_test();
  const auto found =
      controller_of_report(antenna, tune_report({{.first_gain = 0.125}}), "r.json", "PI-0");
  EXPECT_EQ(found.controller.structure, control::LoopStructure::named("PI-0"));
  EXPECT_THAT(found.controller.gains, ElementsAre(0.125, 0.25, 0.375, 0.5));
  EXPECT_EQ(found.structure, "PI-0");
  EXPECT_EQ(found.tuned_for, "robust");
  // A report of one design has no purpose to name.
  const std::string full = control::LoopStructure::named("PI-0").name();
  const std::string one = R"({"tuning": {"design": )" + design_of(full, 0.25) + "}}";
  const auto alone = controller_of_report(antenna, one, "redesign.json", "");
  EXPECT_THAT(alone.controller.gains, ElementsAre(0.25, 0.5, 0.75, 1.0));
  EXPECT_EQ(alone.structure, full);
  EXPECT_EQ(alone.tuned_for, "");
}

// Of tune and of redesign: its matrices are those of the report's linear models.
TEST(ControllerOfReport, IsAStateSpaceWhereThatIsRecommended) {
  const Case antenna = antenna_of_test();
  const auto structure = reference::lag_loops_as_state_space("state space, order 2").structure;
  const std::string models = R"(, "linear_models": {"state_space_controller": )" +
                             controller_json(*structure.state_space()) + "}}";
  const std::string tuned =
      R"({"tuned": {"controllers": [{"structure": "PI-0", "tuned_for": "robust",
          "constraints_met": true, "boresight_rms_mdeg": 0.3, "design": )" +
      design_of("PI-0", 0.1) +
      R"(}, {"structure": "SS", "tuned_for": "robust", "constraints_met": true,
          "boresight_rms_mdeg": 0.2, "gains_as_written": [],
          "design": {"structure": "state space, order 2", "gains": {}}}]})" +
      models;
  const auto found = controller_of_report(antenna, tuned, "tune.json", "");
  EXPECT_EQ(found.structure, "SS");
  EXPECT_EQ(found.tuned_for, "robust");
  EXPECT_TRUE(found.controller.structure == structure);
  EXPECT_EQ(controller_of_report(antenna, tuned, "tune.json", "PI-0").structure, "PI-0");
  const std::string redesigned =
      R"({"tuning": {"design": {"structure": "state space, order 2", "gains": {}}})" + models;
  for (const char* asked : {"", "SS"}) {
    EXPECT_TRUE(controller_of_report(antenna, redesigned, "r.json", asked).controller.structure ==
                structure);
  }
  EXPECT_THROW(controller_of_report(antenna, redesigned, "r.json", "PI-0"), InvalidInput);
  // Loops are no state space, and a report that promises one must hold it.
  const std::string loops = R"({"tuning": {"design": )" + design_of("PI-0", 0.1) + "}}";
  EXPECT_THAT(reference::Call([&] { controller_of_report(antenna, loops, "r.json", "SS"); }),
              testing::ThrowsMessage<InvalidInput>(HasSubstr("only one of PI-0")));
  const std::string bare = tuned.substr(0, tuned.find(R"(, "linear_models")")) + "}";
  EXPECT_THAT(reference::Call([&] { controller_of_report(antenna, bare, "r.json", ""); }),
              testing::ThrowsMessage<InvalidInput>(HasSubstr("r.json")));
}

TEST(ControllerOfReport, SaysWhatTheFileLacks) {
  const Case antenna = antenna_of_test();
  const auto refusal = [&](const std::string& text, const std::string& structure) -> std::string {
    try {
      controller_of_report(antenna, text, "report.json", structure);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal("title = 1", ""), HasSubstr("something else"));
  EXPECT_THAT(refusal("{}", ""), HasSubstr("neither 'tuned' nor 'tuning'"));
  EXPECT_THAT(refusal(tune_report({}), ""), HasSubstr("found none"));
  EXPECT_THAT(refusal(tune_report({{}}), "DPF"), HasSubstr("none of DPF"));
  EXPECT_THAT(refusal(R"({"tuning": {"design": {"structure": "PI-0"}}})", ""),
              HasSubstr("no gain 'rate gain' of PI-0"));
}

TEST(ControllerOfReport, IsAsFitAsAsked) {
  const Case antenna = antenna_of_test();
  const auto fit = [&](const std::vector<Row>& rows) {
    return controller_of_report(antenna, tune_report(rows), "r.json", "",
                                design::Fitness::misses_member);
  };
  EXPECT_EQ(fit({{.rms = 0.2, .meets = false, .first_gain = 0.4}, {.first_gain = 0.3}})
                .controller.gains[0],
            0.3);
  // What misses its constraints is not taken.
  EXPECT_THROW(fit({{.meets = false}}), InvalidInput);
}

TEST(StructureNamed, TakesFullAndShortNamesAndTheCasesOwn) {
  const Case antenna = antenna_of_test();
  const auto pi = loop_structure(antenna, "PI");
  EXPECT_EQ(structure_named(antenna, "PI"), pi);
  EXPECT_EQ(structure_named(antenna, pi.name()), pi);
  const auto notched = loop_structure(antenna, "FULL+N+C");
  EXPECT_EQ(structure_named(antenna, notched.name()).gains().size(), notched.gains().size());
  EXPECT_THROW(structure_named(antenna, "PID"), InvalidInput);
}

}  // namespace
}  // namespace boresight::io
