#include <tuple>

#include <boresight/design/studies/retuned_present.hpp>

namespace boresight::design {

const TunedController* retuned_present(const TuningStudy& study,
                                       const std::string& present_structure, double wind_speed) {
  const auto order = [](const TunedController& row) {
    return std::tuple(row.design.tuning.controller.structure.gains().size(), row.structure,
                      row.tuned_for != TunedFor::robust);
  };
  const TunedController* chosen = nullptr;
  for (const auto& row : study.controllers) {
    if (row.tuned_for == TunedFor::present || row.wind_speed != wind_speed || !row.stable() ||
        row.is_state_space()) {
      continue;
    }
    if (!present_structure.empty() && row.structure != present_structure) continue;
    if (chosen == nullptr || order(row) < order(*chosen)) chosen = &row;
  }
  return chosen;
}

}  // namespace boresight::design
