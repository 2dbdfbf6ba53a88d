#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/redesign/input_effects.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::size_t all = 1000;

design::Design tuned(const io::Case& antenna) {
  design::DesignTask task;
  task.problem = make_problem(antenna);
  task.goals = make_goals(antenna);
  task.options.starts = 2;
  return design::solve(task);
}

const InputEffect& effect_of(const std::vector<InputEffect>& effects, const std::string& key) {
  const auto found = std::ranges::find_if(
      effects, [&](const InputEffect& one) { return one.quantity.key == key; });
  if (found == effects.end()) throw std::runtime_error("no effect of " + key);
  return *found;
}

TEST(InputEffects, AreWhatTheClosedLoopSays) {
  const io::Case antenna = io::parse_case(
      EditedCase()
          .replace_line("air_density = {",
                        "air_density = { value = \"1.1 kg/m3\", uncertainty = \"3 %\" }\n"
                        "mast_height = \"10 m\"\nheight = \"40 m\"")
          .text(),
      "case.toml");
  const design::Design design = tuned(antenna);
  ASSERT_TRUE(design.usable());
  const auto& law = design.tuning.law;
  const auto effects = input_effects(antenna, law, make_goals(antenna), design.beam_rms, all, 2);
  // The wind's torque goes with the density, and the sensors' noise does not.
  const InputEffect& density = effect_of(effects, "wind.air_density");
  EXPECT_FALSE(density.unstated);
  EXPECT_NEAR(density.moved_by, 0.033, 1e-12);
  EXPECT_NEAR(density.high_rms, std::hypot(1.03 * design.wind_rms, design.noise_rms),
              1e-5 * design.beam_rms);
  EXPECT_NEAR(density.low_rms, std::hypot(0.97 * design.wind_rms, design.noise_rms),
              1e-5 * design.beam_rms);
  // An assumed number without an uncertainty is moved by a tenth; the torque goes with it as well.
  const InputEffect& coefficient = effect_of(effects, "wind.torque_coefficient");
  EXPECT_TRUE(coefficient.unstated);
  EXPECT_DOUBLE_EQ(coefficient.moved_by, 0.1 * antenna.wind.torque_coefficient.value);
  // Davenport's gusts go with the root of the drag, also where it is converted from a mast.
  const InputEffect& drag = effect_of(effects, "wind.surface_drag");
  EXPECT_NEAR(drag.high_rms, std::hypot(std::sqrt(1.1) * design.wind_rms, design.noise_rms),
              1e-5 * design.beam_rms);
  // What is moved is the plant that a case with that number has: here of the dead time.
  const InputEffect& delay = effect_of(effects, "controller.delay");
  io::Case later = antenna;
  later.controller_delay.value += delay.moved_by;
  EXPECT_NEAR(delay.high_rms, design::assess(make_problem(later), law, make_goals(later)).beam_rms,
              1e-5 * design.beam_rms);
  // In falling order, the same for any number of threads, and cut where asked.
  for (std::size_t i = 1; i < effects.size(); ++i) {
    EXPECT_GE(effects[i - 1].change(design.beam_rms), effects[i].change(design.beam_rms));
  }
  const auto few = input_effects(antenna, law, make_goals(antenna), design.beam_rms, 3, 1);
  ASSERT_EQ(few.size(), 3U);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].quantity.key, effects[i].quantity.key);
    EXPECT_EQ(few[i].high_rms, effects[i].high_rms);
  }
}

TEST(InputEffects, LeaveOutWhatRecordsGave) {
  io::Case antenna = io::read_case(case_path("dss14-70m"));
  const design::Design design = tuned(antenna);
  ASSERT_TRUE(design.usable());
  const auto has_inertia = [&] {
    const auto effects =
        input_effects(antenna, design.tuning.law, make_goals(antenna), design.beam_rms, all, 2);
    return std::ranges::any_of(
        effects, [](const InputEffect& one) { return one.quantity.key == "antenna.inertia"; });
  };
  EXPECT_TRUE(has_inertia());
  antenna.antenna.inertia.text.clear();
  EXPECT_FALSE(has_inertia());
}

