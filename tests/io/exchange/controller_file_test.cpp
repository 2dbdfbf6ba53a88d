#include <cstring>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

control::Controller controller() {
  return {control::LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}};
}

plant::StateSpace system() {
  return control::antenna_state_space_controller(control::to_state_space(controller()));
}

std::string refusal(std::string_view content, const io::ControllerNames& names = {}) {
  try {
    io::parse_controller(content, "k.json", 1000.0, names);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

void expect_same(const plant::StateSpace& one, const plant::StateSpace& other) {
  EXPECT_EQ(one.inputs, other.inputs);
  EXPECT_EQ(one.outputs, other.outputs);
  EXPECT_EQ(one.sample_time, other.sample_time);
  EXPECT_EQ(one.a, other.a);
  EXPECT_EQ(one.b, other.b);
  EXPECT_EQ(one.c, other.c);
  EXPECT_EQ(one.d, other.d);
}

TEST(ControllerFile, ComesBackBitByBitFromMatAndJson) {
  auto controller = system();
  expect_same(io::parse_controller(io::controller_mat(controller), "k.mat", 1.0).system,
              controller);
  expect_same(io::parse_controller(io::controller_json(controller), "k.json", 1.0).system,
              controller);
  controller.sample_time = 0.02;
  expect_same(io::parse_controller(io::controller_mat(controller), "k.mat", 1.0).system,
              controller);
  const ScratchFolder folder;
  for (const char* name : {"k.mat", "k.json"}) {
    io::write_controller(folder.file(name), controller);
    expect_same(io::read_controller(folder.file(name), 1.0).system, controller);
  }
}

TEST(ControllerFile, ReadsCompressedMat) {
  const auto controller = system();
  const std::string plain = io::controller_mat(controller);
  // Each element behind the head of 128 bytes in a compressed one, type 15.
  std::string packed = plain.substr(0, 128);
  for (std::size_t at = 128; at < plain.size();) {
    std::uint32_t size = 0;
    std::memcpy(&size, plain.data() + at + 4, sizeof size);
    const std::string element = plain.substr(at, 8 + size);
    uLongf length = compressBound(static_cast<uLong>(element.size()));
    std::string bytes(length, '\0');
    ASSERT_EQ(compress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                       reinterpret_cast<const Bytef*>(element.data()),
                       static_cast<uLong>(element.size())),
              Z_OK);
    const std::uint32_t type = 15, packed_size = static_cast<std::uint32_t>(length);
    packed.append(reinterpret_cast<const char*>(&type), 4);
    packed.append(reinterpret_cast<const char*>(&packed_size), 4);
    packed.append(bytes, 0, length);
    at += 8 + size;
  }
  expect_same(io::parse_controller(packed, "k.mat", 1.0).system, controller);
}

TEST(ControllerFile, TakesUnitsSignsAndTheSkysAngle) {
  const auto file = io::parse_controller(
      R"({"D": [[-2, 3, 0.5, 7]], "inputs": ["tachometer", "position_error", "motor_torque", "reference"],
          "outputs": ["valve_command"], "input_units": ["deg/s", "deg", "kN.m", "deg"],
          "output_units": ["rpm"], "angles": "sky"})",
      "k.json", 1000.0);
  const double degree = std::numbers::pi / 180.0, rpm = std::numbers::pi / 30.0;
  const auto& k = file.system;
  EXPECT_THAT(k.inputs, testing::ElementsAre("tachometer", "encoder", "motor_torque"));
  EXPECT_THAT(k.outputs, testing::ElementsAre("valve_demand"));
  // The tachometer is the motor's whatever the angles are of.
  EXPECT_NEAR(k.d(0, 0), -2.0 / degree * rpm, 1e-12 * std::abs(k.d(0, 0)));
  EXPECT_NEAR(k.d(0, 1), -3.0 / degree / 1000.0 * rpm, 1e-12 * std::abs(k.d(0, 1)));
  EXPECT_NEAR(k.d(0, 2), 0.5 / 1000.0 * rpm, 1e-15);
  EXPECT_EQ(k.a.rows(), 0);
  EXPECT_EQ(file.remarks.size(), 3U);
}

