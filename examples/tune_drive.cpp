// Tunes rate and position PI with a lag for the least pointing error in wind, with
// maximum sensitivities of at most 2, and prints gains, margins and active constraints.
#include <cmath>
#include <cstdio>

#include "elevation_axis.hpp"
#include <boresight/design/tuning/design_study.hpp>

int main() {
  namespace control = boresight::control;
  namespace design = boresight::design;

  design::DesignTask task;
  task.problem = elevation_axis::tracking_problem();
  task.structure = control::LoopStructure::pi_with_lag();
  task.goals.sensitivity_peak = {2.0, 2.0, 2.0};
  task.options.starts = 8;
  const design::Design tuned = design::solve(task);
  if (tuned.tuning.status != design::TuningStatus::optimal) {
    std::fprintf(stderr, "tune_drive: no controller meets the goals\n");
    return 3;
  }
  if (!tuned.verification.passed) {
    std::fprintf(stderr, "tune_drive: %s\n", tuned.verification.failure.c_str());
    return 4;
  }

  const auto& controller = tuned.tuning.controller;
  for (std::size_t i = 0; i < controller.gains.size(); ++i) {
    const auto& gain = control::gain_descriptions(controller.structure)[i];
    std::printf("%s (%s): %.5g %s\n", gain.symbol.c_str(), gain.name.c_str(), controller.gains[i],
                gain.unit.c_str());
  }
  for (std::size_t i = 0; i < control::loop_breaks.size(); ++i) {
    const auto& margins = tuned.margins.at(i);
    std::printf("%s: Ms %.4f, gain margin %.1f dB, phase margin %.1f deg\n",
                control::to_string(control::loop_breaks.at(i)).data(),
                margins.sensitivity.magnitude, 20.0 * std::log10(margins.increasing_gain_margin),
                margins.phase_margin_deg);
  }
  std::printf("boresight rms at the sky: %.4f mdeg\n", tuned.boresight_rms / elevation_axis::mdeg);
  for (const auto& limit : tuned.tuning.limits) {
    std::printf("limited by: %s\n", limit.description().c_str());
  }
}
