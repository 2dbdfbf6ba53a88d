#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/margins_line.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

std::size_t unstable_members(const TuningSection& section) {
  if (!section.ensemble) return 0;
  return section.ensemble->members.size() - static_cast<std::size_t>(section.ensemble->stable);
}

// "; met on 30/30, 90 % of plants": of the ensemble, and of sampled plants.
std::string constraints_text(const TuningSection& section) {
  if (!section.ensemble) return "";
  std::string text =
      fmt::format("; met on {}/{}{}", section.ensemble->within_constraints,
                  section.ensemble->members.size(), section.constraints_met ? "" : " models");
  if (const std::size_t unstable = unstable_members(section); unstable > 0) {
    text += fmt::format(", {} UNSTABLE", unstable);
  }
  if (section.constraints_met) {
    const double fraction = section.constraints_met->value;
    text += fmt::format(", {:.{}f} % of plants", 100.0 * fraction,
                        fraction > 0.99 && fraction < 1.0 ? 2 : 0);
  }
  return text;
}

// Of an unshaped step; of a state space, which needs shaped commands, also of a shaped slew.
std::string overshoot_text(const Report& report, const TuningSection& section) {
  if (!section.curves) return "";
  std::string text =
      fmt::format("; overshoot {:.0f} %", 100.0 * section.curves->position_step.overshoot());
  const auto* slew = section.loops && report.time_domain && report.time_domain->result.slew
                         ? &*report.time_domain->result.slew
                         : nullptr;
  if (slew != nullptr && slew->status == design::RunStatus::complete) {
    text += fmt::format(", after a shaped slew {:.3f} mdeg", slew->overshoot / millidegree);
  }
  return text;
}

}  // namespace

CardLine margins_line(const Report& report) {
  const TuningSection& section = *report.tuning;
  const auto& design = section.design;
  double peak = 0.0, phase = 180.0, gain = HUGE_VAL;
  for (const auto& one : design.verification.peaks) peak = std::max(peak, one.upper);
  for (const auto& margins : design.margins) {
    phase = std::min(phase, margins.phase_margin_deg);
    gain = std::min(gain, margins.increasing_gain_margin);
  }
  std::string text = fmt::format("Ms {:.2f}, PM {:.0f} deg", peak, phase);
  if (std::isfinite(gain)) text += fmt::format(", GM {:.1f} dB", 20.0 * std::log10(gain));
  // Of a state space the figures are of the loop cut at the valve.
  if (section.loops) text += " (at the valve)";
  text += overshoot_text(report, section) + constraints_text(section);
  if (section.instability) {
    text += fmt::format("; {:.2g} % unstable over the case's ranges (95 %: at most {:.2g} %)",
                        100.0 * section.instability->value, 100.0 * section.instability->upper);
  }
  return {"Margins", text, "Tuned loops"};
}

}  // namespace boresight::app
