#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/page/gains_to_load.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/studies/tuning_study.hpp>
#include <boresight/io/case/present_gains.hpp>

namespace boresight::app {
namespace {

// `values` with their units, in the structure's order. `title` follows "Gains " or, of a state
// space, "Controller ".
Document gains_table(const std::string& title, const control::LoopStructure& structure,
                     const std::vector<std::string>& values) {
  if (structure.state_space() != nullptr) {
    return subheading("Controller " + title) + wrapped(state_space_text(structure) + ".", "  ");
  }
  const auto& descriptions = structure.gains();
  std::vector<std::vector<std::string>> rows{{"gain", "value"}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    rows.push_back({fmt::format("{} {}", descriptions[i].symbol, descriptions[i].name), values[i]});
  }
  return subheading("Gains " + title) + table(std::move(rows), "ll");
}

// For a control computer that can't load the state space recommended.
Document loops_beside(const std::string& name, const control::Controller& controller,
                      const io::GainUnits& units) {
  return gains_table("of the best loops: " + name, controller.structure, units.texts(controller));
}

Document of_study(const design::TuningStudy& study, const io::GainUnits& units) {
  const TunedController* recommended = design::recommended_tuned_controller(study);
  if (recommended == nullptr) return {};
  const auto& controller = recommended->design.tuning.controller;
  auto document = gains_table("to load: " + name_and_purpose(*recommended), controller.structure,
                              units.texts(controller));
  if (recommended->is_state_space()) {
    if (const auto* loops = design::recommended_loops(study, recommended->wind_speed)) {
      document += loops_beside(name_and_purpose(*loops), loops->design.tuning.controller, units);
    }
  }
  return document;
}

Document of_redesign(const TuningSection& section) {
  if (!section.design.usable()) return {};
  const auto& controller = section.design.tuning.controller;
  const bool fit = section.fitness == design::Fitness::fit;
  auto document = gains_table(fmt::format("{}: {}, {}", fit ? "to load" : "not to be loaded",
                                          section.name, to_string(section.tuned_for)),
                              controller.structure, section.gain_units.texts(controller));
  if (section.loops) {
    document += loops_beside(section.loops->structure, section.loops->design.tuning.controller,
                             section.gain_units);
  }
  return document;
}

// Of the proposal to choose; where no samples were drawn, of the antenna as it is.
Document of_evaluation(const EvaluateSection& section) {
  if (section.candidates.empty()) return {};
  std::size_t place = 0;
  if (section.decision) place = section.decision->candidates[section.decision->worth].candidate;
  const Candidate& candidate = section.candidates[place];
  if (!candidate.feasible()) return {};
  const auto& structure = candidate.chosen_controller()->design.tuning.controller.structure;
  const std::string title =
      fmt::format("to load: {}, {}", candidate.controllers[*candidate.chosen].structure,
                  candidate.path.empty() ? "the antenna as it is" : candidate.name);
  if (structure.state_space() != nullptr && !candidate.path.empty()) {
    return subheading("Controller " + title) +
           wrapped(state_space_text(structure) + ", of a case with this change.", "  ");
  }
  return gains_table(title, structure, candidate.gains.at(*candidate.chosen));
}

}  // namespace

Document gains_to_load(const Report& report) {
  if (report.tuned) return of_study(*report.tuned, report.tuned->gain_units);
  if (report.evaluated) return of_evaluation(*report.evaluated);
  if (report.matched && report.matched->tuned_as_built) {
    return of_study(*report.matched->tuned_as_built, {});
  }
  return report.tuning ? of_redesign(*report.tuning) : Document{};
}

}  // namespace boresight::app
