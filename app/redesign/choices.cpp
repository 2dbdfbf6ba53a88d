#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/redesign/choices.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/app/redesign/resonating_mode.hpp>
#include <boresight/io/case/structure_numbers.hpp>

namespace boresight::app {
namespace {

class Choices {
 public:
  explicit Choices(const io::Case& antenna)
      : antenna_(antenna), motors_(motor_inertia(antenna, antenna.motor.flywheel_disks)) {}

  // Motors and gear train.
  double fixed_inertia() const { return motors_ + gear_train_inertia(antenna_); }

  // Of the numbers that the case states, or a convention or solution of the reckoning.
  void add(std::string name, std::string says, const PlantVariant& variant) {
    const auto plant = make_plant(antenna_, variant);
    const double inertia = plant::reflected_inertia(plant);
    choices_.push_back({{std::move(name),
                         std::move(says),
                         plant.drive.oil_stiffness,
                         inertia,
                         plant::motor_to_load_ratio(variant.inertia_scale * motors_, inertia),
                         std::nullopt,
                         {}},
                        variant});
    ChoiceResult& added = choices_.back().result;
    added.other_shares = variant.guessed_shares != GuessedShares::as_stated;
    if (antenna_.resonance_frequency) added.resonance = resonating_mode(antenna_, plant).frequency;
  }

  // Of another source or a test.
  void add_contradiction(std::string name, std::string says, const PlantVariant& variant) {
    add(std::move(name), std::move(says), variant);
    choices_.back().result.contradicts = true;
  }

  void add_attitude(std::string name, std::string says, const PlantVariant& variant) {
    add(std::move(name), std::move(says), variant);
    choices_.back().result.other_attitude = true;
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
                        {.antenna_inertia = found - fixed, .oil_stiffness = stiffness});
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
      {.oil_stiffness = factor * oil_stiffness(antenna),
       .leakage_rate = leakage_rate_at(antenna, factor)});
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
      {.oil_stiffness = factor * own, .leakage_rate = leakage_rate_at(antenna, factor)});
  const std::string rigid = "by the resonance of rigid masses, ";
  choices.add_test("stiffness right, inertia from resonance", rigid, found, own);
  choices.add_test(antenna.oil.efficiency_in_stiffness
                       ? "inertia from resonance, no efficiencies"
                       : "inertia from resonance, with efficiencies",
                   rigid, plant::inertia_from_resonance(other, frequency), other);
  choices.add_contradiction("stiffness right, all masses scaled",
                            fmt::format("{}every inertia times {:.3f}", rigid, found / inertia),
                            {.inertia_scale = found / inertia});
}

}  // namespace

std::vector<PlantChoice> plant_choices(const io::Case& antenna) {
  Choices choices(antenna);
  choices.add("reference", "masses and oil stiffness of the plant above", {});
  for (const auto& alternative : antenna.antenna.alternatives) {
    const std::string name = "antenna of " + alternative.name;
    const PlantVariant variant = variant_of(antenna, alternative);
    if (alternative.keeps_springs) {
      choices.add_attitude(name, "another antenna inertia on the same springs", variant);
    } else {
      choices.add_contradiction(name, "another antenna inertia", variant);
    }
  }
  const bool efficient = antenna.oil.efficiency_in_stiffness;
  const double other = oil_stiffness(
      antenna, efficient ? plant::EfficiencyInStiffness::none : plant::EfficiencyInStiffness::both);
  // A convention changes no oil, and so no leakage rate.
  choices.add(efficient ? "stiffness without efficiencies" : "stiffness with efficiencies",
              "the other convention for the oil spring", {.oil_stiffness = other});
  const std::size_t antennas = io::structure_specifications(antenna.structure).size();
  for (std::size_t i = 1; i < antennas; ++i) {
    const PlantVariant variant{.structure = i};
    const double spring = make_plant(antenna, variant).structure.gear_stiffness;
    choices.add(fmt::format("antenna of gear spring {:.3g} N.m/rad", spring),
                "another antenna of the frequencies that the case states with the motors held",
                variant);
  }
  for (const auto place : other_guesses) {
    if (!moves_guessed_shares(antenna.structure, place)) continue;
    choices.add(
        std::string(to_string(place)),
        fmt::format("guessed shares of wind and beam, of what stated and negative ones leave, {}",
                    place == GuessedShares::as_inertia
                        ? "in proportion to the inertia fractions"
                        : "all at the heaviest of bull gear and modes, as of a dish on its "
                          "support"),
        {.guessed_shares = place});
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
