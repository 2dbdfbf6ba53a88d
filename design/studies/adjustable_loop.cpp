#include <boresight/design/studies/adjustable_loop.hpp>

namespace boresight::design {

std::optional<AdjustableLoop> adjustable_loop(const RecommendedDesign& recommended) {
  const auto& beside = recommended.loops;
  const TuningResult& tuning = (beside ? beside->design : recommended.design).tuning;
  if (tuning.status == TuningStatus::unstable) return std::nullopt;
  AdjustableLoop loop{beside ? beside->structure : recommended.name, tuning.controller,
                      recommended.problem, recommended.goals};
  loop.problem.climate.clear();
  return loop;
}

std::optional<AdjustableLoop> adjustable_loop(const TuningStudy& study,
                                              const TunedController& row) {
  const TunedController* adjusted =
      row.is_state_space() ? recommended_loops(study, row.wind_speed) : &row;
  if (adjusted == nullptr || !adjusted->stable()) return std::nullopt;
  AdjustableLoop loop{adjusted->structure, adjusted->design.tuning.controller, study.problem,
                      study.goals};
  loop.problem.wind.mean_speed = row.wind_speed;
  loop.problem.climate.clear();
  return loop;
}

}  // namespace boresight::design
