#include <charconv>

#include <fmt/format.h>

#include <boresight/app/tune/engineer_units.hpp>

namespace boresight::app {
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

std::vector<io::Quantity> written_like(const io::Case& antenna,
                                       const control::LoopStructure& structure) {
  if (antenna.present_gains && antenna.present_gains->structure == structure) {
    return antenna.present_gains->gains;
  }
  for (const auto& loop : antenna.loops) {
    if (loop.structure == structure) return loop.present.empty() ? loop.lower : loop.present;
  }
  return {};
}

control::ControlLaw law_of(const control::LoopStructure& structure,
                           const std::vector<io::Quantity>& gains) {
  control::ControlLaw law{structure, {}};
  for (const auto& gain : gains) law.gains.push_back(gain.value);
  return law;
}

}  // namespace

std::vector<std::string> in_engineers_units(const io::Case& antenna,
                                            const control::ControlLaw& law) {
  const auto written = written_like(antenna, law.structure);
  const auto& descriptions = law.structure.gains();
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < law.gains.size(); ++i) {
    std::string unit = descriptions[i].unit == "1" ? "" : descriptions[i].unit;
    double factor = 1.0;
    if (!written.empty()) {
      unit = unit_of(written[i].text);
      factor = unit.empty() ? 1.0 : io::parse_unit(unit).factor;
    }
    texts.push_back(
        fmt::format("{:.5g}{}{}", law.gains[i] / factor, unit.empty() ? "" : " ", unit));
  }
  return texts;
}

std::vector<control::ControlLaw> present_laws(const io::Case& antenna) {
  std::vector<control::ControlLaw> laws;
  if (antenna.present_gains) {
    laws.push_back(law_of(antenna.present_gains->structure, antenna.present_gains->gains));
  }
  for (const auto& loop : antenna.loops) {
    if (!loop.present.empty()) laws.push_back(law_of(loop.structure, loop.present));
  }
  return laws;
}

}  // namespace boresight::app
