#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include <boresight/control/controllers/usual_structures.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {
namespace {

// What stands behind the number.
std::string unit_of(const std::string& written) {
  double number = 0.0;
  const auto [end, error] =
      std::from_chars(written.data(), written.data() + written.size(), number);
  std::string unit(end, written.data() + written.size());
  unit.erase(0, unit.find_first_not_of(' '));
  return unit;
}

control::Controller controller_of(const control::LoopStructure& structure,
                                  const std::vector<Quantity>& gains) {
  control::Controller controller{structure, {}};
  for (const auto& gain : gains) controller.gains.push_back(gain.value);
  return controller;
}

}  // namespace

GainUnits::GainUnits(const Case& stated) {
  const auto add = [&](const control::LoopStructure& structure,
                       const std::vector<Quantity>& gains) {
    if (gains.empty()) return;
    Written written{structure, {}};
    for (const auto& gain : gains) {
      const std::string unit = unit_of(gain.text);
      written.units.push_back({unit, unit.empty() ? 1.0 : parse_unit(unit).factor});
    }
    written_.push_back(std::move(written));
  };
  if (stated.present_gains) add(stated.present_gains->structure, stated.present_gains->gains);
  for (const auto& loop : stated.loops) {
    add(loop.structure, loop.present.empty() ? loop.lower : loop.present);
  }
}

std::vector<std::string> GainUnits::texts(const control::Controller& controller) const {
  const auto written = std::ranges::find(written_, controller.structure, &Written::structure);
  const auto& descriptions = controller.structure.gains();
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < controller.gains.size(); ++i) {
    Unit unit{descriptions[i].unit == "1" ? "" : descriptions[i].unit};
    if (written != written_.end()) unit = written->units.at(i);
    texts.push_back(fmt::format("{:.5g}{}{}", controller.gains[i] / unit.factor,
                                unit.symbol.empty() ? "" : " ", unit.symbol));
  }
  return texts;
}

std::vector<design::NamedController> present_controllers(const Case& stated) {
  std::vector<design::NamedController> controllers;
  const auto add = [&](const control::LoopStructure& structure,
                       const std::vector<Quantity>& gains) {
    if (gains.empty()) return;
    controllers.push_back({short_name(structure), controller_of(structure, gains)});
  };
  if (stated.present_gains) add(stated.present_gains->structure, stated.present_gains->gains);
  for (const auto& loop : stated.loops) add(loop.structure, loop.present);
  return controllers;
}

}  // namespace boresight::io
