#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/report/time_domain_cells.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using design::RunStatus;
using Rows = std::vector<std::vector<std::string>>;

std::string mdeg(double angle) {
  return std::isfinite(angle) ? fmt::format("{:.4f}", angle / millidegree) : "-";
}

std::string signed_mdeg(double angle) {
  if (!std::isfinite(angle)) return "-";
  const double rounded = std::round(1e4 * angle / millidegree) * 1e-4;
  return rounded == 0.0 ? "0" : fmt::format("{:+.4f}", rounded);
}

// Why there is no figure.
std::string ended(RunStatus status, const std::string& message) {
  return fmt::format("{}: {}", design::to_string(status), message);
}

std::string words_of(design::Influence influence) {
  switch (influence) {
    case design::Influence::friction:
      return "friction curve and bristles, instead of viscous friction";
    case design::Influence::limits:
      return "limits of stroke, spool speed and command";
    case design::Influence::quantisation:
      return "encoder quantisation, instead of white noise";
    case design::Influence::orifice:
      return "orifice flow, instead of flow in proportion to the opening";
    case design::Influence::gear:
      return "backlash";
  }
  return "";
}

Document wind_part(const TimeDomainSection& section) {
  const design::WindResult& wind = section.result.wind;
  if (wind.status != RunStatus::complete) {
    return wrapped(fmt::format("In wind of {:.3g} m/s no rms: {}.", section.wind_speed,
                               ended(wind.status, wind.message)),
                   "  ");
  }
  Rows rows{{fmt::format("boresight in wind of {:.3g} m/s, {:g} s", section.wind_speed,
                         section.options.wind_duration),
             "rms mdeg", "without it"}};
  rows.push_back({"linear prediction", mdeg(wind.predicted_rms), ""});
  rows.push_back({"  realisation error of this record", signed_mdeg(wind.realisation_error), ""});
  rows.push_back({fmt::format("  sampling every {:g} s", section.sample_time),
                  signed_mdeg(wind.sampling), ""});
  for (const auto& influence : wind.influences) {
    rows.push_back({"  " + words_of(influence.influence), signed_mdeg(influence.difference),
                    influence.status == RunStatus::complete
                        ? mdeg(influence.boresight_rms_without)
                        : std::string(design::to_string(influence.status))});
  }
  rows.push_back(
      {"  interactions, oil lines and offset (remainder)", signed_mdeg(wind.interaction), ""});
  rows.push_back({"simulated", mdeg(wind.boresight_rms), ""});
  if (section.rms && section.rms->status == RunStatus::complete) {
    const auto& rms = section.rms->rms;
    rows.push_back({fmt::format("expected, by {} records (95 % {} .. {})", section.rms->records,
                                mdeg(rms.lower), mdeg(rms.upper)),
                    mdeg(rms.value), ""});
  }
  Document text = table(rows, "l");
  if (wind.at_command_limit > 0.0) {
    text += fmt::format("  The valve command is at its limit in {:.2g} % of the samples.\n",
                        100.0 * wind.at_command_limit);
  }
  return text;
}

Document integrators_part(const TimeDomainSection& section) {
  if (!section.result.integrators) return {};
  const design::IntegratorAgreement& both = *section.result.integrators;
  const auto told = [](const std::string& verdict) {
    return wrapped("Second integrator, CVODES: " + verdict, "  ", "  ");
  };
  if (both.status != RunStatus::complete) {
    return told("no check, " + ended(both.status, both.message) + ".");
  }
  const std::string_view confirmed = design::agree(both) ? "confirmed" : "NOT confirmed";
  const std::string difference =
      fmt::format("{} mdeg in this wind, differs by {:.0e} of the rms (limit {:.0e})",
                  mdeg(both.cvodes_rms), both.ratio(), design::integrator_agreement_limit);
  const auto& smooth = both.ratio_without_quantisation;
  if (!smooth) return told(fmt::format("{}; the integration is {}.", difference, confirmed));
  std::string text = fmt::format(
      "{}; the first integrator has {} mdeg. With white noise instead of encoder and tachometer "
      "steps they differ by {:.0e}; the integration is {}.",
      difference, mdeg(both.collocation_rms), *smooth, confirmed);
  if (design::agree(both)) {
    text += " The rest is rounding, which decides how a sample at the edge of a step is read.";
  }
  return told(text);
}