// Where the case states the gear train's stiffness, that is what is moved, by a tenth of it.
TEST(InputEffects, MoveTheStiffnessThatTheCaseStates) {
  const io::Case own = io::read_case(case_path("dss14-70m"));
  const double stiffness =
      make_plant(own).structure.gear_stiffness * std::pow(io::gear_ratio(own), 2);
  const auto with = [](double of) {
    return io::parse_case(
        EditedCase()
            .replace_line("locked_rotor_frequency",
                          fmt::format("gear_stiffness = {{ value = \"{:.15g} N.m/rad\", basis = "
                                      "\"assumed\", source = \"drawing\" }}",
                                      of))
            .text(),
        "case.toml");
  };
  const io::Case antenna = with(stiffness);
  const design::Design design = tuned(antenna);
  ASSERT_TRUE(design.usable());
  const auto effects =
      input_effects(antenna, design.tuning.law, make_goals(antenna), design.beam_rms, all, 2);
  const InputEffect& effect = effect_of(effects, "structure.gear_stiffness");
  EXPECT_EQ(effect.quantity.kind, io::Kind::stiffness);
  EXPECT_NEAR(effect.moved_by, 0.1 * stiffness, 1e-9 * stiffness);
  const io::Case stiffer = with(1.1 * stiffness);
  EXPECT_NEAR(
      effect.high_rms,
      design::assess(make_problem(stiffer), design.tuning.law, make_goals(stiffer)).beam_rms,
      1e-5 * design.beam_rms);
}

TEST(InputEffects, KeepTheSumOfShares) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const design::Design design = tuned(antenna);
  ASSERT_TRUE(design.usable());
  const auto effects =
      input_effects(antenna, design.tuning.law, make_goals(antenna), design.beam_rms, all, 2);
  // More of the beam on the lowest mode, less on all others.
  const InputEffect& weight = effect_of(effects, "structure.mode[0].beam_weight");
  io::Case heavier = antenna;
  const double others = 1.0 - heavier.structure.modes[0].beam_weight.value;
  const double most = weight.range.value().second;
  const double left = (1.0 - most) / others;
  heavier.structure.bull_gear_beam_weight.value *= left;
  for (auto& mode : heavier.structure.modes) mode.beam_weight.value *= left;
  heavier.structure.modes[0].beam_weight.value = most;
  EXPECT_NEAR(
      weight.high_rms,
      design::assess(make_problem(heavier), design.tuning.law, make_goals(heavier)).beam_rms,
      1e-5 * design.beam_rms);
}

// What the dish loses of the wind the light parts do not gain.
TEST(InputEffects, GiveWhatAShareLosesToTheOthersInertias) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const design::Design design = tuned(antenna);
  ASSERT_TRUE(design.usable());
  const auto effects =
      input_effects(antenna, design.tuning.law, make_goals(antenna), design.beam_rms, all, 2);
  const InputEffect& wind = effect_of(effects, "structure.mode[0].wind_fraction");
  io::Case lighter = antenna;
  auto& structure = lighter.structure;
  const double lost = structure.modes[0].wind_fraction.value - wind.range.value().first;
  ASSERT_GT(lost, 0.1);
  const double others = 1.0 - structure.modes[0].inertia_fraction.value;
  double bull_gear = 1.0;
  for (auto& mode : structure.modes) {
    bull_gear -= mode.inertia_fraction.value;
    mode.wind_fraction.value += lost * mode.inertia_fraction.value / others;
  }
  structure.bull_gear_wind_fraction.value += lost * bull_gear / others;
  structure.modes[0].wind_fraction.value = wind.range.value().first;
  EXPECT_NEAR(
      wind.low_rms,
      design::assess(make_problem(lighter), design.tuning.law, make_goals(lighter)).beam_rms,
      1e-5 * design.beam_rms);
}

TEST(InputEffects, MoveGuessedSharesToTheInertia) {
  const io::Case antenna = io::parse_case(
      EditedCase()
          .replace("wind_fraction = { value = \"0.75\", basis = \"assumed\"",
                   "wind_fraction = { value = \"0.75\", uncertainty = \"4 %\", basis = "
                   "\"assumed\"")
          .text(),
      "case.toml");
  const design::Design design = tuned(antenna);
  ASSERT_TRUE(design.usable());
  const auto effects =
      input_effects(antenna, design.tuning.law, make_goals(antenna), design.beam_rms, all, 2);
  const auto range = [&](const std::string& key) { return effect_of(effects, key).range; };
  // 0.80 of the beam on 0.62 of the inertia, and 0.15 of the wind on 0.14: half of either is more.
  EXPECT_NEAR(range("structure.mode[0].beam_weight").value().first, 0.4, 1e-12);
  EXPECT_NEAR(range("structure.mode[0].beam_weight").value().second, 1.0, 1e-12);
  EXPECT_NEAR(range("structure.mode[1].wind_fraction").value().first, 0.075, 1e-12);
  // The bull gear has 0.13 of the inertia and no wind, and cannot have less.
  EXPECT_EQ(range("structure.bull_gear_wind_fraction").value().first, 0.0);
  EXPECT_NEAR(range("structure.bull_gear_wind_fraction").value().second, 0.13, 1e-12);
  EXPECT_FALSE(range("structure.mode[0].wind_fraction"));
  // A weight of -0.15 moves by a tenth.
  EXPECT_FALSE(range("structure.mode[2].beam_weight"));
}

