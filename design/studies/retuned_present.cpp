#include <tuple>

#include <boresight/design/studies/retuned_present.hpp>

namespace boresight::design {

const TunedLaw* retuned_present(const TuningStudy& study, const std::string& present_structure,
                                double wind_speed) {
  const auto order = [](const TunedLaw& row) {
    return std::tuple(row.design.tuning.law.structure.gains().size(), row.structure,
                      row.tuned_for != TunedFor::robust);
  };
  const TunedLaw* chosen = nullptr;
  for (const auto& row : study.laws) {
    if (row.tuned_for == TunedFor::present || row.wind_speed != wind_speed || !row.stable()) {
      continue;
    }
    if (!present_structure.empty() && row.structure != present_structure) continue;
    if (chosen == nullptr || order(row) < order(*chosen)) chosen = &row;
  }
  return chosen;
}

}  // namespace boresight::design
