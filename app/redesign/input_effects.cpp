#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/input_effects.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/io/case/guessed_shares.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::app {
namespace {

constexpr double unstated_share = 0.1;

// A number as the case states it, and where it works.
struct Input {
  const io::Quantity* stated = nullptr;
  double* value = nullptr;
};

void add(std::vector<io::Quantity*>& places, std::optional<io::Quantity>& quantity) {
  if (quantity) places.push_back(&*quantity);
}

// Whether the case states the gear train's stiffness in the place of the locked-rotor frequency.
bool frequency_by_stiffness(const io::StructureEntry& structure) {
  return structure.gear_stiffness &&
         structure.locked_rotor_frequency.key == structure.gear_stiffness->key;
}

// Those that a case keeps as quantities, in its order.
std::vector<io::Quantity*> quantities_of(io::Case& c) {
  std::vector<io::Quantity*> places{&c.antenna.dish_diameter,   &c.antenna.inertia,
                                    &c.motor.inertia,           &c.motor.displacement,
                                    &c.motor.torque_efficiency, &c.motor.volumetric_efficiency};
  add(places, c.oil.bulk_modulus);
  if (!c.oil.bulk_modulus) {
    add(places, c.oil.density);
    for (auto& line : c.oil.lines) {
      places.push_back(&line.length);
      places.push_back(&line.slosh_frequency);
    }
  }
  places.insert(places.end(),
                {&c.oil.volume_1, &c.oil.volume_2, &c.drive.leakage_rate, &c.drive.viscous_friction,
                 &c.drive.valve_frequency, &c.drive.valve_damping});
  io::StructureEntry& structure = c.structure;
  if (structure.gear_stiffness && frequency_by_stiffness(structure)) {
    places.push_back(&*structure.gear_stiffness);
  } else {
    places.push_back(&structure.locked_rotor_frequency);
  }
  places.insert(places.end(), {&structure.gear_damping_ratio, &structure.bull_gear_wind_fraction,
                               &structure.bull_gear_beam_weight});
  for (auto& mode : structure.modes) {
    places.insert(places.end(), {&mode.frequency, &mode.damping_ratio, &mode.inertia_fraction,
                                 &mode.wind_fraction, &mode.beam_weight});
    add(places, mode.effective_fraction);
  }
  places.insert(places.end(), {&c.sensors.encoder_noise, &c.sensors.tachometer_noise,
                               &c.sensors.noise_bandwidth, &c.sensors.tachometer_frequency});
  add(places, c.sensors.torque_noise);
  places.insert(places.end(), {&c.controller_delay, &c.wind.air_density, &c.wind.torque_coefficient,
                               &c.wind.gradient_coefficient, &c.wind.coherence_decay});
  // What another number of the case gives has no key of its own, and what records gave no text.
  std::erase_if(places,
                [](const io::Quantity* one) { return one->key.empty() || one->text.empty(); });
  return places;
}

// With the gusts' strength and length, which a case keeps as the plant takes them.
std::vector<Input> linear_inputs(io::Case& c) {
  std::vector<Input> inputs;
  for (io::Quantity* quantity : quantities_of(c)) inputs.push_back({quantity, &quantity->value});
  plant::GustSpectrum& gusts = c.wind.gusts;
  for (const auto& [key, value] :
       {std::pair{"wind.surface_drag", &gusts.surface_drag},
        std::pair{"wind.turbulence_intensity", &gusts.turbulence_intensity},
        std::pair{"wind.length_scale", &gusts.length_scale}}) {
    const auto stated = std::ranges::find(c.quantities, std::string_view(key), &io::Quantity::key);
    if (stated != c.quantities.end()) inputs.push_back({&*stated, value});
  }
  return inputs;
}

// A share of wind or beam, and of the inertia that the same body has.
struct Share {
  double* value;
  double inertia_fraction;
};

// Bull gear's and modes' shares of wind and beam, each of which sum to 1.
std::array<std::vector<Share>, 2> shares(io::StructureEntry& structure) {
  double bull_gear = 1.0;
  for (const auto& mode : structure.modes) bull_gear -= mode.inertia_fraction.value;
  std::array<std::vector<Share>, 2> groups{{{{&structure.bull_gear_wind_fraction.value, bull_gear}},
                                            {{&structure.bull_gear_beam_weight.value, bull_gear}}}};
  for (auto& mode : structure.modes) {
    groups[0].push_back({&mode.wind_fraction.value, mode.inertia_fraction.value});
    groups[1].push_back({&mode.beam_weight.value, mode.inertia_fraction.value});
  }
  return groups;
}

// What a share gains the others lose in proportion to what they have; what it loses goes to their
// inertias, as little of the wind acts on a light body that had little of it.
void make_room(std::vector<Share>& group, const double* moved, double by) {
  double others = 0.0, inertia = 0.0;
  for (const Share& one : group) {
    if (one.value == moved) continue;
    others += *one.value;
    inertia += one.inertia_fraction;
  }
  for (const Share& one : group) {
    if (one.value == moved) continue;
    if (by < 0.0 && inertia > 0.0) {
      *one.value -= by * one.inertia_fraction / inertia;
    } else if (others != 0.0) {  // else nothing can give way: a sum other than 1 is no antenna
      *one.value *= (others - by) / others;
    }
  }
}

// Of the body whose share of wind or beam this is; none of any other number.
std::optional<double> inertia_fraction_of(const io::StructureEntry& structure,
                                          const io::Quantity& share) {
  double bull_gear = 1.0;
  for (const auto& mode : structure.modes) {
    if (&share == &mode.wind_fraction || &share == &mode.beam_weight) {
      return mode.inertia_fraction.value;
    }
    bull_gear -= mode.inertia_fraction.value;
  }
  const bool of_bull_gear =
      &share == &structure.bull_gear_wind_fraction || &share == &structure.bull_gear_beam_weight;
  return of_bull_gear ? std::optional(bull_gear) : std::nullopt;
}

// Of a mode's share: an entry of frequencies with the motors held has shares of another mode.
std::string mode_of(const io::StructureEntry& structure, const io::Quantity& share) {
  for (std::size_t i = 0; i < structure.modes.size(); ++i) {
    const auto& mode = structure.modes[i];
    if (&share != &mode.wind_fraction && &share != &mode.beam_weight) continue;
    return fmt::format("the mode of {:.3g} Hz{}",
                       io::structure_specification(structure).modes.at(i).frequency,
                       structure.motors_held ? " with the bull gear held" : "");
  }
  return "";
}

// A guess of a share may as well be the inertia fraction, and as wrong the other way; by half of it
// where it is that fraction. One above 1, which balances a negative one, is as much as that makes
// it.
std::pair<double, double> guessed_range(double share, double inertia_fraction) {
  constexpr double half = 0.5;
  const double by = std::max(std::abs(share - inertia_fraction), half * share);
  constexpr double rounding = 1e-9;
  const double lower = share - by;
  return {lower > rounding ? lower : 0.0, std::max(std::min(share + by, 1.0), share)};
}

// How far a number is moved; by nothing where nothing says how far.
InputEffect planned(const io::Case& antenna, const io::Quantity& stated) {
  InputEffect effect;
  effect.quantity = stated;
  effect.mode = mode_of(antenna.structure, stated);
  effect.unstated = is_unbounded_guess(stated);
  const auto fraction = inertia_fraction_of(antenna.structure, stated);
  if (fraction && is_guessed_share(stated)) {
    effect.range = guessed_range(stated.value, *fraction);
    effect.moved_by =
        std::max(stated.value - effect.range->first, effect.range->second - stated.value);
  } else if (stated.value != 0.0) {
    effect.moved_by =
        effect.unstated ? unstated_share * std::abs(stated.value) : stated.standard_uncertainty;
  }
  return effect;
}

void move(io::Case& antenna, std::size_t which, double by) {
  const Input input = linear_inputs(antenna)[which];
  double* moved = input.value;
  // A number that works converted, as of a wind mast, moves by the same share.
  if (input.stated->value != 0.0) by *= *moved / input.stated->value;
  for (auto& group : shares(antenna.structure)) {
    if (std::ranges::find(group, moved, &Share::value) != group.end()) make_room(group, moved, by);
  }
  *moved += by;
  io::StructureEntry& structure = antenna.structure;
  if (structure.gear_stiffness && moved == &structure.gear_stiffness->value) {
    structure.locked_rotor_frequency.value = io::locked_rotor_frequency_for(
        io::structure_specification(structure), *moved / antenna.antenna.inertia.value);
  }
}

// Of the oil on both sides (Pa/m3): a leakage flow makes a leakage rate in proportion to it.
double pressure_per_volume(const io::Case& antenna) {
  return bulk_modulus(antenna) *
         (1.0 / antenna.oil.volume_1.value + 1.0 / antenna.oil.volume_2.value);
}

// Not a number where the loop is unstable; nothing where no antenna can be made of the case.
std::optional<double> held_rms(const io::Case& antenna, const control::ControlLaw& law,
                               const design::HardGoals& goals) {
  try {
    const design::TrackingProblem problem = make_problem(antenna);
    return design::judge(problem, {{"moved", problem.plant}}, law, goals, 1)
        .members.front()
        .beam_rms;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

std::string range_text(const InputEffect& effect) {
  const auto mdeg = [](double rms) {
    return std::isfinite(rms) ? fmt::format("{:.3f}", rms / millidegree) : std::string("unstable");
  };
  const double share = 100.0 * effect.moved_by / std::abs(effect.quantity.value);
  const std::string over =
      effect.range ? fmt::format("{:.3g} to {:.3g}", effect.range->first, effect.range->second)
                   : fmt::format("+-{:.3g} %", share);
  return fmt::format("{}{}{} ({} to {} mdeg over {})", effect.quantity.key,
                     effect.mode.empty() ? "" : " of ", effect.mode, mdeg(effect.low_rms),
                     mdeg(effect.high_rms), over);
}

}  // namespace

double telling_friction(const std::optional<TimeDomainSection>& time_domain, double rms) {
  if (!time_domain) return 0.0;
  for (const auto& one : time_domain->result.wind.influences) {
    if (one.influence != design::Influence::friction || !std::isfinite(one.difference)) continue;
    if (one.difference > telling_change * rms) return one.difference;
  }
  return 0.0;
}

double InputEffect::change(double rms) const {
  if (!std::isfinite(low_rms) || !std::isfinite(high_rms)) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(std::abs(low_rms - rms), std::abs(high_rms - rms)) / rms;
}

std::vector<InputEffect> input_effects(const io::Case& antenna, const control::ControlLaw& law,
                                       const design::HardGoals& goals, double rms, std::size_t most,
                                       unsigned threads) {
  io::Case whole = antenna;
  std::vector<InputEffect> effects;
  std::vector<std::size_t> which;
  const auto inputs = linear_inputs(whole);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    InputEffect effect = planned(whole, *inputs[i].stated);
    if (!(effect.moved_by > 0.0)) continue;
    effects.push_back(std::move(effect));
    which.push_back(i);
  }
  std::vector<std::optional<double>> held(2 * effects.size());
  numerics::for_each_index(held.size(), threads, [&](std::size_t job) {
    const InputEffect& effect = effects[job / 2];
    const bool lower = job % 2 == 0;
    double by = lower ? -effect.moved_by : effect.moved_by;
    if (effect.range) {
      by = (lower ? effect.range->first : effect.range->second) - effect.quantity.value;
    }
    io::Case moved = antenna;
    try {
      move(moved, which[job / 2], by);
    } catch (const InvalidInput&) {
      return;
    }
    if (antenna.drive.leakage_by_flow) {
      moved.drive.leakage_rate.value *= pressure_per_volume(moved) / pressure_per_volume(antenna);
    }
    held[job] = held_rms(moved, law, goals);
  });
  std::vector<InputEffect> kept;
  constexpr double worth_a_row = 1e-3;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const auto &low = held[2 * i], &high = held[2 * i + 1];
    if (!low || !high) continue;
    effects[i].low_rms = *low;
    effects[i].high_rms = *high;
    if (effects[i].change(rms) >= worth_a_row) kept.push_back(std::move(effects[i]));
  }
  effects = std::move(kept);
  std::ranges::stable_sort(effects, [&](const InputEffect& x, const InputEffect& y) {
    return x.change(rms) > y.change(rms);
  });
  if (effects.size() > most) effects.resize(most);
  return effects;
}

std::string measure_first(const std::vector<InputEffect>& effects, double rms,
                          const std::optional<TimeDomainSection>& time_domain) {
  constexpr std::size_t most = 3;
  std::vector<std::string> named;
  for (const auto& effect : effects) {
    if (named.size() == most || effect.change(rms) < negligible_change) break;
    named.push_back(range_text(effect));
  }
  std::vector<std::string> sentences;
  if (!named.empty()) {
    sentences.push_back(
        fmt::format("Of the numbers of the case, the rms hangs most on {}: measure {} first.",
                    fmt::join(named, ", "), named.size() == 1 ? "that" : "those"));
  }
  if (const double friction = telling_friction(time_domain, rms); friction > 0.0) {
    sentences.push_back(fmt::format(
        "Friction, which no linear rms knows, is worth {:.3f} mdeg of the simulated: measure the "
        "friction curve about the tracking rate, and what the bristles' stiffness rests on{}.",
        friction / millidegree, named.empty() ? "" : ", as well"));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace boresight::app
