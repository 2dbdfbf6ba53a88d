#include <boresight/design/decisions/confidence.hpp>

namespace boresight::design {

std::string_view to_string(Confidence confidence) {
  switch (confidence) {
    case Confidence::low:
      return "low";
    case Confidence::moderate:
      return "moderate";
    case Confidence::high:
      return "high";
  }
  return "";
}

ConfidenceGrade grade(const Evidence& evidence) {
  ConfidenceGrade result;
  const auto doubt = [&](bool holds, Doubt reason) {
    if (holds) result.doubts.push_back(reason);
  };
  const Fitness fitness = evidence.fitness;
  doubt(fitness >= Fitness::misses_nominal, Doubt::not_verified);
  doubt(fitness == Fitness::misses_member || !evidence.constraints_met_on_members,
        Doubt::not_robust);
  doubt(!evidence.simulated, Doubt::not_simulated);
  doubt(fitness == Fitness::limit_cycle || fitness == Fitness::not_shown, Doubt::limit_cycle);
  doubt(!evidence.inertias_agree, Doubt::inertias_disagree);
  doubt(!evidence.resonance_agrees, Doubt::resonance_disagrees);
  doubt(evidence.verdict_depends_on_interpretation, Doubt::interpretation_decides);
  doubt(evidence.plant == PlantBasis::failed_fit, Doubt::fit_failed);
  doubt(evidence.plant == PlantBasis::drawings, Doubt::plant_not_identified);
  doubt(!(evidence.largest_effect <= telling_effect), Doubt::input_decides);
  if (result.doubts.empty()) return result;
  result.grade =
      result.doubts.front() < Doubt::plant_not_identified ? Confidence::low : Confidence::moderate;
  return result;
}

}  // namespace boresight::design
