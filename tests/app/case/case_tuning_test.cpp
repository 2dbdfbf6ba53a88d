#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"
#include <boresight/design/tuning/structure_parts.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/present_gains.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;

constexpr double hertz = 2.0 * std::numbers::pi;

std::string tables() {
  return content_of(BORESIGHT_SOURCE_DIR "/tests/data/tuning/tables.toml");
}

io::Case with(const std::string& more) {
  return io::parse_case(EditedCase().text() + "\n" + more, "case.toml");
}

std::string refusal(const std::string& more) {
  return refusal_of(EditedCase().text() + "\n" + more);
}

// A text of tables.toml replaced.
std::string refusal(const std::string& old, const std::string& other) {
  std::string text = tables();
  const std::size_t at = text.find(old);
  if (at == std::string::npos) return "not in the tables: " + old;
  return refusal(text.replace(at, old.size(), other));
}

TEST(CaseTuning, ReadsAStructureOfTheEngineersOwn) {
  const io::Case antenna = with(tables());
  ASSERT_EQ(antenna.loops.size(), 1U);
  const io::LoopEntry& loop = antenna.loops[0];
  EXPECT_EQ(loop.structure.name(), "PI with a second lag");
  const auto& gains = loop.structure.gains();
  std::vector<std::string> symbols, names, units;
  for (const auto& gain : gains) {
    symbols.push_back(gain.symbol);
    names.push_back(gain.name);
    units.push_back(gain.unit);
  }
  EXPECT_THAT(symbols, testing::ElementsAre("kr", "wi", "wp", "wp2", "kp", "wip"));
  EXPECT_EQ(names[3], "rate lag corner 2");
  EXPECT_THAT(units, testing::ElementsAre("1", "rad/s", "rad/s", "rad/s", "1/s", "rad/s"));
  EXPECT_DOUBLE_EQ(gains[1].lower, 0.002 * hertz);
  EXPECT_DOUBLE_EQ(gains[3].upper, 50.0 * hertz);
  ASSERT_EQ(loop.present.size(), 6U);
  EXPECT_DOUBLE_EQ(loop.present[1].value, 0.127 * hertz);
  EXPECT_EQ(loop.present[1].source, "set in 1988");
  EXPECT_EQ(io::loop_structure(antenna, "PI with a second lag"), loop.structure);
  EXPECT_THAT(antenna.tuning->structures, testing::ElementsAre("PI", "PI-0"));
  EXPECT_EQ(antenna.tuning->starts, 4);
}

const char* first_key(control::BlockKind kind) {
  switch (kind) {
    case control::BlockKind::notch:
      return "frequency";
    case control::BlockKind::gain:
      return "gain";
    case control::BlockKind::dead_zone:
    case control::BlockKind::freeze:
      return "width";
    default:
      return "corner";
  }
}

// A structure stated block by block is the usual one of the same blocks.
TEST(CaseTuning, NamesGainsAsTheUsualStructuresDo) {
  for (const char* name : {"FULL+N+C", "LL+L+D", "PI+F"}) {
    const auto usual = control::LoopStructure::named(name);
    std::string text = "[[loop]]\nname = \"mine\"\n";
    for (const auto& block : usual.blocks()) {
      text += "[[loop.block]]\npath = '" + std::string(to_string(block.path)) + "'\nkind = '" +
              std::string(to_string(block.kind)) + "'\n";
      const char* keys[] = {first_key(block.kind), "zero_damping", "pole_damping"};
      for (std::size_t i = 0; i < block.gains.size(); ++i) {
        const io::Kind kind = io::gain_kind(block.path, block.kind, i);
        const std::string unit =
            kind == io::Kind::number ? "" : " " + std::string(io::describe(kind).si_unit);
        text += std::string(keys[i]) + " = { lower = '1" + unit + "', upper = '2" + unit + "' }\n";
      }
    }
    const io::Case antenna = with(text);
    const auto& mine = antenna.loops[0].structure.gains();
    ASSERT_EQ(mine.size(), usual.gains().size());
    for (std::size_t i = 0; i < mine.size(); ++i) {
      EXPECT_EQ(mine[i].symbol, usual.gains()[i].symbol);
      EXPECT_EQ(mine[i].name, usual.gains()[i].name);
      EXPECT_EQ(mine[i].unit, usual.gains()[i].unit);
    }
  }
}

