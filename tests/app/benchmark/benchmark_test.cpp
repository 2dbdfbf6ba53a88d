#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program_run.hpp"
#include "io/edited_case.hpp"
#include <boresight/app/commands/benchmark_command.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/present_gains.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string gains(const std::string& gain = "0.2") {
  return "\n[gains]\nstructure = \"PI\"\nkr = \"" + gain +
         "\"\nwi = \"0.8 rad/s\"\nwp = \"6 rad/s\"\nkp = \"0.2 1/s\"\nwip = \"0.02 rad/s\"\n";
}

// Few members; without a nonlinear antenna, which takes the longest, unless it is asked for.
std::string small_case(const ScratchFolder& folder, const std::string& more = gains(),
                       bool nonlinear = false) {
  std::string text = EditedCase().text() + "\n[ensemble]\ndraws = 1\n" + more;
  const std::size_t from = text.find("\n[simulation");
  std::size_t to = text.find("\n[", from + 1);
  while (text.compare(to, 12, "\n[simulation") == 0) to = text.find("\n[", to + 1);
  if (!nonlinear) text.erase(from, to - from);
  return folder.write("case.toml", text);
}

ProgramResult benchmark(const std::string& path, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"benchmark", path, "--threads", "1"};
  const bool named = std::ranges::any_of(
      more, [](const std::string& one) { return one == "--gains" || one == "--controller"; });
  if (!named) arguments.insert(arguments.end(), {"--gains", "case"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments);
}

bool assumes(const nlohmann::json& sheet, const std::string& key) {
  return std::ranges::any_of(sheet.at("assumed_inputs"),
                             [&](const nlohmann::json& input) { return input.at("key") == key; });
}

// Every number of both, by place.
void expect_close(const nlohmann::json& one, const nlohmann::json& other, double tolerance,
                  const std::string& place) {
  ASSERT_EQ(one.type() == nlohmann::json::value_t::null,
            other.type() == nlohmann::json::value_t::null)
      << place;
  if (one.is_number()) {
    const double a = one.get<double>(), b = other.get<double>();
    EXPECT_NEAR(a, b, tolerance * std::max(std::abs(a), std::abs(b)) + 1e-300) << place;
  } else if (one.is_object()) {
    for (const auto& [key, value] : one.items()) {
      if (key != "nonlinear") expect_close(value, other.at(key), tolerance, place + "." + key);
    }
  } else if (one.is_array()) {
    ASSERT_EQ(one.size(), other.size()) << place;
    for (std::size_t i = 0; i < one.size(); ++i) {
      expect_close(one.at(i), other.at(i), tolerance, place + "[" + std::to_string(i) + "]");
    }
  }
}

TEST(Benchmark, ExportedControllerScoresAsTheController) {
  const ScratchFolder folder;
  const std::string path = small_case(folder);
  for (const bool sampled : {false, true}) {
    const std::string file = folder.file(sampled ? "k.mat" : "k.json");
    std::vector<std::string> arguments{"--export-controller", file, "--json",
                                       folder.file("controller.json")};
    if (sampled) arguments.emplace_back("--sampled");
    const auto controller = benchmark(path, arguments);
    ASSERT_EQ(controller.exit_code, 0) << controller.errors;
    const auto given = benchmark(path, {"--controller", file, "--json", folder.file("given.json")});
    ASSERT_EQ(given.exit_code, 0) << given.errors;
    const nlohmann::json one = nlohmann::json::parse(content_of(folder.file("controller.json")));
    const nlohmann::json other = nlohmann::json::parse(content_of(folder.file("given.json")));
    EXPECT_EQ(one.at("protocol_version"), 4);
    EXPECT_GT(one.at("score").at("torque_step").at("peak_mdeg_per_MN_m").get<double>(), 0.0);
    expect_close(one.at("score"), other.at("score"), 1e-8, "score");
    EXPECT_TRUE(other.at("no_nonlinear_score").is_string());
  }
}

