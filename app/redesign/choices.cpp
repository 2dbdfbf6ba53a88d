#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/redesign/choices.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/guessed_shares.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::app {
namespace {

using Changes = std::vector<plant::AntennaChange>;

class Choices {
 public:
  explicit Choices(const io::Case& antenna)
      : antenna_(antenna), own_(antenna_of(antenna)), motors_(plant::motor_inertia(own_)) {}

  double motor_inertia() const { return motors_; }
  // Motors and gear train.
  double fixed_inertia() const { return motors_ + gear_train_inertia(own_); }

  // Of the numbers that the case states, or a convention or solution of the reckoning.
  void add(std::string name, std::string says, const plant::Antenna& other) {
    const auto plant = linear_plant(other);
    const double inertia = plant::reflected_inertia(plant);
    choices_.push_back({{std::move(name),
                         std::move(says),
                         plant.drive.oil_stiffness,
                         inertia,
                         plant::motor_to_load_ratio(plant::motor_inertia(other), inertia),
                         std::nullopt,
                         {}},
                        other});
    ChoiceResult& added = choices_.back().result;
    if (antenna_.resonance_frequency) added.resonance = resonating_mode(antenna_, plant).frequency;
  }

  void add(std::string name, std::string says, const Changes& changes) {
    add(std::move(name), std::move(says), changed(own_, changes));
  }

  // Of another source or a test.
  void add_contradiction(std::string name, std::string says, const Changes& changes) {
    add(std::move(name), std::move(says), changes);
    choices_.back().result.contradicts = true;
  }

  void add_attitude(std::string name, std::string says, const Changes& changes) {
    add(std::move(name), std::move(says), changes);
    choices_.back().result.other_attitude = true;
  }

  void add_shares(std::string name, std::string says, const Changes& changes) {
    add(std::move(name), std::move(says), changes);
    choices_.back().result.other_shares = true;
  }

  // The inertia a test found, with motors and gear train kept and the antenna taking the rest;
  // `model`: what its formula takes the antenna for.
  void add_test(std::string name, const std::string& model, double found, double stiffness) {
    const double fixed = fixed_inertia(), stated = antenna_inertia(antenna_);
    std::string says = fmt::format(
        "{}motors and gear train kept, the antenna takes the rest, {:.3f} kg.m2 for the case's "
        "{:.3f}",
        model, found - fixed, stated);
    if (found - fixed > 0.05 * stated) {
      add_contradiction(std::move(name), std::move(says),
                        {plant::set_to("at_shaft.antenna_inertia", found - fixed),
                         plant::set_to("at_shaft.oil_stiffness", stiffness)});
      return;
    }
    ChoiceResult impossible;
    impossible.name = std::move(name);
    impossible.says = std::move(says);
    impossible.oil_stiffness = stiffness;
    impossible.reflected_inertia = found;
    impossible.motor_to_load_ratio = plant::motor_to_load_ratio(motors_, found);
    impossible.impossible =
        fmt::format("{:.3f} - {:.3f} leaves {:.3f} kg.m2 for an antenna of {:.3f}", found, fixed,
                    found - fixed, stated);
    impossible.contradicts = true;
    choices_.push_back({std::move(impossible), std::nullopt});
  }

  std::size_t count() const { return choices_.size(); }
  // Of the choices from the `first` on: the frequency (Hz) that they are made for.
  void made_for(double frequency, std::size_t first) {
    for (std::size_t i = first; i < choices_.size(); ++i) {
      choices_[i].result.wanted_frequency = frequency;
    }
  }

  std::vector<PlantChoice> take() { return std::move(choices_); }

