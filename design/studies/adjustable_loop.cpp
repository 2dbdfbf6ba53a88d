#include <boresight/design/studies/adjustable_loop.hpp>

namespace boresight::design {

std::optional<AdjustableLoop> adjustable_loop(const RecommendedDesign& recommended) {
  if (recommended.design.tuning.status == TuningStatus::unstable ||
      recommended.structure.state_space() != nullptr) {
    return std::nullopt;
  }
  AdjustableLoop loop{recommended.name, recommended.design.tuning.controller, recommended.problem,
                      recommended.goals};
  loop.problem.climate.clear();
  return loop;
}

std::optional<AdjustableLoop> adjustable_loop(const TuningStudy& study,
                                              const TunedController& row) {
  if (!row.stable() || row.is_state_space()) return std::nullopt;
  AdjustableLoop loop{row.structure, row.design.tuning.controller, study.problem, study.goals};
  loop.problem.wind.mean_speed = row.wind_speed;
  loop.problem.climate.clear();
  return loop;
}

}  // namespace boresight::design