// About one step of the encoder at the motor, whose rounding is its noise.
TEST(CaseTuning, WidthsOfConditionalIntegralsFollowTheEncoder) {
  const io::Case antenna = with("");
  const double step =
      std::sqrt(12.0) * antenna.sensors->encoder_noise.value * io::gear_ratio(antenna);
  for (const char* name : {"DPF+D", "FULL+L+F+C"}) {
    const auto structure = io::loop_structure(antenna, name);
    for (const auto& gain : structure.gains()) {
      if (gain.symbol != "dzp" && gain.symbol != "fzp") continue;
      EXPECT_NEAR(std::sqrt(gain.lower * gain.upper), step, 1e-12 * step);
    }
  }
  const auto stated = io::loop_structure(
      with("[[tuning.bound]]\ngain = 'fzp'\nlower = '0.01 deg'\nupper = '0.04 deg'\n"), "PI+F");
  EXPECT_NEAR(std::sqrt(stated.gains().back().lower * stated.gains().back().upper),
              0.02 * std::numbers::pi / 180.0, 1e-12);
  // Without encoder noise the case states both bounds.
  io::Case noiseless = with("");
  noiseless.sensors->encoder_noise.value = 0.0;
  EXPECT_THAT([&] { io::loop_structure(noiseless, "PI+F"); },
              testing::ThrowsMessage<InvalidInput>(HasSubstr("expected encoder noise")));
  EXPECT_NO_THROW(io::loop_structure(noiseless, "PI"));
  noiseless = with("[[tuning.bound]]\ngain = 'fzp'\nlower = '0.01 deg'\nupper = '0.04 deg'\n");
  noiseless.sensors->encoder_noise.value = 0.0;
  EXPECT_DOUBLE_EQ(io::loop_structure(noiseless, "PI+F").gains().back().upper,
                   0.04 * std::numbers::pi / 180.0);
  // No tuning starts from them.
  for (const auto& usual : io::usual_structures_with_lag(antenna)) {
    EXPECT_FALSE(usual.has_conditional_integral());
  }
}

// The bounds of the usual structures are those of the reference antennas, and follow another.
TEST(CaseTuning, BoundsFollowTheAntenna) {
  const auto named = control::LoopStructure::named("FULL+N+C");
  const auto bounds_of = [](const control::LoopStructure& structure) {
    std::vector<double> bounds;
    for (const auto& gain : structure.gains()) {
      bounds.push_back(gain.lower);
      bounds.push_back(gain.upper);
    }
    return bounds;
  };
  for (const char* antenna : {"dss14-70m", "dss14-64m"}) {
    const io::Case reference = io::read_case(case_path(antenna));
    EXPECT_EQ(bounds_of(io::loop_structure(reference, "FULL+N+C")), bounds_of(named)) << antenna;
  }
  io::Case small = with("");
  small.structure->locked_rotor_frequency.value = 9.0;
  small.antenna->inertia.value *= 1e-3;
  const auto structure = io::loop_structure(small, "PI+C");
  const auto& gains = structure.gains();
  EXPECT_DOUBLE_EQ(gains[3].upper, 300.0);  // kp
  EXPECT_DOUBLE_EQ(gains[5].upper, 10.0);   // cs
}