TEST(ControllerFile, NamesMayComeFromTheCommandLine) {
  const std::string bare = R"({"D": [[-0.1, -0.02]]})";
  EXPECT_THAT(refusal(bare), HasSubstr("names of the inputs in the file or by --inputs"));
  EXPECT_THAT(refusal(bare, {{"tachometer", "encoder"}, {}}), HasSubstr("--outputs"));
  EXPECT_EQ(refusal(bare, {{"tachometer", "encoder"}, {"valve_demand"}}), "");
}

TEST(ControllerFile, SaysWhatIsWrong) {
  const std::string names = R"("inputs": ["tachometer", "encoder"], "outputs": ["valve_demand"])";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "expected a MAT file of version 5 or JSON"},
      {"[1]", "expected an object with A, B, C, D"},
      {"{" + names + "}", "D: expected a list of rows, found none"},
      {R"({"D": [[1, 2, 3]], )" + names + "}",
       "D: expected 1 x 2 for 0 states, 2 inputs and 1 outputs, found 1 x 3"},
      {R"({"D": [[1, 2], [3]], )" + names + "}", "D: expected rows of 2 numbers, found one of 1"},
      {R"({"D": [[1, "x"]], )" + names + "}", "D: expected numbers"},
      {R"({"D": [[1, null]], )" + names + "}", "D: expected numbers"},
      {R"({"A": [[1, 2]], "B": [[1, 1]], "C": [[1, 1]], "D": [[1, 2]], )" + names + "}",
       "A: expected 1 x 1"},
      {R"({"A": [[1]], "B": [[1]], "C": [[1]], "D": [[1, 2]], )" + names + "}",
       "B: expected 1 x 2"},
      {R"({"A": [[1]], "B": [[1, 1]], "C": [[1], [1]], "D": [[1, 2]], )" + names + "}",
       "C: expected 1 x 1"},
      {R"({"D": [[1, 2]], "sample_time": -1, )" + names + "}", "sample time: expected 0"},
      {R"({"D": [[1, 2]], "sample_time": "1", )" + names + "}", "sample_time: expected numbers"},
      {R"({"D": [[1, 2]], "angles": "moon", )" + names + "}", "angles: expected motor or sky"},
      {R"({"D": [[1, 2]], "input_units": ["rad/s"], )" + names + "}",
       "input_units: expected 2 units or none, found 1"},
      {R"({"D": [[1, 2]], "input_units": ["rad/s", "m"], )" + names + "}",
       "unit of encoder: expected an angle"},
      {R"({"D": [[1, 2]], "input_units": ["rad/s", "degg"], )" + names + "}", "unit of encoder"},
      {R"({"D": [[1, 2]], "gain": 1, )" + names + "}", "found 'gain'"},
      {R"({"D": [[1, 2]], "inputs": ["tachometer", "encodr"], "outputs": ["valve_demand"]})",
       "found 'encodr' (did you mean 'encoder'?)"},
      {R"({"D": [[1, 2]], "inputs": ["tachometer", "tachometer"], "outputs": ["valve_demand"]})",
       "tachometer"},
      {R"({"D": [[1, 2]], "inputs": ["tachometer", "encoder"], "outputs": ["current"]})",
       "outputs: expected one of valve_demand, valve_command, rate_command, found 'current'"},
      {R"({"D": [[1e999, 2]], )" + names + "}", "k.json: "},
  };
  for (const auto& [content, expected] : cases) {
    EXPECT_THAT(refusal(content), HasSubstr(expected)) << content;
  }
  std::string mat = io::controller_mat(system());
  EXPECT_THAT(refusal(mat.substr(0, mat.size() - 40)), HasSubstr("expected a whole MAT file"));
  EXPECT_THAT(refusal("MATLAB 7.3 MAT-file"), HasSubstr("version 7.3"));
  auto broken = system();
  broken.d(0, 0) = std::nan("");
  EXPECT_THAT(refusal(io::controller_mat(broken)),
              HasSubstr("D: expected finite elements, found NaN"));
}

TEST(ControllerFile, SurvivesRandomBytes) {
  std::mt19937_64 random(3);
  const std::array<std::string, 2> good{io::controller_mat(system()),
                                        io::controller_json(system())};
  int read = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string bytes = good.at(static_cast<std::size_t>(i % 2));
    const auto changes = 1 + random() % 4;
    for (std::uint64_t k = 0; k < changes; ++k) {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    }
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    try {
      io::parse_controller(bytes, "k", 100.0);
      ++read;
    } catch (const InvalidInput&) {
    }
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace boresight::io
