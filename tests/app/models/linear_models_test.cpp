#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/edited_case.hpp"
#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/models/linear_models.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/linear_models_description.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;

io::Case antenna() {
  return io::read_case(case_path("dss14-70m"));
}

LinearModels models() {
  const auto& structure = control::LoopStructure::pressure_feedback();
  control::Controller controller{structure, {}};
  for (const auto& gain : structure.gains())
    controller.gains.push_back(std::sqrt(gain.lower * gain.upper));
  return linear_models(make_problem(antenna()), controller, "some controller");
}

// The part of a report that has them.
std::string report_with(const LinearModels& models) {
  const nlohmann::ordered_json report{{"command", "tune"}, {"linear_models", json_of(models)}};
  return report.dump(2);
}

// Matrices and names, bit by bit.
void expect_same(const io::ControllerText& read, const plant::StateSpace& written) {
  EXPECT_EQ(read.a, written.a);
  EXPECT_EQ(read.b, written.b);
  EXPECT_EQ(read.c, written.c);
  EXPECT_EQ(read.d, written.d);
  EXPECT_EQ(read.sample_time, written.sample_time);
  EXPECT_EQ(read.inputs, written.inputs);
  EXPECT_EQ(read.outputs, written.outputs);
  EXPECT_EQ(read.input_units.size(), written.inputs.size());
}

TEST(LinearModels, ComeBackBitByBitFromMatAndJson) {
  const LinearModels written = models();
  const std::string mat = to_mat(written, "redesign", "case.toml");
  const std::string json = report_with(written);
  ASSERT_TRUE(written.loop);
  const auto& loop = *written.loop;
  for (const auto& [part, system] : {std::pair{"plant", &written.plant},
                                     {"controller", &loop.continuous},
                                     {"sampled_controller", &loop.sampled_controller}}) {
    SCOPED_TRACE(part);
    expect_same(io::controller_from_mat(mat, "m.mat", part), *system);
    expect_same(io::controller_from_json(json, "r.json", part), *system);
  }
  expect_same(io::controller_from_mat(mat, "m.mat", "closed_loop"), loop.closed_loop);
  // Without asking, the continuous controller.
  expect_same(io::controller_from_mat(mat, "m.mat"), loop.continuous);
  expect_same(io::controller_from_json(json, "r.json"), loop.continuous);
  EXPECT_EQ(loop.continuous.sample_time, 0.0);
  EXPECT_EQ(loop.sampled_controller.sample_time,
            control::sample_time_of(antenna().controller->delay.value));
  EXPECT_EQ(mat, to_mat(written, "redesign", "case.toml"));
}

TEST(LinearModels, GiveBenchmarksTheControllersOwnController) {
  const double ratio = io::gear_ratio(antenna());
  const LinearModels written = models();
  const auto mat = io::parse_controller(to_mat(written, "tune", "case.toml"), "m.mat", ratio);
  const auto json =
      io::parse_controller(report_with(written), "r.json", ratio, {{}, {}, "controller"});
  const auto own = design::controller_of(written.loop->controller, "controller", 0.0);
  for (const auto* read : {&mat.system, &json.system}) {
    EXPECT_EQ(read->a, own.system.a);
    EXPECT_EQ(read->b, own.system.b);
    EXPECT_EQ(read->c, own.system.c);
    EXPECT_EQ(read->d, own.system.d);
    EXPECT_EQ(read->inputs, own.system.inputs);
    EXPECT_EQ(read->outputs, own.system.outputs);
  }
}

TEST(LinearModels, RefusePartsThatAFileDoesNotHave) {
  const LinearModels written = models();
  const auto refusal = [](const std::string& content, const std::string& part) -> std::string {
    try {
      io::parse_controller(content, "f", 1.0, {{}, {}, part});
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  const LinearModels alone = linear_models(written.antenna, written.gear_ratio);
  for (const std::string& content : {to_mat(written, "tune", "c"), report_with(written)}) {
    EXPECT_THAT(refusal(content, "contoller"), HasSubstr("f: expected a part 'contoller', found"));
    EXPECT_THAT(refusal(content, "contoller"), HasSubstr("sampled_controller"));
  }
  EXPECT_THAT(refusal(report_with(alone), ""), HasSubstr("expected a controller, found none"));
  EXPECT_THAT(refusal(R"({"D": [[1]]})", "controller"), HasSubstr("found none"));
}

TEST(LinearModels, SayTheUnitsOfAllSignalsOfThePlant) {
  const auto json = nlohmann::json::parse(report_with(models()))["linear_models"]["plant"];
  for (const char* key : {"input_units", "output_units", "state_units"}) {
    for (const auto& unit : json[key]) EXPECT_NE(unit, "") << key;
  }
  EXPECT_EQ(json["input_units"], (std::vector<std::string>{"rad/s", "N.m"}));
  EXPECT_EQ(json["output_units"], (std::vector<std::string>{"rad/s", "N.m", "rad", "rad"}));
}

}  // namespace
}  // namespace boresight::app