Document static_part(const TimeDomainSection& section) {
  return wrapped(fmt::format("Static boresight error in the mean wind, flexure included, by the "
                             "linear loop: {} mdeg.",
                             mdeg(section.result.wind.static_error)),
                 "  ", "  ");
}

Document limit_cycle_part(const TimeDomainSection& section) {
  Document text;
  for (const auto& limit_cycles : section.result.limit_cycles) {
    const std::string where =
        limit_cycles.rate == 0.0 ? std::string("At rest")
                                 : fmt::format("At {:.3g} mdeg/s", limit_cycles.rate / millidegree);
    if (limit_cycles.status != RunStatus::complete) {
      text += wrapped(
          fmt::format("{}, no wind: {}.", where, ended(limit_cycles.status, limit_cycles.message)),
          "  ", "  ");
      continue;
    }
    const std::string cycle =
        limit_cycles.limit_cycle
            ? fmt::format(
                  "a limit cycle of +-{} mdeg at the encoder, +-{} mdeg in "
                  "boresight, {}, in {} of {} runs{}",
                  mdeg(limit_cycles.encoder_amplitude), mdeg(limit_cycles.boresight_amplitude),
                  limit_cycles.frequency ? fmt::format("{:.3g} Hz", *limit_cycles.frequency)
                                         : std::string("without a steady period"),
                  limit_cycles.starts_with_limit_cycle, limit_cycles.starts,
                  limit_cycles.some_only() ? ", from different initial steps" : "")
            : fmt::format(
                  "no lasting limit cycle above the encoder's resolution in {} runs (+-{} mdeg and "
                  "a valve command of {:.3g} rad/s rms left)",
                  limit_cycles.starts, mdeg(limit_cycles.encoder_amplitude),
                  limit_cycles.valve_command_rms);
    text += wrapped(fmt::format("{}, no wind: {}.", where, cycle), "  ", "  ");
  }
  return text;
}

Document predicted_part(const TimeDomainSection& section) {
  if (section.limit_cycles_by_friction.empty()) return {};
  std::string text = "no limit cycle above half an encoder step.";
  if (const auto& one = section.predicted_limit_cycle) {
    text = fmt::format("+-{} mdeg at the encoder", mdeg(one->encoder_amplitude));
    if (one->frequency > 0.0) text += fmt::format(", {:.3g} Hz", one->frequency);
    text += one->confirmed ? ", by simulation of a reduced antenna."
                           : ", by describing functions alone; most such loops come to rest.";
  }
  return wrapped("Predicted at rest: " + text, "  ", "  ");
}

// Limit cycles with friction variations.
Document other_friction_part(const TimeDomainSection& section) {
  int all = 0;
  double largest = 0.0;
  std::vector<std::string> found;
  std::vector<std::string_view> with, without;
  for (const design::LimitCyclesWithFriction& one : section.limit_cycles_by_friction) {
    all += one.starts;
    largest = std::max(largest, one.encoder_amplitude);
    if (without.empty() || without.back() != one.friction) without.push_back(one.friction);
    if (one.limit_cycles == 0) continue;
    if (with.empty() || with.back() != one.friction) with.push_back(one.friction);
    found.push_back(
        fmt::format("{} {} in {} of {} runs{}", one.friction,
                    one.rate == 0.0 ? "at rest" : "when tracking", one.limit_cycles, one.starts,
                    std::isfinite(one.encoder_amplitude)
                        ? fmt::format(", +-{} mdeg at the encoder", mdeg(one.encoder_amplitude))
                        : std::string(", not all complete")));
  }
  if (all == 0) return {};
  std::erase_if(without, [&](std::string_view friction) {
    return std::ranges::find(with, friction) != with.end();
  });
  std::string text =
      found.empty()
          ? fmt::format(
                "With other friction ({}): no limit cycle in {} runs, +-{} mdeg at the "
                "encoder at most.",
                fmt::join(without, "; "), all, mdeg(largest))
          : fmt::format("With other friction, limit cycles that last {:g} s: {}.",
                        design::limit_cycle_confirmation * section.options.limit_cycle_duration,
                        fmt::join(found, "; "));
  if (!found.empty() && !without.empty()) {
    text += fmt::format(" None with {}.", fmt::join(without, "; "));
  }
  return wrapped(text, "  ", "  ");
}

