#pragma once

#include <optional>
#include <string>

#include <boresight/design/ensembles/ensemble_curves.hpp>
#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/design/studies/tuning_study.hpp>

namespace boresight::design {

/// The controllers tuned for an antenna, and their results on its nonlinear plant.
struct ControllerStudy {
  TuningStudy tuned;
  /// Simulation of the controller recommended at the wind speed of best_controller, with the other
  /// designs of that speed and purpose for comparison. None without Antenna::nonlinear, and without
  /// a usable design.
  std::optional<TimeDomainStudy> time_domain;
  /// The pointing limit at the wind speed of best_controller, from which the state-space controller
  /// comes; only where the structures ask for one.
  std::optional<PointingLimit> limit = std::nullopt;
};

/// Tunes and recommends the controllers of every study, so that all recommend the same one. It runs
/// tune_structures, then simulates the usable designs of best_controller's purpose on the nonlinear
/// antenna (TimeDomainChoice, evaluate_in_time). Where the structures ask for a state-space
/// controller, the one of the pointing limit (pointing_limit_of, state_space_candidate), which
/// starts from the recommended loops, joins the controllers at that wind speed and is simulated
/// like them. An interrupt skips the simulations and what follows. `detail` does not affect the
/// recommendation. The result does not depend on the number of threads.
/// @throws as tune_structures, pointing_limit_of and verify_in_time.
ControllerStudy study_controllers(const Mission& mission, const PlantEnsemble& ensemble,
                                  const TuneOptions& options,
                                  ChoiceDetail detail = ChoiceDetail::compared);

/// The recommended_tuned_controller of the study. Where none is fit and a loss in wind is accepted:
/// the least unfit of the simulated controllers. Otherwise recommend() over the designs at the
/// first wind speed, with that fitness accepted. Null if there is none.
const TunedController* recommended_or(const ControllerStudy& study, Fitness accepted);

/// The controller that figures and exported models show: the recommended one; else that of the time
/// domain; else best_controller. Null without a controller.
const TunedController* shown_controller(const TuningStudy& study, const TimeDomainStudy* in_time);

/// Curves of a controller of the study on the ensemble that the study was made with. The rms
/// extends to the speeds that its budgets require. None without a stable controller or without
/// members.
/// @throws as ensemble_curves.
std::optional<EnsembleCurves> curves_of(const TuningStudy& study, const TunedController& row,
                                        const PlantEnsemble& ensemble, unsigned threads);

/// The description of a simulated controller.
std::string description_of(const TunedController& row);

/// The run of a design among those of a study; none if it was not simulated.
std::optional<TimeDomainStudy::Candidate> run_of(const TimeDomainStudy& study,
                                                 const TunedController& row);

/// Sets the nonlinear results of each usable controller of `purpose` (TunedController::in_time, and
/// speed_limits from them). At the wind speed of `compared` it uses the runs made there. At the
/// speeds up to which budgets are needed it makes new runs, some seconds per controller. It does
/// nothing without `compared`. The result does not depend on the number of threads.
void evaluate_in_time(const Mission& mission, const TimeDomainStudy* compared, TunedFor purpose,
                      std::uint64_t seed, unsigned threads,
                      const std::function<bool()>& interrupted, TuningStudy& study);

}  // namespace boresight::design