 private:
  const io::Case& antenna_;
  plant::Antenna own_;
  double motors_ = 0.0;
  std::vector<PlantChoice> choices_;
};

// The oil by which the flexible antenna resonates at that frequency (Hz), if that is other oil than
// the case's.
void add_flexible_resonance(const io::Case& antenna, double frequency, const std::string& leakage,
                            Choices& choices) {
  constexpr double same_oil = 0.01, gigapascal = 1e9;
  const auto modulus = bulk_modulus_for(antenna, frequency);
  if (!modulus) return;
  const double factor = *modulus / bulk_modulus(antenna);
  if (std::abs(factor - 1.0) <= same_oil) return;
  choices.add_contradiction(
      "oil for the resonance of the flexible antenna",
      fmt::format("bulk modulus of {:.3g} GPa{} by which the flexible antenna has the measured "
                  "{:g} Hz",
                  *modulus / gigapascal, leakage.empty() ? "," : leakage, frequency),
      bulk_modulus_times(antenna, factor));
}

// By a resonance at that frequency (Hz); `other`: the oil spring by the other convention.
void add_resonance(const io::Case& antenna, double frequency, double other, Choices& choices) {
  const std::string leakage =
      antenna.drive.leakage_by_flow ? ", and the leakage rate with it," : "";
  add_flexible_resonance(antenna, frequency, leakage, choices);
  if (!rings_as_rigid(antenna)) return;
  const double own = oil_stiffness(antenna);
  const double inertia = choices.fixed_inertia() + antenna_inertia(antenna);
  const double found = plant::inertia_from_resonance(own, frequency);
  // The oil spring goes with the inertia on it, at one frequency.
  const double factor = inertia / found;
  choices.add_contradiction(
      "masses right, stiffness from resonance",
      fmt::format("oil spring {} by a factor of {:.3g}{} so that the rigid masses ring at {:g} Hz",
                  factor < 1.0 ? "lowered" : "raised", std::max(factor, 1.0 / factor), leakage,
                  frequency),
      bulk_modulus_times(antenna, factor));
  const std::string rigid = "by the resonance of rigid masses, ";
  choices.add_test("stiffness right, inertia from resonance", rigid, found, own);
  choices.add_test(antenna.oil.efficiency_in_stiffness
                       ? "inertia from resonance, no efficiencies"
                       : "inertia from resonance, with efficiencies",
                   rigid, plant::inertia_from_resonance(other, frequency), other);
  const double scale = found / inertia, motors = choices.motor_inertia();
  // The gear train takes what the scaled sum leaves beside the motors, so that it is that sum.
  choices.add_contradiction("stiffness right, all masses scaled",
                            fmt::format("{}every inertia times {:.3f}", rigid, scale),
                            {plant::scaled_by("at_shaft.antenna_inertia", scale),
                             plant::scaled_by("at_shaft.motor_inertia", scale),
                             plant::set_to("at_shaft.gear_train_inertia",
                                           scale * choices.fixed_inertia() - scale * motors)});
}

}  // namespace

std::vector<PlantChoice> plant_choices(const io::Case& antenna) {
  Choices choices(antenna);
  choices.add("reference", "masses and oil stiffness of the plant above", Changes{});
  for (const auto& alternative : antenna.antenna.alternatives) {
    const std::string name = "antenna of " + alternative.name;
    const Changes changes = changes_of(antenna, alternative);
    if (alternative.keeps_springs) {
      choices.add_attitude(name, "another antenna inertia on the same springs", changes);
    } else {
      choices.add_contradiction(name, "another antenna inertia", changes);
    }
  }
  const bool efficient = antenna.oil.efficiency_in_stiffness;
  const double other = oil_stiffness(
      antenna, efficient ? plant::EfficiencyInStiffness::none : plant::EfficiencyInStiffness::both);
  // A convention changes no oil, and so no leakage rate.
  choices.add(efficient ? "stiffness without efficiencies" : "stiffness with efficiencies",
              "the other convention for the oil spring",
              Changes{plant::set_to("at_shaft.oil_stiffness", other)});
  const auto antennas = antennas_of(antenna);
  for (std::size_t i = 1; i < antennas.size(); ++i) {
    const double spring = linear_plant(antennas[i]).structure.gear_stiffness;
    choices.add(fmt::format("antenna of gear spring {:.3g} N.m/rad", spring),
                "another antenna of the frequencies that the case states with the motors held",
                antennas[i]);
  }
  for (const auto place : io::other_guesses) {
    if (!moves_guessed_shares(antenna.structure, place)) continue;
    choices.add_shares(
        std::string(to_string(place)),
        fmt::format("guessed shares of wind and beam, of what stated and negative ones leave, {}",
                    place == io::GuessedShares::as_inertia
                        ? "in proportion to the inertia fractions"
                        : "all at the heaviest of bull gear and modes, as of a dish on its "
                          "support"),
        guessed_share_changes(antenna.structure, place));
  }
  if (antenna.resonance_frequency) {
    const std::size_t first = choices.count();
    const double frequency = antenna.resonance_frequency->value;
    add_resonance(antenna, frequency, other, choices);
    choices.made_for(frequency, first);
  }
  for (const auto& impulse : antenna.impulse_results) {
    choices.add_test("inertia from impulse, " + impulse.name + " friction", "",
                     impulse.reflected_inertia.value, oil_stiffness(antenna));
  }
  return choices.take();
}

}  // namespace boresight::app
