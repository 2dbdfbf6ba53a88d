#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/guessed_fractions.hpp>
#include <boresight/io/case/movable_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/plant/wind/gust_spectrum.hpp>

namespace boresight::io {
namespace {

constexpr double unstated_fraction = 0.1;

// A number as the case states it, and where it works.
struct Input {
  const Quantity* stated = nullptr;
  double* value = nullptr;
};

void add(std::vector<Quantity*>& places, std::optional<Quantity>& quantity) {
  if (quantity) places.push_back(&*quantity);
}

// Whether the case states the gear train's stiffness instead of the locked-rotor frequency.
bool frequency_by_stiffness(const StructureEntry& structure) {
  return structure.gear_stiffness &&
         structure.locked_rotor_frequency.key == structure.gear_stiffness->key;
}

// Those that a case keeps as quantities, in its order.
std::vector<Quantity*> quantities_of(Case& c) {
  std::vector<Quantity*> places{&c.antenna->dish_diameter,   &c.antenna->inertia,
                                &c.motor->inertia,           &c.motor->displacement,
                                &c.motor->torque_efficiency, &c.motor->volumetric_efficiency};
  add(places, c.oil->bulk_modulus);
  if (!c.oil->bulk_modulus) {
    add(places, c.oil->density);
    for (auto& line : c.oil->lines) {
      places.push_back(&line.length);
      places.push_back(&line.slosh_frequency);
    }
  }
  places.insert(places.end(),
                {&c.oil->volume_1, &c.oil->volume_2, &c.drive->leakage_rate,
                 &c.drive->viscous_friction, &c.drive->valve_frequency, &c.drive->valve_damping});
  StructureEntry& structure = *c.structure;
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
  places.insert(places.end(), {&c.sensors->encoder_noise, &c.sensors->tachometer_noise,
                               &c.sensors->noise_bandwidth, &c.sensors->tachometer_frequency});
  add(places, c.sensors->torque_noise);
  places.insert(places.end(),
                {&c.controller->delay, &c.wind->air_density, &c.wind->torque_coefficient,
                 &c.wind->gradient_coefficient, &c.wind->coherence_decay});
  // What another number of the case gives has no key of its own, and what records gave no text.
  std::erase_if(places, [](const Quantity* one) { return one->key.empty() || one->text.empty(); });
  return places;
}

// With the gusts' strength and length, which a case keeps as the plant takes them.
std::vector<Input> linear_inputs(Case& c) {
  std::vector<Input> inputs;
  for (Quantity* quantity : quantities_of(c)) inputs.push_back({quantity, &quantity->value});
  plant::GustSpectrum& gusts = c.wind->gusts;
  for (const auto& [key, value] :
       {std::pair{"wind.surface_drag", &gusts.surface_drag},
        std::pair{"wind.turbulence_intensity", &gusts.turbulence_intensity},
        std::pair{"wind.length_scale", &gusts.length_scale}}) {
    const auto stated = std::ranges::find(c.quantities, std::string_view(key), &Quantity::key);
    if (stated != c.quantities.end()) inputs.push_back({&*stated, value});
  }
  return inputs;
}

// A fraction of wind or beam, and of the inertia that the same body has.
struct Fraction {
  double* value;
  double inertia_fraction;
};

// Bull gear's and modes' fractions of wind and beam, each of which sum to 1.
std::array<std::vector<Fraction>, 2> fractions(StructureEntry& structure) {
  double bull_gear = 1.0;
  for (const auto& mode : structure.modes) bull_gear -= mode.inertia_fraction.value;
  std::array<std::vector<Fraction>, 2> groups{
      {{{&structure.bull_gear_wind_fraction.value, bull_gear}},
       {{&structure.bull_gear_beam_weight.value, bull_gear}}}};
  for (auto& mode : structure.modes) {
    groups[0].push_back({&mode.wind_fraction.value, mode.inertia_fraction.value});
    groups[1].push_back({&mode.beam_weight.value, mode.inertia_fraction.value});
  }
  return groups;
}

// What a fraction gains the others lose in proportion to what they have; what it loses goes to
// their inertias, as little of the wind acts on a light body that had little of it.
void make_room(std::vector<Fraction>& group, const double* moved, double by) {
  double others = 0.0, inertia = 0.0;
  for (const Fraction& one : group) {
    if (one.value == moved) continue;
    others += *one.value;
    inertia += one.inertia_fraction;
  }
  for (const Fraction& one : group) {
    if (one.value == moved) continue;
    if (by < 0.0 && inertia > 0.0) {
      *one.value -= by * one.inertia_fraction / inertia;
    } else if (others != 0.0) {  // else nothing can give way: a sum other than 1 is no antenna
      *one.value *= (others - by) / others;
    }
  }
}

// Of the body whose fraction of wind or beam this is; none of any other number.
std::optional<double> inertia_fraction_of(const StructureEntry& structure,
                                          const Quantity& fraction) {
  double bull_gear = 1.0;
  for (const auto& mode : structure.modes) {
    if (&fraction == &mode.wind_fraction || &fraction == &mode.beam_weight) {
      return mode.inertia_fraction.value;
    }
    bull_gear -= mode.inertia_fraction.value;
  }
  const bool of_bull_gear = &fraction == &structure.bull_gear_wind_fraction ||
                            &fraction == &structure.bull_gear_beam_weight;
  return of_bull_gear ? std::optional(bull_gear) : std::nullopt;
}

// Of a mode's fraction: an entry of frequencies with the motors held has fractions of another mode.
std::optional<std::size_t> mode_of(const StructureEntry& structure, const Quantity& fraction) {
  for (std::size_t i = 0; i < structure.modes.size(); ++i) {
    const auto& mode = structure.modes[i];
    if (&fraction == &mode.wind_fraction || &fraction == &mode.beam_weight) return i;
  }
  return std::nullopt;
}

// A guess of a fraction may as well be the inertia fraction, and as wrong the other way; by half of
// it where it is that fraction. One above 1, which balances a negative one, is as much as that
// makes it.
std::pair<double, double> guessed_range(double fraction, double inertia_fraction) {
  constexpr double half = 0.5;
  const double by = std::max(std::abs(fraction - inertia_fraction), half * fraction);
  constexpr double rounding = 1e-9;
  const double lower = fraction - by;
  return {lower > rounding ? lower : 0.0, std::max(std::min(fraction + by, 1.0), fraction)};
}

// How far a number is moved; by nothing where nothing says how far.
MovableNumber planned(const Case& antenna, const Quantity& stated) {
  MovableNumber number;
  number.quantity = stated;
  number.fraction_of_mode = mode_of(*antenna.structure, stated);
  number.unstated = is_unbounded_guess(stated);
  const auto fraction = inertia_fraction_of(*antenna.structure, stated);
  if (fraction && is_guessed_fraction(stated)) {
    number.range = guessed_range(stated.value, *fraction);
    number.moved_by =
        std::max(stated.value - number.range->first, number.range->second - stated.value);
  } else if (stated.value != 0.0) {
    number.moved_by =
        number.unstated ? unstated_fraction * std::abs(stated.value) : stated.standard_uncertainty;
  }
  return number;
}

void move(Case& antenna, std::size_t which, double by) {
  const Input input = linear_inputs(antenna)[which];
  double* moved = input.value;
  // A number that works converted, as of a wind mast, moves by the same fraction.
  if (input.stated->value != 0.0) by *= *moved / input.stated->value;
  for (auto& group : fractions(*antenna.structure)) {
    if (std::ranges::find(group, moved, &Fraction::value) != group.end())
      make_room(group, moved, by);
  }
  *moved += by;
  StructureEntry& structure = *antenna.structure;
  if (structure.gear_stiffness && moved == &structure.gear_stiffness->value) {
    structure.locked_rotor_frequency.value = locked_rotor_frequency_for(
        structure_specification(structure), *moved / antenna.antenna->inertia.value);
  }
}

// Of the oil on both sides (Pa/m3): a leakage flow makes a leakage rate in proportion to it.
double pressure_per_volume(const Case& antenna) {
  return bulk_modulus(antenna) *
         (1.0 / antenna.oil->volume_1.value + 1.0 / antenna.oil->volume_2.value);
}

}  // namespace

std::vector<MovableNumber> movable_numbers(const Case& antenna) {
  Case whole = antenna;
  std::vector<MovableNumber> numbers;
  const auto inputs = linear_inputs(whole);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    MovableNumber number = planned(whole, *inputs[i].stated);
    if (!(number.moved_by > 0.0)) continue;
    number.place = i;
    numbers.push_back(std::move(number));
  }
  return numbers;
}

Case moved(const Case& antenna, const MovableNumber& number, bool upwards) {
  double by = upwards ? number.moved_by : -number.moved_by;
  if (number.range) {
    by = (upwards ? number.range->second : number.range->first) - number.quantity.value;
  }
  Case result = antenna;
  move(result, number.place, by);
  if (antenna.drive->leakage_by_flow) {
    result.drive->leakage_rate.value *= pressure_per_volume(result) / pressure_per_volume(antenna);
  }
  return result;
}

}  // namespace boresight::io