// The same gains in rpm and milliradians.
TEST(Benchmark, UnitsOfAControllerDoNotMatter) {
  const ScratchFolder folder;
  const std::string path = small_case(folder);
  const std::string plain =
      folder.write("si.json", R"({"D": [[-0.2, -0.04]], "inputs": ["tachometer", "encoder"],
                                  "outputs": ["valve_command"]})");
  const auto one = benchmark(path, {"--controller", plain, "--json", folder.file("one.json")});
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const double rpm_per_si = 30.0 / 3.141592653589793;
  const std::string scaled = folder.write("rpm.json", [&] {
    nlohmann::json json{{"inputs", {"tachometer", "encoder"}},
                        {"outputs", {"valve_command"}},
                        {"input_units", {"rpm", "mrad"}},
                        {"output_units", {"rpm"}}};
    json["D"] = nlohmann::json::array({nlohmann::json::array({-0.2, -0.04 * rpm_per_si * 1e-3})});
    return json.dump();
  }());
  const auto other = benchmark(path, {"--controller", scaled, "--json", folder.file("other.json")});
  ASSERT_EQ(other.exit_code, 0) << other.errors;
  expect_close(nlohmann::json::parse(content_of(folder.file("one.json"))).at("score"),
               nlohmann::json::parse(content_of(folder.file("other.json"))).at("score"), 1e-9,
               "score");
}

TEST(Benchmark, UnstableLoopIsStatedNotScored) {
  const ScratchFolder folder;
  const auto run = benchmark(small_case(folder, gains("8")), {"--json", folder.file("out.json")});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.errors, HasSubstr("the closed loop is unstable, slowest pole at +"));
  EXPECT_THAT(run.output, HasSubstr("UNSTABLE"));
  EXPECT_THAT(run.output, HasSubstr("WARNING: the present gains of PI with lag are unstable"));
  const nlohmann::json report = nlohmann::json::parse(content_of(folder.file("out.json")));
  EXPECT_TRUE(report.at("score").is_null());
  EXPECT_FALSE(report.at("stability").at("stable").get<bool>());
}

TEST(Benchmark, SaysWhatItNeeds) {
  const ScratchFolder folder;
  const auto none = benchmark(small_case(folder, ""));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.errors, HasSubstr("--gains case: expected [gains] in the case, found none"));
  const std::string path = small_case(folder);
  const auto both = benchmark(path, {"--controller", "k.json", "--sampled"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.errors, HasSubstr("--sampled: expected gains, found --controller"));
  const auto structure = benchmark(path, {"--controller", "k.json", "--structure", "PI"});
  EXPECT_EQ(structure.exit_code, 2);
  EXPECT_THAT(structure.errors,
              HasSubstr("expected either --controller or --gains and --structure"));
  const auto part = benchmark(path, {"--part", "controller"});
  EXPECT_EQ(part.exit_code, 2);
  EXPECT_THAT(part.errors, HasSubstr("--part: expected --controller"));
  const auto missing = benchmark(path, {"--controller", folder.file("none.mat")});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.errors, HasSubstr("expected a readable file"));
}

TEST(Benchmark, WarnsOfAnotherSampleTimeAndUsesIt) {
  const ScratchFolder folder;
  const std::string controller =
      folder.write("k.json", R"({"D": [[-0.15, -0.03]], "inputs": ["tachometer", "encoder"],
                    "outputs": ["valve_demand"], "sample_time": 0.01})");
  const auto run = benchmark(small_case(folder), {"--controller", controller});
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("warning: the controller samples every 0.01 s"));
  EXPECT_THAT(run.output, HasSubstr("sampled every 0.01 s with one sample"));
}

TEST(Benchmark, ComparesScoreSheetsOfOneProtocolOnly) {
  const ScratchFolder folder;
  const std::string path = small_case(folder);
  ASSERT_EQ(benchmark(path, {"--json", folder.file("one.json")}).exit_code, 0);
  const auto run =
      benchmark(path, {"--compare", folder.file("one.json"), "--json", folder.file("two.json")});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("Comparison with another score sheet"));
  const nlohmann::json comparison =
      nlohmann::json::parse(content_of(folder.file("two.json"))).at("comparison");
  EXPECT_GT(comparison.at("quantities").size(), 50U);
  for (const auto& row : comparison.at("quantities")) {
    if (row.at("ratio_1").is_null()) continue;
    EXPECT_DOUBLE_EQ(row.at("ratio_1").get<double>(), 1.0);
  }
  nlohmann::json other = nlohmann::json::parse(content_of(folder.file("one.json")));
  other["protocol_version"] = 1;
  const auto refused = benchmark(path, {"--compare", folder.write("other.json", other.dump())});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("expected a score sheet of protocol 4, found protocol 1"));
  const auto nothing = benchmark(path, {"--compare", folder.write("bad.json", "{}")});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("expected a score sheet"));
}

