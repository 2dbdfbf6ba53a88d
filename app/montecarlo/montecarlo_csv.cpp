#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {

std::string_view stability_text(design::StabilityBasis stability_basis) {
  switch (stability_basis) {
    case design::StabilityBasis::unstable:
      return "unstable";
    case design::StabilityBasis::undecided:
      return "undecided";
    case design::StabilityBasis::stable_by_eigenvalues:
    case design::StabilityBasis::stable_by_encirclements:
      break;
  }
  return "stable";
}

namespace {

// The values of a sample in the order of design::UncertainInput, factors but for the slope.
std::string input_columns() {
  std::string columns;
  for (std::size_t i = 0; i < design::uncertain_inputs; ++i) {
    const auto input = static_cast<design::UncertainInput>(i);
    std::string name(design::to_string(input));
    std::ranges::replace(name, ' ', '_');
    columns += fmt::format(
        ",{}{}", name, input == design::UncertainInput::friction_slope ? "_N_m_s_per_rad" : "_1");
  }
  return columns;
}

}  // namespace

std::string to_csv(const MonteCarloOutcome& outcome) {
  const auto& section = outcome.section;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "plant{},stability_verdict,boresight_rms_mdeg,climate_boresight_rms_mdeg,control_"
                 "effort_rad_per_s,rate_"
                 "loop_peak_1,"
                 "valve_command_peak_1,position_loop_peak_1,worst_constraint_1,"
                 "retuned_boresight_rms_mdeg\n",
                 input_columns());
  // An empty cell for what there is not.
  const auto cell = [&](double value) {
    if (std::isfinite(value)) {
      fmt::format_to(out, ",{}", value);
    } else {
      text.push_back(',');
    }
  };
  const auto& run = *outcome.run;
  for (std::size_t block = 0; block < run.blocks(); ++block) {
    if (!run.whole(block)) continue;
    std::uint64_t index = block * design::MonteCarloRun::block_size;
    for (const auto& one : run.outcomes(block)) {
      fmt::format_to(out, "{}", index);
      for (const double value : outcome.distribution->draw(section.seed, index).values) cell(value);
      fmt::format_to(out, ",{}", stability_text(one.stability_basis));
      cell(one.boresight_rms / millidegree);
      cell(one.climate_rms / millidegree);
      cell(one.control_effort);
      for (const double peak : one.sensitivity_peaks) cell(peak);
      cell(one.worst_constraint);
      cell(one.retuned_rms / millidegree);
      text.push_back('\n');
      ++index;
    }
  }
  return fmt::to_string(text);
}

}  // namespace boresight::app