TEST(CaseTuning, BoundsOfOnesOwnTakeTheirPlace) {
  const std::string bound = "[[tuning.bound]]\ngain = 'kp'\n";
  const io::Case antenna = with(bound + "upper = '120 1/min'\n");
  for (const char* name : {"PI", "FULL+N+C"}) {
    const auto structure = io::loop_structure(antenna, name);
    const auto usual = io::loop_structure(with(""), name);
    for (std::size_t i = 0; i < usual.gains().size(); ++i) {
      const auto &own = structure.gains()[i], &other = usual.gains()[i];
      EXPECT_EQ(own.lower, other.lower);
      EXPECT_DOUBLE_EQ(own.upper, other.symbol == "kp" ? 2.0 : other.upper) << other.symbol;
    }
  }
  EXPECT_THAT(refusal(bound), HasSubstr("expected lower, upper or both, found neither"));
  // Below the usual range, which is from 0.03 to 30 1/s, the other end gives way.
  const auto low = io::loop_structure(with(bound + "upper = '0.001 1/s'\n"), "PI").gains()[3];
  EXPECT_EQ(low.symbol, "kp");
  EXPECT_DOUBLE_EQ(low.upper, 1e-3);
  EXPECT_DOUBLE_EQ(low.lower, 1e-6);
  EXPECT_THAT(
      refusal(bound + "upper = '1 1/s'\nlower = '60 1/min'\n"),
      HasSubstr("tuning.bound[0].upper: expected more than the lower bound '60 1/min', found "
                "'1 1/s'"));
  EXPECT_THAT(refusal(bound + "upper = '2 1/s'\n" + bound + "lower = '1 1/s'\n"),
              HasSubstr("expected one [[tuning.bound]] of each gain"));
  EXPECT_THAT(refusal("[[tuning.bound]]\ngain = 'kq'\nupper = '2'\n"),
              HasSubstr("tuning.bound[0].gain: expected one of"));
}

// A structure that others start from is searched within the same bounds.
TEST(CaseTuning, BoundsOfOnesOwnArePartsToo) {
  const io::Case antenna = with("[[tuning.bound]]\ngain = 'kp'\nupper = '3 1/s'\n");
  const auto missing = design::missing_parts({io::loop_structure(antenna, "DPF+C")},
                                             io::usual_structures_with_lag(antenna));
  ASSERT_EQ(missing.size(), 2U);
  EXPECT_EQ(missing[0], io::loop_structure(antenna, "PI+C"));
  EXPECT_EQ(missing[1], io::loop_structure(antenna, "DPF"));
  EXPECT_THAT(
      design::missing_parts({io::loop_structure(antenna, "DPF"), io::loop_structure(antenna, "PI")},
                            io::usual_structures_with_lag(antenna)),
      testing::IsEmpty());
}

TEST(CaseTuning, ReadsThePresentGainsInTheEngineersUnits) {
  const io::Case antenna = with(tables());
  ASSERT_TRUE(antenna.present_gains.has_value());
  const auto& gains = antenna.present_gains->gains;
  ASSERT_EQ(gains.size(), 13U);
  EXPECT_DOUBLE_EQ(gains[3].value, hertz);
  EXPECT_EQ(gains[3].text, "1 Hz");
  EXPECT_EQ(gains[3].key, "gains.wp");
}

// Of an antenna whose gains nobody knows the structure alone is stated.
TEST(CaseTuning, TakesThePresentStructureWithoutGains) {
  const io::Case antenna = with("[gains]\nstructure = 'LL+N'\n");
  ASSERT_TRUE(antenna.present_gains.has_value());
  EXPECT_TRUE(antenna.present_gains->gains.empty());
  EXPECT_TRUE(io::present_controllers(antenna).empty());
  const control::LoopStructure& present = antenna.present_gains->structure;
  EXPECT_EQ(io::GainUnits(antenna).texts({present, std::vector(present.gains().size(), 1.0)}),
            io::GainUnits().texts({present, std::vector(present.gains().size(), 1.0)}));
  const design::Mission mission = io::mission_of(antenna);
  EXPECT_EQ(mission.present_structure, "LL+N");
  // It is tuned beside the usual ones, once.
  EXPECT_EQ(std::ranges::count(mission.structures.loops, "LL+N", &design::NamedStructure::name), 1);
  EXPECT_EQ(io::mission_of(with("[gains]\nstructure = 'PI'\n")).structures.loops.size() + 1,
            mission.structures.loops.size());
  EXPECT_EQ(io::mission_of(with(tables())).present_structure, "");
  EXPECT_THAT(refusal("[gains]\nstructure = 'PI'\nkr = '1'\n"), HasSubstr("gains.wi: "));
  EXPECT_THAT(refusal("[gains]\nstructure = 'PI'\nkq = '1'\n"),
              HasSubstr("gains.kq: expected one of the keys"));
}

