#pragma once

#include <string_view>
#include <vector>

#include <boresight/design/decisions/assessment.hpp>

namespace boresight::design {

/// What a recommended controller rests on.
struct Evidence {
  Fitness fitness = Fitness::unstable;
  bool simulated = false;         // on the nonlinear antenna, the run in wind completed
  bool plant_identified = false;  // from records, instead of from drawings
  bool inertias_agree = true;     // independent estimates of the reflected inertia
  bool resonance_agrees = true;   // the measured hydraulic frequency, with that of the plant
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
  limit_cycle,  // beyond the tightest budget, or not shown that there is none
  inertias_disagree,
  resonance_disagrees,
  interpretation_decides,
  plant_not_identified,
  input_decides,
};

struct ConfidenceGrade {
  Confidence grade = Confidence::high;
  std::vector<Doubt> doubts;  // in the order of Doubt
};

/// From which relative change of the rms one uncertain number counts as a doubt.
inline constexpr double telling_effect = 0.2;

/// Of the fitness that deficiency which decides it; a missed budget is none that makes a result
/// less sure. Low with any doubt up to interpretation_decides: then the verdict itself may be
/// wrong. Moderate with one of the others only: the figures may be off.
ConfidenceGrade grade(const Evidence& evidence);

}  // namespace boresight::design
