#pragma once

#include <optional>

#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/design/decisions/assessment.hpp>

namespace boresight::app {

/// The controllers tuned for an antenna, and what they do on its nonlinear plant.
struct ControllerStudy {
  TuneSection tuned;
  /// Of the controller recommended at the wind speed of best_law, with the others of that speed and
  /// purpose beside it; none for a case without a [simulation] table and without a usable design.
  std::optional<TimeDomainSection> time_domain;
};

/// Every command's way to its controllers, so that all recommend the same one: tune_structures,
/// then the usable designs of best_law's purpose on the nonlinear antenna (choose_in_time_domain,
/// judge_in_time). After an interrupt without the latter. `detail` of the time domain decides
/// nothing. The same for any number of threads.
/// @throws as tune_structures and design::verify_in_time.
ControllerStudy study_controllers(const io::Case& antenna, const PlantEnsemble& ensemble,
                                  const TuneOptions& options,
                                  ChoiceDetail detail = ChoiceDetail::compared);

/// recommended_law of the study; where nothing is fit for that and a loss in wind is accepted, the
/// least unfit of those that were simulated; else what design::recommend makes of the designs at
/// the first wind speed with that fitness accepted. Null if there is none.
const TunedLaw* recommended_or(const ControllerStudy& study, design::Fitness accepted);

}  // namespace boresight::app
