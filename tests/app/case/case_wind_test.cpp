#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/simulate/simulated_tests.hpp>
#include <boresight/design/tuning/tuner.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/io/units/unit_table.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/wind.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;

const std::string drag =
    R"(surface_drag = { value = "0.005", basis = "assumed", source = "open country, Davenport" })";
const std::string coefficient =
    R"(torque_coefficient = { value = "0.10", basis = "assumed", source = "usual" })";
const std::string diameter = R"(dish_diameter = { value = "70 m")";

std::string refusal(const ScratchFolder& folder, const EditedCase& edited) {
  try {
    io::read_case(folder.write("case.toml", edited.text()));
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

io::Case edited_case(const ScratchFolder& folder, const EditedCase& edited) {
  return io::read_case(folder.write("case.toml", edited.text()));
}

std::string refusal_of_table(const ScratchFolder& folder, const std::string& text) {
  try {
    io::read_unit_table(
        folder.write("table.csv", text),
        {{"time", io::Kind::time}, {"turn", io::Kind::angle, false}, {"part_*", io::Kind::number}});
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(UnitTable, ReadsColumnsInAnyOrderAndUnit) {
  const ScratchFolder folder;
  const auto table = io::read_unit_table(
      folder.write("t.csv",
                   "# remark\r\nturn [deg], time [ms],part_b,part_a [%]\r\n\r\n"
                   "180,1,5,50\r\n-90,2.5e1,6,25"),
      {{"time", io::Kind::time}, {"turn", io::Kind::angle, false}, {"part_*", io::Kind::number}});
  ASSERT_EQ(table.size(), 4U);
  EXPECT_DOUBLE_EQ(table.at("time")[1], 0.025);
  EXPECT_DOUBLE_EQ(table.at("turn")[0], std::numbers::pi);
  EXPECT_DOUBLE_EQ(table.at("part_b")[1], 6.0);
  EXPECT_DOUBLE_EQ(table.at("part_a")[0], 0.5);
  const auto frequencies =
      io::read_unit_table(folder.write("f.csv", "f [Hz]\n2\n"), {{"f", io::Kind::frequency}});
  EXPECT_DOUBLE_EQ(frequencies.at("f")[0], 2.0);
  const auto angular =
      io::read_unit_table(folder.write("f.csv", "f [rad/s]\n2\n"), {{"f", io::Kind::frequency}});
  EXPECT_DOUBLE_EQ(angular.at("f")[0], 1.0 / std::numbers::pi);
}

TEST(UnitTable, RefusesWithFileAndLine) {
  const ScratchFolder folder;
  const std::pair<const char*, const char*> wrong[] = {
      {"time [s],part_1\n", "expected a header 'name [unit],...' and at least one row"},
      {"time [m],part_1\n1,2\n", "table.csv:1: column 'time': expected a time"},
      {"time [fortnight],part_1\n1,2\n", "table.csv:1: column 'time': expected"},
      {"time [s,part_1\n1,2\n", "table.csv:1: expected columns written 'name [unit]', found"},
      {"time [s]\n1\n", "table.csv:1: expected a column 'part_* [1]', found none"},
      {"part_1\n1\n", "table.csv:1: expected a column 'time [s]', found none"},
      {"time [s],tyme [s],part_1\n1,1,1\n", "columns out of time, turn, part_*, found 'tyme'"},
      {"time [s],part_1,part_1\n1,1,1\n", "expected each column once, found 'part_1' again"},
      {"#\ntime [s],part_1\n1,1\n1\n", "table.csv:4: expected 2 numbers, found 1"},
      {"time [s],part_1\n1,one\n", "table.csv:2: column 'part_1': expected a finite number"},
      {"time [s],part_1\n1,inf\n", "table.csv:2: column 'part_1': expected a finite number"},
      {"time [s],part_1\n1,\n", "table.csv:2: column 'part_1': expected a finite number"}};
  for (const auto& [text, message] : wrong) {
    EXPECT_THAT(refusal_of_table(folder, text), HasSubstr(message)) << text;
  }
  EXPECT_THROW(io::read_unit_table(folder.file("none.csv"), {}), InvalidInput);
}

// Gusts sampled at 4 Hz.
std::string wind_record(double seconds, const std::string& direction = "") {
  std::string text = "time [s],speed [m/s]";
  if (!direction.empty()) text += ",direction [deg]";
  for (int i = 0; 0.25 * i <= seconds; ++i) {
    text += fmt::format("\n{:.15g},{:.15g}", 0.25 * i, 8.0 + 2.0 * std::sin(0.3 * i));
    if (!direction.empty()) text += "," + direction;
  }
  return text;
}

TEST(CaseWind, TakesEachSpectrum) {
  const ScratchFolder folder;
  const auto problem = [&](const std::string& lines) {
    return make_problem(edited_case(folder, EditedCase().replace(drag, lines)));
  };
  const auto kaimal = problem(
      "spectrum = \"kaimal\"\nturbulence_intensity = \"18 %\"\nheight = "
      "\"40 m\"");
  EXPECT_EQ(kaimal.wind.site.gusts, plant::kaimal_gusts(0.18, 40.0));
  const auto karman = problem(
      "spectrum = \"von_karman\"\nturbulence_intensity = \"0.18\"\n"
      "length_scale = \"130 m\"");
  EXPECT_EQ(karman.wind.site.gusts, plant::von_karman_gusts(0.18, 130.0));
  const auto by_height = problem(
      "spectrum = \"von_karman\"\nturbulence_intensity = \"0.18\"\n"
      "height = \"120 m\"");
  EXPECT_EQ(by_height.wind.site.gusts, plant::von_karman_gusts(0.18, 200.0));
  const auto eurocode = problem(
      "spectrum = \"eurocode\"\nheight = \"40 m\"\nroughness_length = "
      "\"5 cm\"\nminimum_height = \"2 m\"");
  EXPECT_EQ(eurocode.wind.site.gusts, plant::eurocode_gusts(40.0, 0.05, 2.0));
  const auto davenport = problem("spectrum = \"davenport\"\n" + drag);
  EXPECT_EQ(davenport.wind.site.gusts, plant::davenport_gusts(0.005));
  // What a case without the key has always had, to the bit.
  const auto plain = make_problem(io::read_case(case_path("dss14-70m"))).wind;
  auto former = plain.site;
  former.gusts.reset();
  for (const double frequency : {1e-3, 0.1, 3.0}) {
    EXPECT_EQ(plant::wind_torque_spectrum(plain.site, plain.model, 10.0, frequency),
              plant::wind_torque_spectrum(former, plain.model, 10.0, frequency));
  }
}

TEST(CaseWind, RaisesTheMastsWindToTheDish) {
  const ScratchFolder folder;
  folder.write("wind.csv", wind_record(30.0));
  const std::string climate =
      "[[wind.climate]]\nscale = \"5 m/s\"\nshape = \"2\"\nhighest = \"20 m/s\"\n"
      "[[wind.climate]]\nspeed = \"12 m/s\"\n\n[[pointing.budget]]\nname = \"asked\"\n"
      "band = \"X\"\nrms = \"2 mdeg\"\nwind_speed = \"15 m/s\"\n\n";
  const auto with = [&](const std::string& lines) {
    EditedCase edited;
    edited.replace(drag, drag + "\nrecord = \"wind.csv\"\n" + lines);
    edited.replace("[[pointing.band]]\nname = \"X\"", climate + "[[pointing.band]]\nname = \"X\"");
    return edited_case(folder, edited);
  };
  const io::Case at_dish = with("");
  const io::Case on_mast = with("mast_height = \"10 m\"\nheight = \"40 m\"");
  const double ratio = std::pow(4.0, 0.14);
  ASSERT_TRUE(on_mast.wind->mast);
  EXPECT_NEAR(on_mast.wind->mast->speed_ratio, ratio, 1e-12);
  EXPECT_NEAR(on_mast.wind->design_speed.value, ratio * 10.0, 1e-12);
  EXPECT_NEAR(io::relative_uncertainty(on_mast.wind->design_speed),
              io::relative_uncertainty(at_dish.wind->design_speed), 1e-15);
  ASSERT_EQ(on_mast.wind->climate.size(), at_dish.wind->climate.size());
  for (std::size_t i = 0; i < at_dish.wind->climate.size(); ++i) {
    EXPECT_NEAR(on_mast.wind->climate[i].speed, ratio * at_dish.wind->climate[i].speed, 1e-9);
    EXPECT_NEAR(on_mast.wind->climate[i].weight, at_dish.wind->climate[i].weight, 1e-9);
  }
  EXPECT_NEAR(on_mast.budgets.front().wind_speed.value().value, ratio * 15.0, 1e-12);
  // Gusts are as strong at either height, in m/s.
  EXPECT_NEAR(plant::gust_variance(on_mast.wind->gusts, ratio * 10.0),
              plant::gust_variance(at_dish.wind->gusts, 10.0), 1e-12);
  const auto& raised = on_mast.wind->record.value().speed;
  const auto& recorded = at_dish.wind->record.value().speed;
  EXPECT_NEAR(raised.mean(), ratio * recorded.mean(), 1e-9);
  EXPECT_NEAR(raised[3] - raised[7], recorded[3] - recorded[7], 1e-12);
  // The exponent counts among the assumptions where the case does not state it.
  const auto exponent =
      std::ranges::find(on_mast.quantities, std::string("wind.shear_exponent"), &io::Quantity::key);
  ASSERT_NE(exponent, on_mast.quantities.end());
  EXPECT_EQ(exponent->basis, io::Basis::assumed);
  EXPECT_EQ(exponent->text, "0.14");
  const io::Case stated =
      with("mast_height = \"10 m\"\nheight = \"40 m\"\nshear_exponent = \"0.2\"");
  EXPECT_NEAR(stated.wind->design_speed.value, std::pow(4.0, 0.2) * 10.0, 1e-12);
  EXPECT_THAT(mast_in_words(stated.wind->mast.value()),
              testing::AllOf(HasSubstr("40 m above ground"), HasSubstr("its 10 m mast"),
                             HasSubstr("times 1.32"), HasSubstr("exponent 0.2")));
}

TEST(CaseWind, KeepsTheSpectrumsOwnHeightBesideAMast) {
  const ScratchFolder folder;
  const auto gusts = [&](const std::string& lines) {
    return edited_case(folder, EditedCase().replace(drag, lines)).wind->gusts;
  };
  const std::string mast = "\nheight = \"40 m\"\nmast_height = \"10 m\"";
  const double ratio = std::pow(4.0, 0.14);
  EXPECT_EQ(gusts("spectrum = \"kaimal\"\nturbulence_intensity = \"0.18\"" + mast),
            plant::kaimal_gusts(0.18 / ratio, 40.0));
  EXPECT_EQ(gusts("spectrum = \"von_karman\"\nturbulence_intensity = \"0.18\"\n"
                  "length_scale = \"130 m\"" +
                  mast),
            plant::von_karman_gusts(0.18 / ratio, 130.0));
  EXPECT_EQ(gusts("spectrum = \"eurocode\"\nroughness_length = \"5 cm\"\n"
                  "minimum_height = \"2 m\"" +
                  mast),
            plant::eurocode_gusts(40.0, 0.05, 2.0));
}

TEST(CaseWind, RefusesKeysOfOtherSpectraAndMissingOnes) {
  const ScratchFolder folder;
  const std::pair<std::string, const char*> wrong[] = {
      {"spectrum = \"kaimal\"\n" + drag,
       "wind.surface_drag: expected it with the spectrum davenport only, found it with kaimal"},
      {"spectrum = \"kaimal\"\nheight = \"40 m\"", "wind.turbulence_intensity: expected"},
      {"spectrum = \"von_karman\"\nturbulence_intensity = \"0.18\"",
       "expected either length_scale or height, found neither"},
      {"spectrum = \"von_karman\"\nturbulence_intensity = \"0.2\"\nheight = \"9 m\"\n"
       "length_scale = \"9 m\"",
       "expected either length_scale or height, found both"},
      {"spectrum = \"eurocode\"\nheight = \"40 m\"\nroughness_length = \"3 m\"\nminimum_height = "
       "\"2 m\"",
       "wind.roughness_length: expected a length below height and minimum_height"},
      {"spectrum = \"kaimel\"", "expected one of"},
      {"turbulence_intensity = \"20 %\"",
       "wind.turbulence_intensity: expected it with the spectrum kaimal or von_karman only, found "
       "it with davenport (write surface_drag = \"0.006667\", its square over 6, in its place)"},
      {drag + "\nheight = \"40 m\"",
       "expected it with the spectrum eurocode or kaimal or von_karman only, found it with "
       "davenport"},
      {drag + "\nmast_height = \"10 m\"",
       "wind.mast_height: expected the height of the dish's centre, height, beside it, found none"},
      {drag + "\nshear_exponent = \"0.2\"",
       "wind.shear_exponent: expected a mast_height beside it, found none"},
      {drag + "\ndirection = \"40 deg\"", "wind.direction: expected a torque_table beside it"}};
  for (const auto& [lines, message] : wrong) {
    EXPECT_THAT(refusal(folder, EditedCase().replace(drag, lines)), HasSubstr(message)) << lines;
  }
}

const char* const table_text =
    "yaw [deg],elevation [deg],coefficient\n"
    "180,0,-0.02\n0,0,0.10\n0,90,0.20\n-180,0,-0.02\n-180,90,-0.04\n180,90,-0.04\n";

EditedCase case_with_table() {
  EditedCase edited;
  edited.replace(coefficient, "torque_table = \"torque.csv\"\ndirection = \"200 deg\"");
  edited.replace(diameter, "azimuth = \"110 deg\"\nelevation = \"45 deg\"\n" + diameter);
  return edited;
}

TEST(CaseWind, TakesTheCoefficientFromTheTableWhereTheDishPoints) {
  const ScratchFolder folder;
  folder.write("torque.csv", table_text);
  const io::Case antenna = edited_case(folder, case_with_table());
  // Half way between 0.15 in the face and -0.03 in the back.
  EXPECT_NEAR(make_problem(antenna).wind.site.torque_coefficient, 0.06, 1e-12);
  ASSERT_TRUE(antenna.wind->attitude);
  EXPECT_NEAR(antenna.wind->attitude->yaw, 90.0 * degree, 1e-12);
  // 350 - 110 = 240, which is -120: a third of the way from the back.
  EditedCase other = case_with_table();
  other.replace("\"200 deg\"", "\"350 deg\"");
  EXPECT_NEAR(make_problem(edited_case(folder, other)).wind.site.torque_coefficient,
              -0.03 + 0.18 / 3.0, 1e-12);
}

TEST(CaseWind, RefusesTablesThatDoNotServe) {
  const ScratchFolder folder;
  EXPECT_THAT(refusal(folder, case_with_table()), HasSubstr("expected a readable table file"));
  folder.write("torque.csv", table_text);
  EXPECT_EQ(refusal(folder, case_with_table()), "");
  EditedCase both = case_with_table();
  both.replace("torque_table =", coefficient + "\ntorque_table =");
  EXPECT_THAT(refusal(folder, both), HasSubstr("either torque_coefficient or torque_table"));
  EditedCase nowhere;
  nowhere.replace(coefficient, "torque_table = \"torque.csv\"\ndirection = \"200 deg\"");
  EXPECT_THAT(refusal(folder, nowhere),
              HasSubstr("expected antenna.azimuth and antenna.elevation"));
  EditedCase no_direction = case_with_table();
  no_direction.replace("direction = \"200 deg\"", "");
  EXPECT_THAT(refusal(folder, no_direction), HasSubstr("wind.direction: expected an angle"));
  folder.write("torque.csv", std::string(table_text) + "0,0,1\n");
  EXPECT_THAT(refusal(folder, case_with_table()), HasSubstr("found 0 deg and 0 deg again"));
  folder.write("torque.csv", std::string(table_text) + "10,0,1\n");
  EXPECT_THAT(refusal(folder, case_with_table()), HasSubstr("found none for 10 deg and 90 deg"));
  folder.write("torque.csv", "yaw [deg],elevation [deg],coefficient\n0,0,1\n0,90,1\n");
  EXPECT_THAT(refusal(folder, case_with_table()), HasSubstr("at least 2 values of yaw"));
  folder.write("torque.csv",
               "yaw [deg],elevation [deg],coefficient\n0,0,1\n0,90,1\n60,0,1\n60,90,1\n");
  EXPECT_THAT(refusal(folder, case_with_table()), HasSubstr("wind.torque_table: "));
}

EditedCase case_with_record() {
  EditedCase edited;
  edited.replace(drag, drag + "\nrecord = \"wind.csv\"");
  return edited;
}

TEST(CaseWind, TracksInAMeasuredWind) {
  const ScratchFolder folder;
  folder.write("wind.csv", wind_record(66.0));
  EditedCase edited = case_with_record();
  edited.replace("model = \"coherence\"", "model = \"uniform\"");
  const io::Case antenna = edited_case(folder, edited);
  const auto loops = design::tune(make_problem(antenna), io::loop_structure(antenna, "PI"),
                                  make_goals(antenna), {});
  const auto run =
      section_of(run_position_test(antenna, "tracking", loops.controller, 1, {}), antenna, "tuned");
  EXPECT_NEAR(run.duration, 66.0, 0.01);
  EXPECT_THAT(run.description, HasSubstr("wind.csv, mean 8"));
  // The torque in the record is 1/2 rho V^2 A D C at the motor, sample for sample.
  const auto& torque = run.channels.back();
  EXPECT_EQ(torque.name, "wind_torque_at_motor");
  const auto site = make_problem(antenna).wind.site;
  const double gear = io::gear_ratio(antenna);
  const double interval = run.sample_time;
  for (const int i : {0, 7, 100, 263}) {
    const double speed = 8.0 + 2.0 * std::sin(0.3 * i);
    const double expected = plant::mean_wind_torque(site, speed) / gear;
    const auto k = static_cast<Eigen::Index>(std::llround(0.25 * i / interval));
    EXPECT_NEAR(torque.values[k], expected, 1e-4 * std::abs(expected)) << i;
  }
  ASSERT_TRUE(run.predicted_rms);
  ASSERT_TRUE(run.boresight_rms);
  // In 8 m/s: gusts scale with V, torque with V times the gusts, and all of it to lower
  // frequencies.
  const auto problem = make_problem(antenna);
  const auto tuned =
      design::tune(problem, control::LoopStructure::pi_with_lag(), make_goals(antenna), {});
  const double at_design = std::sqrt(tuned.evaluation.boresight_variance()) / gear;
  EXPECT_LT(*run.predicted_rms, std::pow(0.8, 1.5) * at_design);
  EXPECT_GT(*run.predicted_rms, std::pow(0.8, 4.0) * at_design);
}

TEST(CaseWind, RefusesRecordsThatDoNotServe) {
  const ScratchFolder folder;
  const auto found = [&](const std::string& text) {
    folder.write("wind.csv", text);
    return refusal(folder, case_with_record());
  };
  EXPECT_EQ(found(wind_record(30.0)), "");
  EXPECT_THAT(found("time [s],speed [m/s]\n0,1\n1,2\n2.3,1\n3,1\n"),
              HasSubstr("expected samples evenly spaced, every 1 s, found 2.3 s for 2 s"));
  EXPECT_THAT(found("time [s],speed [m/s]\n0,1\n10000,2\n"), HasSubstr("at most 7200 s"));
  EXPECT_THAT(found("time [s],speed [m/s]\n0,1\n1,-2\n"), HasSubstr("wind record: expected"));
  folder.write("torque.csv", table_text);
  EditedCase both = case_with_table();
  both.replace(drag, drag + "\nrecord = \"wind.csv\"");
  folder.write("wind.csv", wind_record(30.0));
  EXPECT_THAT(refusal(folder, both), HasSubstr("expected a column 'direction [rad]'"));
  folder.write("wind.csv", wind_record(30.0, "200"));
  EXPECT_EQ(refusal(folder, both), "");
}

TEST(CaseSimulation, OffsetFollowsTheElevation) {
  const ScratchFolder folder;
  EditedCase edited;
  edited.replace("offset_torque =",
                 "offset_cosine = \"30 N.m\"\noffset_sine = \"-8 N.m\"\n"
                 "offset_torque =");
  EXPECT_THAT(refusal(folder, edited), HasSubstr("expected an antenna.elevation"));
  edited.replace(diameter, "elevation = \"60 deg\"\n" + diameter);
  const auto offset = make_nonlinear_antenna(edited_case(folder, edited)).offset;
  EXPECT_NEAR(plant::offset_torque(offset, 0.0).value, -5.65 + 30.0 * 0.5 - 8.0 * std::sqrt(0.75),
              1e-12);
  // A degree further up at the antenna.
  const double gear = io::gear_ratio(io::read_case(case_path("dss14-70m")));
  EXPECT_NEAR(plant::offset_torque(offset, gear * degree).value,
              -5.65 + 30.0 * std::cos(61.0 * degree) - 8.0 * std::sin(61.0 * degree), 1e-9);
  edited.replace("axis = \"elevation\"\n", "axis = \"azimuth\"\n");
  EXPECT_THAT(refusal(folder, edited), HasSubstr("expected it for the elevation axis only"));
}

}  // namespace
}  // namespace boresight::app
