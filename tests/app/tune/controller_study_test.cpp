#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program_run.hpp"
#include "io/edited_case.hpp"
#include <boresight/app/commands/benchmark_command.hpp>
#include <boresight/app/commands/commission_command.hpp>
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>

namespace boresight::app {
namespace {

using Json = nlohmann::ordered_json;

// Two structures and a small ensemble, so that a tuning takes a moment.
constexpr std::string_view small_study =
    "\n[ensemble]\ndraws = 1\n\n[tuning]\nstructures = [\"PI\", \"DPF\"]\nstarts = 2\n";

std::string before(const std::string& text, std::string_view mark) {
  return text.substr(0, text.find(mark));
}

// Three antennas: one with a nonlinear model, one from drawings alone, a small dish in azimuth.
std::vector<std::string> antennas() {
  const std::string dish =
      content_of(BORESIGHT_SOURCE_DIR "/tests/data/campaigns/small-dish/case.toml");
  return {EditedCase().text() + std::string(small_study),
          EditedCase("dss14-64m").text() + std::string(small_study),
          before(dish, "[instruments]") + std::string(small_study)};
}

Json answer(const std::vector<std::string>& arguments, const ScratchFolder& folder) {
  std::vector<std::string> all = arguments;
  all.insert(all.end(), {"--json", folder.file("answer.json"), "--threads", "2"});
  const ProgramResult result = run_program(all);
  EXPECT_THAT(result.exit_code, testing::AnyOf(0, 3)) << arguments.front() << result.errors;
  return Json::parse(content_of(folder.file("answer.json")));
}

Json recommended_row(const Json& tuned) {
  for (const auto& row : tuned.at("controllers")) {
    if (row.at("recommended").get<bool>()) return row;
  }
  return nullptr;
}

std::vector<double> numbers_in(const Json& gains) {
  std::vector<double> numbers;
  for (const auto& item : gains.items()) numbers.push_back(item.value().get<double>());
  return numbers;
}

TEST(ControllerStudy, EveryCommandPutsTheSameControllerOnAnAntenna) {
  for (const std::string& text : antennas()) {
    const ScratchFolder folder;
    const std::string path = folder.write("case.toml", text);
    const bool nonlinear = text.find("[simulation]") != std::string::npos;
    const Json row = recommended_row(answer({"tune", path, "--no-limit"}, folder).at("tuned"));
    ASSERT_FALSE(row.is_null());
    const Json& gains = row.at("design").at("gains");
    const std::vector<double> expected = numbers_in(gains);
    SCOPED_TRACE(row.at("structure").get<std::string>());

    const Json redesign = answer({"redesign", path}, folder).at("tuning");
    EXPECT_EQ(redesign.at("design").at("gains"), gains);
    EXPECT_EQ(redesign.at("tuned_for"), row.at("tuned_for"));
    const Json match = answer(
        {"match", path, "--points", "4", "--starts", "1", "--no-variants", "--time-domain", "none"},
        folder);
    EXPECT_EQ(match.at("matched").at("recommended_as_built").at("design").at("gains"), gains);
    const Json evaluated = answer({"evaluate", path}, folder).at("evaluated");
    const Json& as_it_is = evaluated.at("candidates").at(0);
    EXPECT_EQ(as_it_is.at("chosen_structure"), row.at("structure"));
    for (const auto& controller : as_it_is.at("controllers")) {
      if (controller.at("structure") == row.at("structure")) {
        EXPECT_EQ(controller.at("design").at("gains"), gains);
      }
    }
    const Json held =
        answer({"montecarlo", path, "--plants", "4"}, folder).at("controller").at("gains");
    ASSERT_EQ(held.size(), expected.size());
    for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(held[i].at("value"), expected[i]);

    BenchmarkArguments benchmark;
    benchmark.case_path = path;
    benchmark.threads = 2;
    EXPECT_EQ(benchmark_case(benchmark, {}).controller.controller->gains, expected);
    CommissionArguments commission;
    commission.case_path = path;
    commission.options.threads = 2;
    EXPECT_EQ(commission_case(commission, {}).plan.stages.back().controller.controller.gains,
              expected);
    if (!nonlinear) continue;
    SimulateArguments simulate;
    simulate.case_path = path;
    simulate.tests = {"slew"};
    simulate.folder = folder.file("records");
    simulate.threads = 2;
    const auto record = simulate_tests(simulate, [] { return false; }).report.position.front();
    EXPECT_EQ(record.controller.gains, expected);
  }
}

// To the last bit of its matrices, where the structures ask for one and it is best.
TEST(ControllerStudy, EveryCommandPutsTheSameStateSpaceOnAnAntenna) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "case.toml", EditedCase().text() +
                       "\n[ensemble]\ndraws = 2\n\n[tuning]\nstructures = [\"FULL+L+C\", "
                       "\"SS\"]\nstarts = 2\n");
  const Json tuned = answer({"tune", path}, folder);
  const Json row = recommended_row(tuned.at("tuned"));
  ASSERT_FALSE(row.is_null());
  ASSERT_EQ(row.at("structure"), "SS");
  EXPECT_TRUE(row.at("gains_as_written").empty());
  EXPECT_TRUE(tuned.contains("limit"));
  EXPECT_FALSE(tuned.contains("state_space"));  // the section that compares it apart
  const Json& matrices = tuned.at("linear_models").at("state_space_controller");
  EXPECT_EQ(tuned.at("linear_models").at("sampled_controller"), matrices);

  const Json redesign = answer({"redesign", path}, folder);
  EXPECT_EQ(redesign.at("linear_models").at("state_space_controller"), matrices);
  EXPECT_EQ(redesign.at("tuning").at("tuned_for"), "robust");
  EXPECT_TRUE(redesign.at("tuning").at("seeds").empty());
  EXPECT_THAT(redesign.at("card").at(0).at("text").get<std::string>(),
              testing::StartsWith("SS (robust): state space, order "));
  const std::string report = folder.write("redesign.json", redesign.dump());

  const Json match = answer(
      {"match", path, "--points", "4", "--starts", "1", "--no-variants", "--time-domain", "none"},
      folder);
  EXPECT_EQ(match.at("matched").at("recommended_as_built").at("structure"), "SS");
  const Json evaluated = answer({"evaluate", path}, folder).at("evaluated");
  EXPECT_EQ(evaluated.at("candidates").at(0).at("chosen_structure"), "SS");
  const Json plan = answer({"commission", path}, folder);
  EXPECT_EQ(plan.at("state_space_controller"), matrices);
  EXPECT_EQ(plan.at("stages").back().at("kind"), "output");
  EXPECT_EQ(plan.at("stages").back().at("feedforward"), true);

  // The report's own file puts it on the antenna again, without a search.
  BenchmarkArguments benchmark;
  benchmark.case_path = path;
  benchmark.threads = 2;
  benchmark.controller.gains = report;
  const auto score = benchmark_case(benchmark, {});
  EXPECT_EQ(score.controller.description, "SS, matrices of " + report);
  ASSERT_TRUE(score.score.ensemble);
  EXPECT_EQ(score.score.ensemble->within_constraints,
            static_cast<int>(score.score.ensemble->members.size()));
  const Json held =
      answer({"montecarlo", path, "--plants", "4", "--gains", report}, folder).at("controller");
  EXPECT_EQ(held.at("structure"), "SS");
  EXPECT_TRUE(held.at("gains").empty());
}

}  // namespace
}  // namespace boresight::app