Document reversal_part(const TimeDomainSection& section) {
  if (!section.result.reversal) return {};
  const auto& reversal = *section.result.reversal;
  if (reversal.status != RunStatus::complete) {
    return wrapped(fmt::format("Velocity reversals: {}.", ended(reversal.status, reversal.message)),
                   "  ", "  ");
  }
  const double unaided = reversal.boresight_error_without_friction_feedforward;
  return wrapped(
      fmt::format(
          "Velocity reversal at +-{:.3g} mdeg/s: peak error {} mdeg in boresight{}, {} mdeg "
          "at the encoder {:.2f} s after the reversal; {} mdeg at the encoder without "
          "friction.",
          section.options.tracking_rate / millidegree, mdeg(reversal.boresight_error),
          std::isfinite(unaided) ? fmt::format(" ({} without friction feedforward)", mdeg(unaided))
                                 : std::string(),
          mdeg(reversal.encoder_error), reversal.time_of_largest,
          mdeg(reversal.encoder_error_without_friction)),
      "  ", "  ");
}

// What the antenna's computer adds to the feedback, for the simulated figures to hold there.
Document feedforward_part(const TimeDomainSection& section) {
  const control::Feedforward& forward = section.feedforward;
  Rows rows{{"feedforward at the motor shaft", "of", "gain"}};
  const auto add = [&](const char* to, const char* of, double gain, const char* unit) {
    rows.push_back({to, of, fmt::format("{:.5g}{}", gain, unit)});
  };
  add("rate command", "commanded rate w", forward.rate_to_rate_command, "");
  add("rate command", "commanded acceleration a", forward.acceleration_to_rate_command, " s");
  add("valve command", "commanded rate w", forward.rate_to_valve_command, "");
  add("valve command", "commanded acceleration a", forward.acceleration_to_valve_command, " s");
  add("valve command", "friction torque Tf", forward.friction_to_valve_command, " rad/(s.N.m)");
  add("valve command", "change of Tf per s", forward.friction_change_to_valve_command,
      " rad/(N.m)");
  const plant::FrictionCurve& curve = forward.friction;
  const std::string friction = fmt::format(
      "Tf = {:.4g} + {:.4g} exp(-(w/{:.3g})^2) + {:.4g} (1 - exp(-|w|/{:.3g})) + {:.4g} |w| N.m, "
      "with w in rad/s of the motor at the next sample, opposite for negative w, 0 at rest. It is "
      "{:.0f} % of the antenna's friction. A controller that reads the motor torque reads it less "
      "Tf.",
      curve.coulomb_torque, curve.breakaway_torque - curve.coulomb_torque, curve.stribeck_rate,
      curve.saturating_torque, curve.saturating_rate, curve.viscous_friction,
      100.0 * section.friction_feedforward);
  const std::string orifice = fmt::format(
      "The sum for the valve command is divided by sqrt(1 - T/{:.4g}), as a loaded orifice passes "
      "less: T = {:.4g} a + Tf N.m against the flow, at most {:g} of the supply.",
      forward.supply_torque, forward.acceleration_to_motor_torque, control::max_feedforward_load);
  return "\n" + table(rows, "ll") + wrapped(friction, "  ") + wrapped(orifice, "  ");
}

Document slew_part(const TimeDomainSection& section) {
  if (!section.result.slew) return {};
  const auto& slew = *section.result.slew;
  const auto& asked = section.options.limits;
  std::string text =
      fmt::format("Slew of {:g} deg at {:.3g} deg/s and {:.3g} deg/s2", slew.distance / degree,
                  slew.limits.rate / degree, slew.limits.acceleration / degree);
  if (!slew.achievable_limits) {
    text += fmt::format(" (drive limit; specified {:.3g} deg/s and {:.3g} deg/s2)",
                        asked.rate / degree, asked.acceleration / degree);
  }
  const std::string bound = mdeg(section.options.settled_error);
  const std::string settled =
      !slew.settling_time ? fmt::format("not within {} mdeg {:g} s after the end of the command",
                                        bound, section.options.settling_watched)
      : *slew.settling_time > 0.0
          ? fmt::format("within {} mdeg {:.2f} s after the end of the command", bound,
                        *slew.settling_time)
          : fmt::format("within {} mdeg from the end of the command on", bound);
  text += std::isfinite(slew.largest_error)
              ? fmt::format(": {}; error up to {:.2f} mdeg on the way, overshoot {:.2f} mdeg.",
                            settled, slew.largest_error / millidegree, slew.overshoot / millidegree)
              : fmt::format(": {}.", ended(slew.status, slew.message));
  return wrapped(text, "  ", "  ");
}

