#pragma once

#include <optional>
#include <string>

#include <boresight/design/ensembles/ensemble_curves.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/design/studies/tuning_study.hpp>

namespace boresight::design {

/// The controllers tuned for an antenna, and what they do on its nonlinear plant.
struct ControllerStudy {
  TuningStudy tuned;
  /// Of the controller recommended at the wind speed of best_law, with the others of that speed and
  /// purpose beside it; none without Antenna::nonlinear and without a usable design.
  std::optional<TimeDomainStudy> time_domain;
};

/// Every study's way to its controllers, so that all recommend the same one: tune_structures, then
/// the usable designs of best_law's purpose on the nonlinear antenna (choose_in_time_domain,
/// judge_in_time). After an interrupt without the latter. `detail` of the time domain decides
/// nothing. The same for any number of threads.
/// @throws as tune_structures and verify_in_time.
ControllerStudy study_controllers(const Mission& mission, const PlantEnsemble& ensemble,
                                  const TuneOptions& options,
                                  ChoiceDetail detail = ChoiceDetail::compared);

/// recommended_law of the study; where nothing is fit for that and a loss in wind is accepted, the
/// least unfit of those that were simulated; else what recommend() makes of the designs at the
/// first wind speed with that fitness accepted. Null if there is none.
const TunedLaw* recommended_or(const ControllerStudy& study, Fitness accepted);

/// The controller that figures and exported models are of: the one recommended; where none is, that
/// of the time domain, and without one best_law. Null without a controller.
const TunedLaw* shown_law(const TuningStudy& study, const TimeDomainStudy* in_time);

/// A controller of the study on the ensemble that the study was made with, as curves, with rms up
/// to the speeds that its budgets ask for. None without a stable controller or members.
/// @throws as ensemble_curves.
std::optional<EnsembleCurves> curves_of(const TuningStudy& study, const TunedLaw& row,
                                        const PlantEnsemble& ensemble, unsigned threads);

/// What a simulated controller is called.
std::string description_of(const TunedLaw& row);

/// What ran of a design among those of a study; none if nothing did.
std::optional<TimeDomainStudy::Candidate> run_of(const TimeDomainStudy& study, const TunedLaw& row);

/// Sets of each usable controller of `purpose` what it does on the nonlinear antenna
/// (TunedLaw::in_time, and speed_limits by that): at the wind speed of `compared` by what ran
/// there, at the speeds that budgets are needed up to by runs of their own, some seconds a
/// controller. Nothing without `compared`. The same for any number of threads.
void judge_in_time(const Mission& mission, const TimeDomainStudy* compared, TunedFor purpose,
                   std::uint64_t seed, unsigned threads, const std::function<bool()>& interrupted,
                   TuningStudy& study);

}  // namespace boresight::design