TEST(InputEffects, MoveTheLeakageRateThatAFlowMakes) {
  const auto text = [](const std::string& volume) {
    return EditedCase()
        .replace("leakage_rate = { value = \"1.219 1/s\"",
                 "leakage_pressure = \"7 MPa\"\nleakage_flow = { value = \"1.1 L/min\"")
        .replace("volume_1 = { value = \"0.02455 m3\"", "volume_1 = { value = \"" + volume + "\"")
        .text();
  };
  const io::Case antenna = io::parse_case(text("0.02455 m3"), "case.toml");
  const design::Design design = tuned(antenna);
  ASSERT_TRUE(design.usable());
  const auto effects =
      input_effects(antenna, design.tuning.law, make_goals(antenna), design.beam_rms, all, 2);
  // Its uncertainty is 1 %.
  const auto larger = make_problem(io::parse_case(text("0.0247955 m3"), "case.toml"));
  EXPECT_NEAR(effect_of(effects, "oil.volume_1").high_rms,
              design::assess(larger, design.tuning.law, make_goals(antenna)).beam_rms,
              1e-5 * design.beam_rms);
}

TEST(InputEffects, SayWhatToMeasureFirst) {
  InputEffect effect;
  effect.quantity.key = "wind.torque_coefficient";
  effect.quantity.value = 0.1;
  effect.moved_by = 0.01;
  effect.low_rms = 0.45 * millidegree;
  effect.high_rms = 0.55 * millidegree;
  const double rms = 0.5 * millidegree;
  EXPECT_NEAR(effect.change(rms), 0.1, 1e-12);
  EXPECT_THAT(measure_first({effect}, rms),
              HasSubstr("wind.torque_coefficient (0.450 to 0.550 mdeg over +-10 %): measure that"));
  InputEffect share = effect;
  share.quantity.key = "structure.mode[1].beam_weight";
  share.mode = "the mode of 1.75 Hz with the bull gear held";
  EXPECT_THAT(measure_first({share}, rms),
              HasSubstr("structure.mode[1].beam_weight of the mode of 1.75 Hz with the bull gear "
                        "held (0.450 to"));
  InputEffect unstable = effect;
  unstable.quantity.key = "structure.mode[0].frequency";
  unstable.high_rms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(unstable.change(rms), std::numeric_limits<double>::infinity());
  EXPECT_THAT(measure_first({unstable, effect}, rms),
              HasSubstr("frequency (0.450 to unstable mdeg over +-10 %), wind"));
  effect.low_rms = 0.495 * millidegree;
  effect.high_rms = 0.505 * millidegree;
  EXPECT_EQ(measure_first({effect}, rms), "");
  EXPECT_THAT(measure_first({unstable, effect}, rms), Not(HasSubstr("wind")));
}

TEST(InputEffects, SayWhereFrictionIsToBeMeasuredToo) {
  InputEffect effect;
  effect.quantity.key = "wind.air_density";
  effect.quantity.value = 1.2;
  effect.moved_by = 0.12;
  effect.low_rms = 0.45 * millidegree;
  effect.high_rms = 0.55 * millidegree;
  const double rms = 0.5 * millidegree;
  const auto with = [&](double difference, const std::vector<InputEffect>& effects) {
    std::optional<TimeDomainSection> in_time(std::in_place);
    in_time->result.wind.influences = {
        {design::Influence::orifice, design::RunStatus::complete, 0.0, 9.0 * millidegree},
        {design::Influence::friction, design::RunStatus::complete, 0.0, difference}};
    return measure_first(effects, rms, in_time);
  };
  EXPECT_THAT(with(0.6 * millidegree, {effect}),
              EndsWith("measure that first. Friction, which no linear rms knows, is worth 0.600 "
                       "mdeg of the simulated: measure the friction curve about the tracking rate, "
                       "and what the bristles' stiffness rests on, as well."));
  EXPECT_THAT(with(0.6 * millidegree, {}),
              AllOf(StartsWith("Friction, which"), EndsWith("stiffness rests on.")));
  EXPECT_EQ(with(0.09 * millidegree, {effect}), measure_first({effect}, rms));
  EXPECT_EQ(with(std::numeric_limits<double>::quiet_NaN(), {effect}), measure_first({effect}, rms));
}

}  // namespace
}  // namespace boresight::app
