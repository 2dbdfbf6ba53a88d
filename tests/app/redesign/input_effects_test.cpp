#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/redesign/input_effects.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_wind.hpp>
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
  // A fast loop, on which every input has an effect.
  task.goals.standstill.reset();
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
  const auto& controller = design.tuning.controller;
  const auto effects =
      input_effects(antenna, controller, make_goals(antenna), design.boresight_rms, all, 2);
  // The wind's torque scales with the density, and the sensors' noise does not.
  const InputEffect& density = effect_of(effects, "wind.air_density");
  EXPECT_FALSE(density.unstated);
  EXPECT_NEAR(density.moved_by, 0.033, 1e-12);
  EXPECT_NEAR(density.high_rms, std::hypot(1.03 * design.wind_rms, design.noise_rms),
              1e-5 * design.boresight_rms);
  EXPECT_NEAR(density.low_rms, std::hypot(0.97 * design.wind_rms, design.noise_rms),
              1e-5 * design.boresight_rms);
  // An assumed number without an uncertainty is moved by a tenth; the torque scales with it as
  // well.
  const InputEffect& coefficient = effect_of(effects, "wind.torque_coefficient");
  EXPECT_TRUE(coefficient.unstated);
  EXPECT_DOUBLE_EQ(coefficient.moved_by, 0.1 * antenna.wind->torque_coefficient.value);
  // Davenport's gusts scale with the root of the drag, also where it is converted from a mast.
  const InputEffect& drag = effect_of(effects, "wind.surface_drag");
  EXPECT_NEAR(drag.high_rms, std::hypot(std::sqrt(1.1) * design.wind_rms, design.noise_rms),
              1e-5 * design.boresight_rms);
  // What is moved is the plant that a case with that number has: here of the dead time.
  const InputEffect& delay = effect_of(effects, "controller.delay");
  io::Case later = antenna;
  later.controller->delay.value += delay.moved_by;
  EXPECT_NEAR(delay.high_rms,
              design::assess(make_problem(later), controller, make_goals(later)).boresight_rms,
              1e-5 * design.boresight_rms);
  // In falling order, the same for any number of threads, and cut where asked.
  for (std::size_t i = 1; i < effects.size(); ++i) {
    EXPECT_GE(effects[i - 1].change(design.boresight_rms), effects[i].change(design.boresight_rms));
  }
  const auto few =
      input_effects(antenna, controller, make_goals(antenna), design.boresight_rms, 3, 1);
  ASSERT_EQ(few.size(), 3U);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].quantity.key, effects[i].quantity.key);
    EXPECT_EQ(few[i].high_rms, effects[i].high_rms);
  }
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
  InputEffect fraction = effect;
  fraction.quantity.key = "structure.mode[1].beam_weight";
  fraction.mode = "the mode of 1.75 Hz with the bull gear locked";
  EXPECT_THAT(measure_first({fraction}, rms),
              HasSubstr("structure.mode[1].beam_weight of the mode of 1.75 Hz with the bull gear "
                        "locked (0.450 to"));
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
              EndsWith("measure that first. Friction adds 0.600 mdeg in simulation: measure the "
                       "friction curve about the tracking rate and the bristle stiffness."));
  EXPECT_THAT(with(0.6 * millidegree, {}),
              AllOf(StartsWith("Friction adds"), EndsWith("bristle stiffness.")));
  EXPECT_EQ(with(0.09 * millidegree, {effect}), measure_first({effect}, rms));
  EXPECT_EQ(with(std::numeric_limits<double>::quiet_NaN(), {effect}), measure_first({effect}, rms));
}

}  // namespace
}  // namespace boresight::app
