#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/redesign/interpretations.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>

namespace boresight::app {
namespace {

// The case's own numbers, as built, and those of ratio 1 by every inertia of the antenna.
std::vector<design::RedesignTask::Disks> matched_disks(const io::Case& antenna) {
  std::vector<double> counts = antenna.matching->disks;
  const double as_built = antenna.motor->flywheel_disks;
  if (std::ranges::find(counts, as_built) == counts.end()) counts.push_back(as_built);
  std::vector<design::RedesignTask::Disks> disks;
  for (const double count : counts) {
    disks.push_back({count, fmt::format("{:g} {}", count, count == 1.0 ? "disk" : "disks")});
  }
  const auto add_unit_ratio = [&](double load, std::string label) {
    if (const auto unit = disks_at_unit_ratio(antenna, load)) {
      disks.push_back({*unit, std::move(label)});
    }
  };
  add_unit_ratio(gear_train_inertia(antenna) + antenna_inertia(antenna), "ratio 1");
  for (const auto& alternative : antenna.antenna->alternatives) {
    add_unit_ratio(gear_train_inertia(antenna) + antenna_inertia(antenna, alternative),
                   "ratio 1 by " + alternative.name);
  }
  std::ranges::stable_sort(disks, {}, &design::RedesignTask::Disks::count);
  return disks;
}

// What of the case's text the section needs, and the inputs that its rms depends on.
TuningSection section_of(const io::Case& antenna, design::RecommendedDesign design,
                         unsigned threads) {
  TuningSection section;
  static_cast<design::RecommendedDesign&>(section) = std::move(design);
  section.wind_attitude = antenna.wind->attitude;
  section.wind_mast = antenna.wind->mast;
  section.demand_assumption = io::demand_assumption(antenna);
  section.gain_units = io::GainUnits(antenna);
  if (section.design.tuning.status != design::TuningStatus::unstable) {
    constexpr std::size_t max_effects = 10;
    section.input_effects = input_effects(antenna, section.design.tuning.controller, section.goals,
                                          section.design.boresight_rms, max_effects, threads);
  }
  return section;
}

}  // namespace

void redesign(const io::DesignedAntenna& designed, const StudyOptions& options, Report& report) {
  const io::Case& antenna = designed.antenna;
  std::vector<PlantInterpretation> interpretations = plant_interpretations(antenna);
  design::RedesignTask task;
  for (const auto& choice : interpretations) {
    if (choice.antenna) task.alternatives.push_back({choice.result.name, *choice.antenna});
  }
  task.disks = matched_disks(antenna);
  task.seed = options.seed;
  task.threads = options.threads;
  task.progress = options.progress;
  design::RedesignStudy study = design::redesign(designed.mission, designed.ensemble, task);

  report.tuning = section_of(antenna, std::move(study.recommended), options.threads);
  auto tuned = study.alternatives.begin();
  for (auto& choice : interpretations) {
    if (choice.antenna) {
      choice.result.design = std::move(tuned->design);
      choice.result.speed_limits = std::move(tuned->speed_limits);
      ++tuned;
    }
    report.interpretations.push_back(std::move(choice.result));
  }
  report.matching = std::move(study.flywheels);
  report.time_domain = section_of(antenna, std::move(study.time_domain));
}

}  // namespace boresight::app
