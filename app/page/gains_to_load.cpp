#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/page/gains_to_load.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/studies/tuning_study.hpp>
#include <boresight/io/case/present_gains.hpp>

namespace boresight::app {
namespace {

Document gains_table(const std::string& title, const control::ControlLaw& law,
                     const io::GainUnits& units) {
  const auto& descriptions = law.structure.gains();
  const auto values = units.texts(law);
  std::vector<std::vector<std::string>> rows{{"gain", "value"}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    rows.push_back({fmt::format("{} {}", descriptions[i].symbol, descriptions[i].name), values[i]});
  }
  return subheading(title) + table(std::move(rows), "ll");
}

Document of_study(const design::TuningStudy& study, const io::GainUnits& units) {
  const TunedLaw* law = design::recommended_law(study);
  if (law == nullptr) return {};
  return gains_table("Gains to load: " + name_and_purpose(*law), law->design.tuning.law, units);
}

}  // namespace

Document gains_to_load(const Report& report) {
  if (report.tuned) return of_study(*report.tuned, report.tuned->gain_units);
  if (report.matched && report.matched->tuned_as_built) {
    return of_study(*report.matched->tuned_as_built, {});
  }
  if (!report.tuning || !report.tuning->design.usable()) return {};
  const TuningSection& section = *report.tuning;
  const bool fit = section.fitness == design::Fitness::fit;
  return gains_table(fmt::format("{}: {}, {}", fit ? "Gains to load" : "Gains, not to be loaded",
                                 section.name, to_string(section.tuned_for)),
                     section.design.tuning.law, section.gain_units);
}

}  // namespace boresight::app
