#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/audit/antenna_readings.hpp>
#include <boresight/io/audit/resonance_verdict.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::io {
namespace {

using Changes = std::vector<plant::AntennaChange>;

class Readings {
 public:
  explicit Readings(const Case& stated)
      : stated_(stated), own_(antenna_of(stated)), motors_(plant::motor_inertia(own_)) {}

  double motor_inertia() const { return motors_; }
  // Motors and gear train.
  double fixed_inertia() const { return motors_ + plant::gear_train_inertia(own_); }

  AntennaReading& add(ReadingKind kind, std::string name, const plant::Antenna& other) {
    const auto plant = linear_plant(other);
    AntennaReading reading;
    reading.kind = kind;
    reading.name = std::move(name);
    reading.antenna = other;
    reading.oil_stiffness = plant.drive.oil_stiffness;
    reading.reflected_inertia = plant::reflected_inertia(plant);
    reading.motor_to_load_ratio =
        plant::motor_to_load_ratio(plant::motor_inertia(other), reading.reflected_inertia);
    if (stated_.resonance->frequency) {
      reading.resonance = resonating_mode(stated_, plant).frequency;
    }
    readings_.push_back(std::move(reading));
    return readings_.back();
  }

  AntennaReading& add(ReadingKind kind, std::string name, const Changes& changes) {
    return add(kind, std::move(name), changed(own_, changes));
  }

  // The inertia a test found, with motors and gear train kept and the antenna taking the rest.
  void add_test(ReadingKind kind, std::string name, double found, double stiffness) {
    const TestedInertia tested{found, fixed_inertia(), antenna_inertia(stated_)};
    constexpr double minimum = 0.05;
    if (tested.left() > minimum * tested.stated) {
      AntennaReading& reading = add(kind, std::move(name),
                                    {plant::set_to("at_shaft.antenna_inertia", tested.left()),
                                     plant::set_to("at_shaft.oil_stiffness", stiffness)});
      reading.contradicts = true;
      reading.tested = tested;
      return;
    }
    AntennaReading impossible;
    impossible.kind = kind;
    impossible.name = std::move(name);
    impossible.oil_stiffness = stiffness;
    impossible.reflected_inertia = found;
    impossible.motor_to_load_ratio = plant::motor_to_load_ratio(motors_, found);
    impossible.contradicts = true;
    impossible.tested = tested;
    readings_.push_back(std::move(impossible));
  }

  std::size_t count() const { return readings_.size(); }
  // Of the readings from the `first` on: the frequency (Hz) that they are made for.
  void made_for(double frequency, std::size_t first) {
    for (std::size_t i = first; i < readings_.size(); ++i) {
      readings_[i].wanted_frequency = frequency;
    }
  }

  std::vector<AntennaReading> take() { return std::move(readings_); }

 private:
  const Case& stated_;
  plant::Antenna own_;
  double motors_ = 0.0;
  std::vector<AntennaReading> readings_;
};

// The oil by which the flexible antenna resonates at that frequency (Hz), if that is other oil than
// the case's.
void add_flexible_resonance(const Case& antenna, double frequency, Readings& readings) {
  constexpr double same_oil = 0.01;
  const auto modulus = bulk_modulus_for(antenna, frequency);
  if (!modulus) return;
  const double factor = *modulus / bulk_modulus(antenna);
  if (std::abs(factor - 1.0) <= same_oil) return;
  AntennaReading& reading =
      readings.add(ReadingKind::oil_by_resonance, "oil for the resonance of the flexible antenna",
                   bulk_modulus_times(antenna, factor));
  reading.contradicts = true;
  reading.bulk_modulus = *modulus;
}

// By a resonance at that frequency (Hz); `other`: the oil spring by the other convention.
void add_resonance(const Case& antenna, double frequency, double other, Readings& readings) {
  add_flexible_resonance(antenna, frequency, readings);
  if (!rings_as_rigid(antenna)) return;
  const double own = oil_stiffness(antenna);
  const double inertia = readings.fixed_inertia() + antenna_inertia(antenna);
  const double found = plant::inertia_from_resonance(own, frequency);
  // The oil spring scales with the inertia on it, at one frequency.
  const double factor = inertia / found;
  AntennaReading& softer =
      readings.add(ReadingKind::stiffness_by_resonance, "masses right, stiffness from resonance",
                   bulk_modulus_times(antenna, factor));
  softer.contradicts = true;
  softer.factor = factor;
  readings.add_test(ReadingKind::inertia_by_resonance, "stiffness right, inertia from resonance",
                    found, own);
  readings.add_test(ReadingKind::inertia_by_resonance,
                    antenna.oil->efficiency_in_stiffness
                        ? "inertia from resonance, no efficiencies"
                        : "inertia from resonance, with efficiencies",
                    plant::inertia_from_resonance(other, frequency), other);
  const double scale = found / inertia, motors = readings.motor_inertia();
  // The gear train takes what the scaled sum leaves beside the motors, so that it is that sum.
  AntennaReading& scaled =
      readings.add(ReadingKind::masses_by_resonance, "stiffness right, all masses scaled",
                   {plant::scaled_by("at_shaft.antenna_inertia", scale),
                    plant::scaled_by("at_shaft.motor_inertia", scale),
                    plant::set_to("at_shaft.gear_train_inertia",
                                  scale * readings.fixed_inertia() - scale * motors)});
  scaled.contradicts = true;
  scaled.factor = scale;
}

}  // namespace

std::vector<AntennaReading> antenna_readings(const Case& antenna) {
  Readings readings(antenna);
  readings.add(ReadingKind::as_stated, "reference", Changes{});
  for (const auto& alternative : antenna.antenna->alternatives) {
    AntennaReading& reading =
        readings.add(ReadingKind::other_inertia, "antenna of " + alternative.name,
                     changes_of(antenna, alternative));
    (alternative.keeps_springs ? reading.other_attitude : reading.contradicts) = true;
  }
  const bool efficient = antenna.oil->efficiency_in_stiffness;
  const double other = oil_stiffness(
      antenna, efficient ? plant::EfficiencyInStiffness::none : plant::EfficiencyInStiffness::both);
  // A convention changes no oil, and so no leakage rate.
  readings.add(ReadingKind::oil_convention,
               efficient ? "stiffness without efficiencies" : "stiffness with efficiencies",
               Changes{plant::set_to("at_shaft.oil_stiffness", other)});
  const auto antennas = antennas_of(antenna);
  for (std::size_t i = 1; i < antennas.size(); ++i) {
    const double spring = linear_plant(antennas[i]).structure.gear_stiffness;
    readings.add(ReadingKind::gear_spring,
                 fmt::format("antenna of gear spring {:.3g} N.m/rad", spring), antennas[i]);
  }
  for (const auto place : other_guesses) {
    if (!moves_guessed_fractions(*antenna.structure, place)) continue;
    AntennaReading& reading =
        readings.add(ReadingKind::guessed_fractions, std::string(to_string(place)),
                     guessed_fraction_changes(*antenna.structure, place));
    reading.other_fractions = true;
    reading.fractions = place;
  }
  if (antenna.resonance->frequency) {
    const std::size_t first = readings.count();
    const double frequency = antenna.resonance->frequency->value;
    add_resonance(antenna, frequency, other, readings);
    readings.made_for(frequency, first);
  }
  for (const auto& impulse : antenna.impulse_results) {
    readings.add_test(ReadingKind::inertia_by_impulse,
                      "inertia from impulse, " + impulse.name + " friction",
                      impulse.reflected_inertia.value, oil_stiffness(antenna));
  }
  return readings.take();
}

}  // namespace boresight::io
