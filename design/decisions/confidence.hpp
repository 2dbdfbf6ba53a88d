#pragma once

#include <string_view>
#include <vector>

#include <boresight/design/decisions/assessment.hpp>

namespace boresight::design {

/// What the plant rests on.
enum class PlantBasis {
  drawings,    // the case as stated: no records
  failed_fit,  // the case as stated: no model fits its records
  records,     // the model that was fitted to them
};

/// The evidence behind a recommended controller.
struct Evidence {
  Fitness fitness = Fitness::unstable;
  bool simulated = false;  // on the nonlinear antenna, the run in wind completed
  PlantBasis plant = PlantBasis::drawings;
  /// Stable and within every constraint on every ensemble member that it was evaluated on.
  bool constraints_met_on_members = true;
  bool inertias_agree = true;    // independent estimates of the reflected inertia
  bool resonance_agrees = true;  // the measured hydraulic frequency agrees with the plant's
  /// Another interpretation of the evidence changes whether a required budget is met.
  bool verdict_depends_on_interpretation = false;
  /// Largest relative change of the rms by one number of the case within its uncertainty.
  double largest_effect = 0.0;
};

enum class Confidence { low, moderate, high };
std::string_view to_string(Confidence confidence);

/// Reasons against high confidence.
enum class Doubt {
  not_verified,
  not_robust,
  not_simulated,
  limit_cycle,  // beyond the allowed amplitude, or freedom from limit cycles not shown
  inertias_disagree,
  resonance_disagrees,
  interpretation_decides,
  fit_failed,
  plant_not_identified,
  input_decides,
};

struct ConfidenceGrade {
  Confidence grade = Confidence::high;
  std::vector<Doubt> doubts;  // in the order of Doubt
};

/// Relative change of the rms from which one uncertain number counts as a doubt.
inline constexpr double telling_effect = 0.2;

/// Grades the evidence. The deficiency that decides the fitness counts as a doubt, except a missed
/// budget, which does not reduce confidence. Instability on an ensemble member counts as
/// not_robust. Low with any doubt up to fit_failed: the verdict itself may be wrong. Moderate with
/// other doubts only: the figures may be inaccurate.
ConfidenceGrade grade(const Evidence& evidence);

}  // namespace boresight::design
