#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/guessed_fractions.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {
namespace {

// Bull gear or mode, of one set of fractions.
struct Body {
  double inertia_fraction = 0.0;
  double* fraction = nullptr;
  bool guessed = false;
};

void place(std::vector<Body> bodies, GuessedFractions where) {
  std::erase_if(bodies, [](const Body& body) { return !body.guessed; });
  if (bodies.empty()) return;
  double sum = 0.0, inertia = 0.0;
  for (const Body& body : bodies) {
    sum += *body.fraction;
    inertia += body.inertia_fraction;
  }
  const auto heaviest = std::ranges::max_element(bodies, {}, &Body::inertia_fraction);
  for (const Body& body : bodies) {
    const double alone = body.fraction == heaviest->fraction ? 1.0 : 0.0;
    *body.fraction =
        sum * (where == GuessedFractions::as_inertia ? body.inertia_fraction / inertia : alone);
  }
}

void place_guessed_fractions(const StructureEntry& structure, GuessedFractions where,
                             plant::StructureSpecification& specification) {
  if (where == GuessedFractions::as_stated) return;
  double bull_gear = 1.0;
  for (const auto& mode : specification.modes) bull_gear -= mode.inertia_fraction;
  std::vector<Body> wind{{bull_gear, &specification.bull_gear_wind_fraction,
                          is_guessed_fraction(structure.bull_gear_wind_fraction)}};
  std::vector<Body> boresight{{bull_gear, &specification.bull_gear_beam_weight,
                               is_guessed_fraction(structure.bull_gear_beam_weight)}};
  for (std::size_t i = 0; i < specification.modes.size(); ++i) {
    auto& mode = specification.modes[i];
    const auto& stated = structure.modes.at(i);
    wind.push_back(
        {mode.inertia_fraction, &mode.wind_fraction, is_guessed_fraction(stated.wind_fraction)});
    boresight.push_back(
        {mode.inertia_fraction, &mode.beam_weight, is_guessed_fraction(stated.beam_weight)});
  }
  place(std::move(wind), where);
  place(std::move(boresight), where);
}

}  // namespace

std::string_view to_string(GuessedFractions place) {
  static constexpr std::array names{"wind and boresight fractions as stated",
                                    "wind and boresight fractions as inertia",
                                    "wind and boresight fractions all at one"};
  return names.at(static_cast<std::size_t>(place));
}

bool is_unbounded_guess(const Quantity& quantity) {
  return quantity.basis == Basis::assumed && !quantity.uncertainty_given;
}

bool is_guessed_fraction(const Quantity& fraction) {
  return is_unbounded_guess(fraction) && fraction.value >= 0.0;
}

std::vector<plant::AntennaChange> guessed_fraction_changes(const StructureEntry& structure,
                                                           GuessedFractions where) {
  if (where == GuessedFractions::as_stated) return {};
  plant::StructureSpecification placed = structure_specification(structure);
  place_guessed_fractions(structure, where, placed);
  std::vector changes{
      plant::set_to("structure.bull_gear_wind_fraction", placed.bull_gear_wind_fraction),
      plant::set_to("structure.bull_gear_beam_weight", placed.bull_gear_beam_weight)};
  for (std::size_t i = 0; i < placed.modes.size(); ++i) {
    const std::string mode = fmt::format("structure.mode[{}].", i);
    changes.push_back(plant::set_to(mode + "wind_fraction", placed.modes[i].wind_fraction));
    changes.push_back(plant::set_to(mode + "beam_weight", placed.modes[i].beam_weight));
  }
  return changes;
}

bool moves_guessed_fractions(const StructureEntry& structure, GuessedFractions where) {
  constexpr double same = 0.02;
  const plant::StructureSpecification stated = structure_specification(structure);
  plant::StructureSpecification placed = stated;
  place_guessed_fractions(structure, where, placed);
  const auto apart = [](double x, double y) { return std::abs(x - y) > same; };
  bool moved = apart(placed.bull_gear_wind_fraction, stated.bull_gear_wind_fraction) ||
               apart(placed.bull_gear_beam_weight, stated.bull_gear_beam_weight);
  for (std::size_t i = 0; i < stated.modes.size(); ++i) {
    moved = moved || apart(placed.modes[i].wind_fraction, stated.modes[i].wind_fraction) ||
            apart(placed.modes[i].beam_weight, stated.modes[i].beam_weight);
  }
  return moved;
}

}  // namespace boresight::io