// The rule by which the controller above was chosen (design::recommend).
std::string choice_text(const TimeDomainSection& section) {
  using Candidate = TimeDomainSection::Candidate;
  const double amplitude = section.options.allowed_limit_cycle;
  const auto simulated = [](const Candidate& one) {
    return std::isfinite(one.result.wind.boresight_rms);
  };
  const auto fit = [&](const Candidate& one) {
    return simulated(one) && design::is_limit_cycle_free(one.result.limit_cycles, amplitude);
  };
  const auto has_limit_cycle = [&](const Candidate& one) {
    return design::limit_cycle_amplitude(one.result.limit_cycles) > amplitude;
  };
  const std::string beyond =
      fmt::format("beyond the allowed amplitude (+-{} mdeg)", mdeg(amplitude));
  const std::string minimum = fmt::format(
      "the one above meets most budgets and then has the least simulated rms, limit cycle added in "
      "quadrature, or fewer gains in a tie with it ({:.0f} %, or the 95 % interval of the "
      "difference "
      "over the same winds)",
      100.0 * negligible_change);
  if (std::ranges::any_of(section.candidates, fit)) {
    return fmt::format("Of the controllers free of limit cycles {}, {}.", beyond, minimum);
  }
  if (std::ranges::none_of(section.candidates, simulated)) {
    return "None completes the run in wind: the one above has the least linear rms.";
  }
  if (std::ranges::all_of(section.candidates, has_limit_cycle)) {
    return fmt::format("All limit-cycle {}; {}.", beyond, minimum);
  }
  return fmt::format(
      "None completes the run in wind and is shown free of limit cycles {}; of those that complete "
      "it {}.",
      beyond, minimum);
}

// By several records where they ran.
std::string simulated_cell(const design::NonlinearVerification& result,
                           const std::optional<design::SimulatedRms>& expected) {
  const RunStatus status = expected ? expected->status : result.wind.status;
  if (status != RunStatus::complete) return std::string(design::to_string(status));
  return mdeg(expected ? expected->rms.value : result.wind.boresight_rms);
}

Document candidates_part(const TimeDomainSection& section) {
  if (section.candidates.empty()) return {};
  Rows rows{{"controller", "linear rms mdeg", "simulated", "limit cycle at rest", "when tracking",
             "reversal error", "slew settled s"}};
  for (const auto& [controller, result, expected] : section.candidates) {
    rows.push_back({controller, mdeg(result.wind.predicted_rms), simulated_cell(result, expected),
                    limit_cycle_cell(result, true), limit_cycle_cell(result, false),
                    result.reversal ? mdeg(result.reversal->boresight_error) : "-",
                    settling_cell(result.slew, section.options.settling_watched)});
  }
  return "\n" + table(rows, "l") +
         wrapped(fmt::format("Boresight in mdeg at the sky, simulated in {} of wind, the same for "
                             "all. {}",
                             section.rms ? fmt::format("{} records", section.rms->records)
                                         : std::string("one record"),
                             choice_text(section)),
                 "  ");
}

}  // namespace

Document document_of(const TimeDomainSection& section) {
  return heading("In the time domain, on the nonlinear antenna: " + section.controller) +
         wind_part(section) + integrators_part(section) + static_part(section) +
         limit_cycle_part(section) + predicted_part(section) + other_friction_part(section) +
         reversal_part(section) + slew_part(section) +
         wrapped(
             fmt::format("The controller: sampled every {:g} s with one sample of computing, "
                         "feedforward, shaped commands, anti-windup. Encoder resolution: {} mdeg. "
                         "Assumed: {:g} deg/s2 of command acceleration, {:.0f} % of the "
                         "friction fed forward. "
                         "Differences: rms with and without each influence, the others on.",
                         section.sample_time, mdeg(section.encoder_resolution),
                         section.options.limits.acceleration / degree,
                         100.0 * section.friction_feedforward),
             "  ") +
         feedforward_part(section) + candidates_part(section);
}

std::string to_text(const TimeDomainSection& section) {
  return to_text(document_of(section));
}

}  // namespace boresight::app