TEST(Benchmark, IsTheSameForAnyNumberOfThreadsAndWritesItsCurves) {
  const ScratchFolder folder;
  const std::string path = small_case(folder, gains(), true);
  const auto one = benchmark(path, {"--json", "-", "--curves", folder.file("curves")});
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const nlohmann::json sheet = nlohmann::json::parse(one.output);
  EXPECT_EQ(sheet.at("score").at("nonlinear").at("limit_cycles").size(), 2U);
  EXPECT_TRUE(assumes(sheet, "simulation.bristle_stiffness"));
  EXPECT_FALSE(assumes(sheet, "recorder.sample_rate"));
  const auto two =
      run_program({"benchmark", path, "--gains", "case", "--threads", "3", "--json", "-"});
  EXPECT_EQ(one.output, two.output);
  for (const char* name : {"compliance.csv", "step.csv", "impulse.csv", "winds.csv"}) {
    EXPECT_GT(content_of(folder.file(std::string("curves/") + name)).size(), 200U) << name;
  }
  EXPECT_THAT(content_of(folder.file("curves/compliance.csv")), HasSubstr("frequency [Hz]"));
}

// What records show takes the place of what the case states, and the sheet says so.
TEST(Benchmark, ScoresTheAntennaThatRecordsShow) {
  const ScratchFolder folder;
  const io::Case stated = io::read_case(small_case(folder));
  const design::Mission mission = mission_of(stated);
  io::DesignedAntenna designed{stated, mission, {}, design::PlantDistribution::of_ranges(mission),
                               {},     false};
  const auto controller =
      design::controller_of(mission.present_controllers.front().controller, "PI", 0.0);
  auto as_stated = app::benchmark(designed, controller, {}, {});
  designed.antenna.drive->leakage_rate.value *= 2.0;
  designed.mission = mission_of(designed.antenna);
  designed.ensemble.source = design::EnsembleSource::records;
  designed.ensemble.members = {{"sample 1", make_plant(designed.antenna)}};
  designed.from_records = true;
  const auto recorded = app::benchmark(designed, controller, {}, {});
  EXPECT_NE(recorded.score.abscissa, as_stated.score.abscissa);
  ASSERT_TRUE(recorded.score.ensemble);
  EXPECT_EQ(recorded.score.ensemble->members.size(), 1U);
  EXPECT_THAT(to_text(recorded), HasSubstr("Linear plant as the case's records show it;"));
  EXPECT_THAT(to_text(recorded), HasSubstr("sampled from the identified distribution"));
  EXPECT_THAT(to_text(as_stated), HasSubstr("Linear plant as the case states it;"));
  const auto from_records = [](const BenchmarkReport& report) {
    return nlohmann::json::parse(to_json(report))
        .at("conditions")
        .at("plant_from_records")
        .get<bool>();
  };
  EXPECT_TRUE(from_records(recorded));
  EXPECT_FALSE(from_records(as_stated));
  compare_with(as_stated, to_json(recorded), "other.json");
  EXPECT_THAT(as_stated.compared_with,
              HasSubstr("; its plant is the one that its case's records show"));
  compare_with(as_stated, to_json(as_stated), "own.json");
  EXPECT_THAT(as_stated.compared_with, Not(HasSubstr("records")));
}

TEST(Benchmark, InterruptLeavesWhatWasWhole) {
  const ScratchFolder folder;
  BenchmarkArguments arguments;
  arguments.case_path = small_case(folder);
  arguments.controller.gains = "case";
  int asked = 0;
  const auto report = benchmark_case(arguments, [&] { return ++asked > 1; });
  EXPECT_TRUE(report.interrupted);
  EXPECT_TRUE(report.score.stable);
  EXPECT_FALSE(report.score.winds.empty());
  EXPECT_FALSE(report.score.reference);
  EXPECT_THAT(to_text(report), HasSubstr("Interrupted before: ensemble"));
  const nlohmann::json sheet = nlohmann::json::parse(to_json(report));
  EXPECT_TRUE(sheet.at("interrupted").get<bool>());
  EXPECT_EQ(sheet.at("left_out").size(), 3U);
  EXPECT_TRUE(sheet.at("score").at("reference").is_null());
}

}  // namespace
}  // namespace boresight::app