TEST(CaseTuning, WeightsTheSitesWind) {
  const io::Case antenna = with(tables());
  double sum = 0.0, at_12 = 0.0;
  for (const auto& one : antenna.wind->climate) {
    sum += one.weight;
    if (one.speed == 12.0) at_12 += one.weight;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(at_12, 0.1, 1e-9);
  EXPECT_NEAR(design::fraction_of_time(antenna.wind->climate_parts, 20.0), 1.0, 1e-12);
  EXPECT_NEAR(design::fraction_of_time(antenna.wind->climate_parts, 10.0),
              0.9 * std::expm1(-4.0) / std::expm1(-16.0), 1e-12);
  ASSERT_TRUE(antenna.wind->climate_torque_coefficient.has_value());
  EXPECT_NEAR(*antenna.wind->climate_torque_coefficient, std::sqrt(0.75 * 0.01 + 0.25 * 0.04),
              1e-12);
}

TEST(CaseTuning, TakesCasesWithoutAnyOfIt) {
  const io::Case antenna = io::parse_case(EditedCase().text(), "case.toml");
  EXPECT_TRUE(antenna.loops.empty());
  EXPECT_TRUE(antenna.wind->climate.empty());
  EXPECT_TRUE(antenna.tuning->structures.empty());
  EXPECT_FALSE(antenna.present_gains || antenna.goals->gain_margin || antenna.goals->bandwidth);
  EXPECT_EQ(antenna.goals->objective, io::ObjectiveKind::nominal);
}

TEST(CaseTuning, RefusesStructuresThatAreNone) {
  EXPECT_THAT(refusal("kind = \"integral\"", "kind = \"integrator\""),
              HasSubstr("loop[0].block[1].kind: expected one of 'gain', 'integral', 'lag', 'lead', "
                        "'washout', 'notch', 'dead_zone', 'freeze', found 'integrator' (did you "
                        "mean 'integral'?)"));
  EXPECT_THAT(refusal("upper = \"30\"\npresent", "upper = \"0.001\"\npresent"),
              HasSubstr("loop[0].block[0].gain.upper: expected more than the lower bound '0.01', "
                        "found '0.001'"));
  EXPECT_THAT(refusal("\"PI with a second lag\"", "\"DPF+C\""),
              HasSubstr("loop[0].name: expected a name that no usual structure has"));
  EXPECT_THAT(refusal("present = \"0.2\"\n", ""),
              HasSubstr("loop[0].block: expected a present value of all gains or of none, found 5 "
                        "of 6"));
  EXPECT_THAT(refusal("lower = \"0.05 Hz\"", "lower = \"0.05 1/s\""),
              HasSubstr("loop[0].block[2].corner.lower"));
  EXPECT_THAT(
      refusal("[[loop]]\nname = 'x'\n[[loop.block]]\npath = 'rate'\nkind = 'gain'\n"
              "gain = { lower = 1, upper = 2 }\n"),
      HasSubstr("loop[0].block: loop structure 'x': expected one gain block in the position "
                "path, found 0"));
  EXPECT_THAT(refusal("[\"PI\", ", "[\"PID\", "),
              HasSubstr("tuning.structures: expected 'PI with a second lag', PI-0, PI, DPF, LL or "
                        "FULL, with +L (position lag instead of integrals), +D or +F (dead zone or "
                        "freeze of the integral), +N (notch) and +C (compliance compensation) "
                        "behind it as wanted, found 'PID'"));
  EXPECT_THAT(refusal("kT = \"0.0002 rad/(s.N.m)\"", "kT = \"0.0002 rad/s\""),
              HasSubstr("gains.kT: expected a rate per torque"));
  EXPECT_THAT(refusal("wcs = \"1 rad/s\"\n", ""), HasSubstr("gains.wcs: expected"));
  // kp is another gain of the structure and not wp misspelt.
  EXPECT_THAT(refusal("wp = \"1 Hz\"\n", ""),
              AllOf(HasSubstr("gains.wp: expected a bandwidth"), Not(HasSubstr("misspelt"))));
}

TEST(CaseTuning, RefusesEmptyRangesAndClimates) {
  EXPECT_THAT(refusal("upper = \"105 %\"", "upper = \"90 %\""),
              HasSubstr("ensemble.structure_frequency.upper: expected at least the lower end "
                        "'95 %', found '90 %'"));
  EXPECT_THAT(
      refusal("speed = \"12 m/s\"", "speed = \"12 m/s\"\nscale = \"3 m/s\""),
      HasSubstr(
          "wind.climate[1].speed: expected either a speed, or of a Weibull distribution scale "
          "and shape, or its mean, exceeded and exceeded_share, found speed and "
          "scale"));
  EXPECT_THAT(refusal("shape = \"2\"\n", ""),
              HasSubstr("wind.climate[0].shape: expected scale, shape and highest together"));
  EXPECT_THAT(refusal("torque_coefficient = \"0.20\"", "azimuth = \"10 deg\""),
              HasSubstr("wind.attitude[1].torque_coefficient: expected a torque_coefficient"));
  EXPECT_THAT(refusal("probability = \"75 %\"", "probability = \"0\""),
              HasSubstr("wind.attitude[0].probability"));
}

std::string edited_refusal(const std::string& old, const std::string& other) {
  return refusal_of(EditedCase().replace(old, other).text());
}

const std::string peak_line = "[goals]\n";

TEST(CaseGoals, ReadsGoalsAtEachBreakAndOfTheEnsemble) {
  const io::Case antenna = io::parse_case(
      EditedCase()
          .replace(peak_line, peak_line +
                                  "sensitivity_peak_valve = \"1.8\"\ngain_margin = \"6 dB\"\n"
                                  "phase_margin = \"30 deg\"\nbandwidth = \"0.05 Hz\"\n"
                                  "crest_factor = \"3\"\nbeam_rms = \"2 mdeg\"\n"
                                  "limit_cycle_amplitude = \"0.3 mdeg\"\n"
                                  "static_encoder_error = \"0.05 mdeg\"\n"
                                  "soft_goal = \"quantile\"\nquantile = \"90 %\"\n")
          .text(),
      "case.toml");
  const io::GoalsEntry& goals = *antenna.goals;
  EXPECT_FALSE(goals.peak_at_break[0].has_value());
  ASSERT_TRUE(goals.peak_at_break[1] && goals.gain_margin && goals.phase_margin &&
              goals.bandwidth && goals.crest_factor && goals.boresight_rms);
  EXPECT_DOUBLE_EQ(goals.peak_at_break[1]->value, 1.8);
  EXPECT_DOUBLE_EQ(goals.phase_margin->value, std::numbers::pi / 6.0);
  EXPECT_DOUBLE_EQ(goals.bandwidth->value, 0.05 * hertz);
  EXPECT_EQ(goals.objective, io::ObjectiveKind::quantile);
  EXPECT_DOUBLE_EQ(goals.quantile, 0.9);
  const double amplitude = mission_of(antenna).limit_cycle_amplitude.value_or(0.0);
  EXPECT_NEAR(amplitude, 0.3e-3 * std::numbers::pi / 180.0, 1e-18);
  EXPECT_EQ(allowed_limit_cycle(mission_of(antenna)), amplitude);
  const auto stated = mission_of(antenna).stated_constraints;
  EXPECT_NEAR(stated.static_encoder_error.value_or(0.0), 0.05e-3 * std::numbers::pi / 180.0, 1e-18);
}

TEST(CaseGoals, RefusesAQuantileOfNothing) {
  EXPECT_THAT(edited_refusal(peak_line, peak_line + "quantile = \"90 %\"\n"),
              HasSubstr("goals.quantile: expected it with the soft_goal 'quantile' only, found it "
                        "with 'nominal'"));
  EXPECT_THAT(edited_refusal(peak_line, peak_line + "soft_goal = \"best\"\n"),
              HasSubstr("goals.soft_goal: expected one of 'nominal', 'expected', 'worst_case'"));
}

TEST(CaseGoals, AreChangedByKeyAndValue) {
  io::GoalsEntry goals = *io::parse_case(EditedCase().text(), "case.toml").goals;
  io::change_goals(goals,
                   {"sensitivity_peak=1.7", "valve_effort=0.4 rad/s", "soft_goal=worst_case"});
  EXPECT_DOUBLE_EQ(goals.sensitivity_peak.value, 1.7);
  EXPECT_DOUBLE_EQ(goals.control_effort.value, 0.4);
  EXPECT_EQ(goals.objective, io::ObjectiveKind::worst_case);
  const auto message = [&](const std::string& change) {
    try {
      io::change_goals(goals, {change});
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("peak=2"), HasSubstr("--goal:1:1: peak: expected one of the keys"));
  EXPECT_THAT(message("sensitivity_peak=0.5"), HasSubstr("--goal:1:"));
  EXPECT_THAT(message("valve_effort=0.4"), HasSubstr("valve_effort: expected an angular rate"));
  for (const std::string wrong : {"sensitivity_peak", "=2", "a.b=2", "valve_effort=1' \n x = '"}) {
    EXPECT_THAT(message(wrong), HasSubstr("--goal: expected KEY=VALUE")) << wrong;
  }
  EXPECT_THAT(message("highest_frequency=0.5 Hz"), HasSubstr("--goal:1:"));
}

TEST(CasePointing, TakesTheFeedsTaperForTheBeamwidth) {
  const std::string stated =
      "frequency = { value = \"32 GHz\", basis = \"published\", source = \"DSN Ka-band downlink\" "
      "}\n"
      "beamwidth_factor = { value = \"61 deg\", basis = \"inferred\", source = \"from published "
      "70-m "
      "and 34-m beamwidths\" }";
  const auto factor = [&](const std::string& keys) {
    const io::Case antenna = io::parse_case(
        EditedCase().replace(stated, "frequency = \"32 GHz\"\n" + keys).text(), "case.toml");
    return antenna.bands[1].beamwidth_factor.value * 180.0 / std::numbers::pi;
  };
  EXPECT_NEAR(factor("edge_taper = \"0 dB\""), 58.957, 1e-3);
  EXPECT_GT(factor("edge_taper = \"12 dB\""), 65.0);
  EXPECT_GT(factor("edge_taper = \"12 dB\"\nillumination = \"gaussian\""), 64.0);
  EXPECT_NE(factor("edge_taper = \"12 dB\"\nillumination_exponent = \"2\""),
            factor("edge_taper = \"12 dB\""));
  // 61 deg of 70 m at 32 GHz.
  EXPECT_NEAR(factor("beamwidth = \"8.163991 mdeg\""), 61.0, 1e-3);
  const io::Case both = io::read_case(case_path("dss14-70m"));
  EXPECT_DOUBLE_EQ(factor("beamwidth_like = \"X\"") * std::numbers::pi / 180.0,
                   both.bands[0].beamwidth_factor.value);
  const auto message = [&](const std::string& keys) {
    return edited_refusal(stated, "frequency = \"32 GHz\"\n" + keys);
  };
  EXPECT_THAT(message(""),
              HasSubstr("pointing.band[1].beamwidth_factor: expected either beamwidth, "
                        "beamwidth_factor, beamwidth_like or edge_taper, found none"));
  EXPECT_THAT(message("beamwidth_like = \"Ka\""),
              HasSubstr("pointing.band[1].beamwidth_like: expected the name of a band listed "
                        "above, found 'Ka'"));
  EXPECT_THAT(message("beamwidth_factor = \"61 deg\"\nbeamwidth_like = \"X\""),
              HasSubstr("found several"));
  EXPECT_THAT(message("beamwidth_factor = \"61 deg\"\nedge_taper = \"9 dB\""),
              HasSubstr("found several"));
  EXPECT_THAT(message("beamwidth_factor = \"61 deg\"\nillumination = \"gaussian\""),
              HasSubstr("expected it beside edge_taper only"));
  EXPECT_THAT(message("beamwidth = \"0.2 deg\""),
              HasSubstr("pointing.band[1].beamwidth: expected 3.83 to 15.3 mdeg"));
  EXPECT_THAT(message("edge_taper = \"9 dB\"\nillumination = \"gaussian\"\n"
                      "illumination_exponent = \"2\""),
              HasSubstr("expected it with the illumination 'parabola' only"));
}

}  // namespace
}  // namespace boresight::app
