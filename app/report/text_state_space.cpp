#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/app/report/time_domain_cells.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using Row = std::vector<std::string>;

std::string mdeg(double angle) {
  return std::isfinite(angle) ? fmt::format("{:.4f}", angle / millidegree) : "-";
}

std::string signed_percent(double fraction) {
  return fmt::format("{:+.1f} %", 100.0 * fraction);
}

// Simulated, with the limit cycle in quadrature: by this controllers are compared.
double compared_rms(const design::SimulatedCandidate& one) {
  return one.effect().rms(one.result.wind.predicted_rms);
}

std::string_view lead_of(design::StateSpaceVerdict verdict) {
  switch (verdict) {
    case design::StateSpaceVerdict::incomplete:
      return "No verdict: a run did not complete.";
    case design::StateSpaceVerdict::limit_cycle:
      return "Not usable, as it limit-cycles beyond the allowed amplitude: ";
    case design::StateSpaceVerdict::unsettled:
      return "Not usable, as it does not settle within the tightest budget after a slew: ";
    case design::StateSpaceVerdict::better:
      return "Better: ";
    case design::StateSpaceVerdict::no_advantage:
      return "No advantage: ";
  }
  throw InvalidInput("state-space verdict: not one of those there are");
}

std::string sentence(const design::StateSpaceStudy& study,
                     const design::SimulatedCandidate& loops) {
  std::string text(lead_of(verdict(study)));
  if (!study.change) return text;
  return text + fmt::format(
                    "its simulated rms is {:.3f} mdeg, against {:.3f} of {} ({}, 95 % {} to {}), "
                    "limit cycles included.",
                    compared_rms(study.simulated) / millidegree, compared_rms(loops) / millidegree,
                    loops.controller, signed_percent(study.change->value),
                    signed_percent(study.change->lower), signed_percent(study.change->upper));
}

}  // namespace

std::string state_space_text(const control::LoopStructure& structure) {
  const plant::StateSpace* system = structure.state_space();
  if (system == nullptr) {
    throw InvalidInput(
        fmt::format("state_space_text: expected a state space, found {}", structure.name()));
  }
  return fmt::format(
      "{}, sampled every {:.3g} s, from {}; matrices: state_space_controller of `boresight tune "
      "--mat FILE`",
      structure.name(), system->sample_time, fmt::join(system->inputs, ", "));
}

Document document_of(const design::StateSpaceStudy& study, const TimeDomainSection& loops) {
  using Run = design::SimulatedCandidate;
  const Run own = loops.own();
  std::vector<Row> rows{{"mdeg at the sky", own.controller, study.simulated.controller}};
  const auto add = [&](const std::string& what, const auto& of) {
    rows.push_back({what, of(own), of(study.simulated)});
  };
  add("rms, linear", [](const Run& one) { return mdeg(one.result.wind.predicted_rms); });
  add("rms, simulated", [](const Run& one) { return mdeg(one.simulated_rms()); });
  add("limit cycle at rest", [](const Run& one) { return limit_cycle_cell(one.result, true); });
  add("limit cycle when tracking",
      [](const Run& one) { return limit_cycle_cell(one.result, false); });
  add("valve command at rest, rad/s rms", [](const Run& one) {
    const auto& found = one.result.limit_cycles;
    return found.empty() ? std::string("-") : fmt::format("{:.3f}", found[0].valve_command_rms);
  });
  add("rms and limit cycle in quadrature", [](const Run& one) { return mdeg(compared_rms(one)); });
  add("peak boresight error at a velocity reversal", [](const Run& one) {
    return one.result.reversal ? mdeg(one.result.reversal->boresight_error) : "-";
  });
  add("static boresight error in the mean wind",
      [](const Run& one) { return mdeg(one.result.wind.static_error); });
  add("slew overshoot",
      [](const Run& one) { return one.result.slew ? mdeg(one.result.slew->overshoot) : "-"; });
  add("slew settled after, s", [&](const Run& one) {
    return settling_cell(one.result.slew, loops.options.settling_watched);
  });
  Document text = heading("A state-space controller instead of loops");
  text += essential(wrapped(sentence(study, own), "  "));
  text += wrapped(
      fmt::format(
          "A gradient search over all parameters of the controller minimises the rms on the "
          "worst plant. It keeps the limits on control effort and on Ms, at the valve command "
          "and with the loop cut at the encoder, on each plant. Start of the search: {}. The "
          "result ran on the nonlinear antenna "
          "as the recommended loops did, in the same wind of {:.3g} m/s.",
          study.start, study.wind_speed),
      "  ");
  text += essential(table(rows, "l"));
  text += wrapped(
      "It also meets the limit on Ms at standstill and is stable with its loop open. It is "
      "compared with the loops, and recommended only where SS is among the structures: it has no "
      "loops to close one by one, no constraint on the rate loop alone, and no anti-windup. --mat "
      "writes it as state_space_controller, which benchmark, simulate and montecarlo take with "
      "`--controller FILE --part state_space_controller`.",
      "  ");
  return text;
}

std::string state_space_advantage(const design::StateSpaceStudy& study,
                                  const TimeDomainSection& loops) {
  if (verdict(study) != design::StateSpaceVerdict::better) return "";
  return fmt::format(
      "A state-space controller of the same sensors ({}) would be better, but cannot be "
      "commissioned loop by loop: {:.3f} mdeg rms simulated, {} (95 % {} to {}) beside {}. "
      "--structure SS ranks it with the loops; docs/control-structures.md lists what it lacks.",
      study.simulated.controller, compared_rms(study.simulated) / millidegree,
      signed_percent(study.change->value), signed_percent(study.change->lower),
      signed_percent(study.change->upper), loops.controller);
}

}  // namespace boresight::app
