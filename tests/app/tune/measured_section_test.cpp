#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/tune/measured_section.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using ::testing::HasSubstr;

const std::string folder = BORESIGHT_SOURCE_DIR "/cases/dss14-70m";

MeasuredTuneSection tuned(const std::string& case_path, const std::string& structure) {
  MeasuredTuneOptions options;
  options.record = "valve-chirp";
  options.structures = {structure};
  options.starts = 5;
  return tune_measured(io::read_case(case_path), options);
}

TEST(MeasuredSection, TunesOnTheChirpOfTheShippedCampaign) {
  const auto section = tuned(folder + "/campaign.toml", "DPF");
  // The bias is a tenth of the stroke, the sweep 0.1 to 8 Hz.
  EXPECT_NEAR(section.mean_rate, 10.5, 1.0);
  EXPECT_LT(section.lowest_excited, 0.15);
  EXPECT_NEAR(section.highest_excited, 8.0, 0.5);
  ASSERT_TRUE(section.channels.has_value());
  EXPECT_NEAR(section.channels->low_end_inertia(), 1.817, 0.06);
  EXPECT_NEAR(section.oil.stiffness, 52.6, 2.0);
  EXPECT_EQ(section.oil_source, "fitted to the same record");
  EXPECT_EQ(section.encoder_column, "");
  EXPECT_THAT(section.notes, ::testing::Contains(HasSubstr("no encoder was recorded")));
  ASSERT_EQ(section.controllers.size(), 1U);
  EXPECT_TRUE(section.any_confident());
  // On the plant that the records were made of, with friction and losses of the record's motion.
  auto problem = make_problem(io::read_case(folder + "/case.toml"));
  problem.plant.drive.leakage_rate = section.oil.loss_rate;
  problem.plant.drive.viscous_friction = 2.075;
  const auto& controller = section.controllers[0].tuning.controller;
  EXPECT_TRUE(
      control::stability(problem.plant, controller, problem.delay, design::analysis_grid(problem))
          .stable());
  const auto truth = design::make_evaluator(problem).evaluate(controller, false);
  for (const auto loop_break : control::loop_breaks) {
    EXPECT_LT(truth.highest_peak(loop_break), 2.1) << to_string(loop_break);
  }

  const std::string text = to_text(document_of(section));
  EXPECT_THAT(text, HasSubstr("torque at the motor shaft"));
  EXPECT_THAT(text, HasSubstr("is not examined"));
  EXPECT_THAT(text, HasSubstr("verified"));
  const auto json = json_of(section);
  EXPECT_EQ(json["controllers"][0]["status"], "confident");
  EXPECT_EQ(json["controllers"][0]["gains"].size(), 7U);
  EXPECT_EQ(json["encoder_column"], nullptr);
  EXPECT_THAT(conclude(section), ::testing::ElementsAre(HasSubstr("DPF on the measured")));
}

// An encoder that turns with the motor, reversed and in degrees of the antenna.
TEST(MeasuredSection, TakesTheEncodersColumn) {
  const auto place = std::filesystem::temp_directory_path() / "boresight-measured-study";
  std::filesystem::create_directories(place / "records");
  std::ifstream in(folder + "/records/valve-chirp.csv");
  std::ofstream out(place / "records/valve-chirp.csv");
  const io::Case shipped = io::read_case(folder + "/campaign.toml");
  const double scale = 180.0 / std::numbers::pi / io::gear_ratio(shipped);
  std::string line;
  std::getline(in, line);
  out << line << ",encoder [deg]\n";
  // By the trapezoid rule.
  double angle = 0.0, last = 0.0;
  out.precision(12);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i <= 9; ++i) std::getline(cells, cell, ',');
    // Volts to about the rate; the scale does not matter here.
    const double rate = std::stod(cell) * 4.0;
    angle += 0.01 * (rate + last);
    last = rate;
    out << line << ',' << -scale * angle << '\n';
  }
  out.close();
  std::ifstream stated(folder + "/campaign.toml");
  std::stringstream text;
  text << stated.rdbuf();
  std::string only = text.str();
  only = only.substr(0, only.find("[[record]]"));
  std::ofstream file(place / "case.toml");
  file << only << "[record_columns]\nreversed = [\"encoder\"]\n"
       << "[[record]]\nfile = \"records/valve-chirp.csv\"\ntest = \"valve-chirp\"\n"
       << "rate_loop = \"open\"\n";
  file.close();
  const auto section = tuned((place / "case.toml").string(), "PI");
  EXPECT_EQ(section.encoder_column, "encoder");
  EXPECT_TRUE(section.channels->has_encoder());
  EXPECT_FALSE(section.controllers.empty());
  std::filesystem::remove_all(place);
}

TEST(MeasuredSection, SaysWhichRecordWillDo) {
  const auto message = [](const std::string& record, const std::string& structure) {
    MeasuredTuneOptions options;
    options.record = record;
    options.structures = {structure};
    try {
      tune_measured(io::read_case(folder + "/campaign.toml"), options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  EXPECT_THAT(message("chirp", "PI"), HasSubstr("expected a record of the case, one of slosh"));
  EXPECT_THAT(message("slow-ramp", "PI"), HasSubstr("with the rate loop open"));
  EXPECT_THAT(message("fast-ramp", "PI"), HasSubstr("a response needs 1000 samples"));
  EXPECT_THAT(message("valve-chirp", "PID"), HasSubstr("PID"));
}

}  // namespace
}  // namespace boresight::app
