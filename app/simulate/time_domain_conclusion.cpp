#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/friction_leeway.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using design::RunStatus;

std::string_view cause_of(design::Influence influence) {
  switch (influence) {
    case design::Influence::friction:
      return "friction";
    case design::Influence::limits:
      return "the limit of stroke, spool speed or command";
    case design::Influence::quantisation:
      return "encoder quantisation";
    case design::Influence::orifice:
      return "the flow through the valve's orifices";
    case design::Influence::gear:
      return "backlash";
  }
  return "";
}

std::string conclude_wind(const TimeDomainSection& section) {
  const design::WindResult& wind = section.result.wind;
  if (wind.status != RunStatus::complete) {
    return fmt::format(
        "The simulation of {} in {:.3g} m/s of wind did not complete ({}): only linear results are "
        "available.",
        section.controller, section.wind_speed, design::to_string(wind.status));
  }
  std::string text = fmt::format(
      "On the nonlinear antenna {} has {:.3f} mdeg rms in one record of {:.3g} m/s, linear "
      "prediction {:.3f}",
      section.controller, wind.boresight_rms / millidegree, section.wind_speed,
      wind.predicted_rms / millidegree);
  if (wind.boresight_rms <= wind.predicted_rms) return text + ".";
  const auto maximum =
      std::ranges::max_element(wind.influences, {}, [](const design::InfluenceResult& influence) {
        return std::isfinite(influence.difference) ? influence.difference : 0.0;
      });
  if (maximum != wind.influences.end() && maximum->difference > 0.0) {
    text += fmt::format("; {} alone adds {:.3f}", cause_of(maximum->influence),
                        maximum->difference / millidegree);
  }
  const double factor = wind.boresight_rms / wind.predicted_rms;
  const double excess = 100.0 * (factor - 1.0);
  if (excess < 0.5) return text + ".";
  if (factor > 1.5) {
    return text + fmt::format(
                      ". Simulated/linear rms ratio {:.2f}: a linear prediction needs this margin "
                      "to its budget.",
                      factor);
  }
  return text +
         fmt::format(". Nonlinearities add {0:.0f} %: a linear prediction needs {0:.0f} % margin.",
                     excess);
}

// Whether by that it is left out of a choice; a controller may also be because a run did not end.
bool has_limit_cycle_beyond(const std::vector<design::LimitCycleResult>& limit_cycles,
                            double allowed) {
  return design::limit_cycle_amplitude(limit_cycles) > allowed;
}

// What a controller with a limit cycle beyond the allowed amplitude does.
std::string limit_cycle_text(const std::vector<design::LimitCycleResult>& limit_cycles,
                             double allowed) {
  if (!has_limit_cycle_beyond(limit_cycles, allowed)) {
    return "was not shown free of limit cycles (a run at rest or at the tracking rate did not "
           "complete)";
  }
  return fmt::format("has a limit cycle of +-{:.2f} mdeg, beyond the allowed +-{:.3f} mdeg",
                     design::limit_cycle_amplitude(limit_cycles) / millidegree,
                     allowed / millidegree);
}

// The same of another such controller.
std::string other_limit_cycle_text(const std::vector<design::LimitCycleResult>& limit_cycles,
                                   double allowed) {
  if (!has_limit_cycle_beyond(limit_cycles, allowed))
    return "was not shown free of limit cycles either";
  return fmt::format("also has one beyond that, +-{:.2f} mdeg",
                     design::limit_cycle_amplitude(limit_cycles) / millidegree);
}

// What a controller that the linear plant prefers does on the nonlinear antenna.
std::string first_text(const design::SimulatedCandidate& candidate, double allowed) {
  const design::NonlinearVerification& first = candidate.result;
  const RunStatus status = candidate.rms ? candidate.rms->status : first.wind.status;
  std::string text = status == RunStatus::complete
                         ? fmt::format("it has {:.3f}", candidate.simulated_rms() / millidegree)
                         : fmt::format("its run did not complete ({})", design::to_string(status));
  const double limit_cycles = design::limit_cycle_amplitude(first.limit_cycles);
  if (!design::is_limit_cycle_free(first.limit_cycles, allowed)) {
    text += " and " + limit_cycle_text(first.limit_cycles, allowed);
  } else if (limit_cycles > 0.0) {
    text += fmt::format(" with a limit cycle of +-{:.2f}", limit_cycles / millidegree);
  }
  return text;
}

// What the controller chosen, whose run in wind completed, does better by design::recommend.
std::string merit(const TimeDomainSection& section, const design::SimulatedCandidate& first) {
  const double rms = section.own().simulated_rms(), other = first.simulated_rms();
  const auto change = figure_change(section.own(), first);
  const bool tied = change && change->lower <= 0.0 && change->upper >= 0.0;
  if (!std::isfinite(other) || (rms < other && !tied)) {
    return fmt::format("{} has {:.3f}", section.controller, rms / millidegree);
  }
  const bool alike = rms <= (1.0 + negligible_change) * other;
  const bool has_smaller_limit_cycle = design::limit_cycle_amplitude(section.result.limit_cycles) <
                                       design::limit_cycle_amplitude(first.result.limit_cycles);
  return fmt::format("{} has {} and {}", section.controller,
                     tied ? fmt::format("{:.3f}, a tie over the same {} winds,", rms / millidegree,
                                        section.rms->records)
                     : alike
                         ? fmt::format("the same rms within {:.0f} %", 100.0 * negligible_change)
                         : fmt::format("{:.3f}", rms / millidegree),
                     has_smaller_limit_cycle ? "a smaller limit cycle" : "fewer gains");
}

// By more than the winds leave open.
bool is_better(const TimeDomainSection& section, const design::SimulatedCandidate& first) {
  const double other = first.simulated_rms();
  if (!std::isfinite(other)) return true;
  const auto change = figure_change(section.own(), first);
  return change ? change->lower > 0.0 : section.own().simulated_rms() < other;
}

// Why this controller and not the one that the linear plant puts first.
std::string conclude_choice(const TimeDomainSection& section) {
  const auto linear = [](const TimeDomainSection::Candidate& candidate) {
    return candidate.result.wind.predicted_rms;
  };
  const auto first = std::ranges::min_element(section.candidates, {}, linear);
  if (first == section.candidates.end() || first->controller == section.controller) return "";
  const double allowed = section.options.allowed_limit_cycle;
  const design::WindResult& wind = first->result.wind;
  const auto& limit_cycles = section.result.limit_cycles;
  std::string text =
      fmt::format("{} has the lowest linear rms ({:.3f} mdeg); on the nonlinear antenna {}: ",
                  first->controller, wind.predicted_rms / millidegree, first_text(*first, allowed));
  const bool first_still = design::is_limit_cycle_free(first->result.limit_cycles, allowed);
  if (!std::isfinite(section.own().simulated_rms())) {
    text += fmt::format("the run of {} did not complete either", section.controller);
  } else if (!design::is_limit_cycle_free(limit_cycles, allowed)) {
    text += fmt::format("{}, but {}", merit(section, *first),
                        first_still ? limit_cycle_text(limit_cycles, allowed)
                                    : other_limit_cycle_text(limit_cycles, allowed));
  } else if (!first_still) {
    text += fmt::format("{} has no limit cycle beyond the allowed amplitude", section.controller);
  } else if (is_better(section, *first)) {
    text += fmt::format("{} is better", section.controller);
  } else {
    text += merit(section, *first);
  }
  return text + ". ";
}

// Warns of a simulated rms that the second integrator contradicts; empty if it does not, or had no
// result.
std::string integration_text(const TimeDomainSection& section) {
  const auto& both = section.result.integrators;
  if (!both || section.result.wind.status != RunStatus::complete || design::agree(*both)) return "";
  constexpr const char* warning =
      " Do not rely on the simulated rms: CVODES, a second integrator, ";
  if (both->status == RunStatus::complete) {
    return fmt::format("{}differs from it by {:.1g} %.", warning, 100.0 * both->ratio());
  }
  return both->status == RunStatus::lost ? fmt::format("{}loses the target.", warning) : "";
}

// What it does by itself at a steady rate; empty where it is free of limit cycles.
std::string limit_cycle_text(const design::LimitCycleResult& limit_cycles, double allowed) {
  const char* where = limit_cycles.rate == 0.0 ? "At rest" : "At the tracking rate";
  if (limit_cycles.status != RunStatus::complete) {
    return fmt::format(" {} freedom from limit cycles was not shown ({}).", where,
                       design::to_string(limit_cycles.status));
  }
  if (!limit_cycles.limit_cycle) return "";
  return fmt::format(" {} it has a limit cycle of +-{:.2f} mdeg{}{}.", where,
                     limit_cycles.boresight_amplitude / millidegree,
                     limit_cycles.some_only()
                         ? fmt::format(" in {} of {} runs", limit_cycles.starts_with_limit_cycle,
                                       limit_cycles.starts)
                         : "",
                     has_limit_cycle_beyond({limit_cycles}, allowed)
                         ? fmt::format(", beyond the allowed +-{:.3f} mdeg", allowed / millidegree)
                         : "");
}

}  // namespace

std::string slew_not_achievable(const TimeDomainSection& section) {
  const auto& slew = section.result.slew;
  if (!slew || slew->achievable_limits) return "";
  const auto& asked = section.options.limits;
  if (!(slew->limits.rate < asked.rate)) return "";
  return fmt::format(
      "With 20 % flow and pressure reserve the drive slews at {:.3g} deg/s, not the specified "
      "{:.3g}.",
      slew->limits.rate / degree, asked.rate / degree);
}

std::string assumed_stroke(const TimeDomainSection& section) {
  if (section.stroke_assumption.empty()) return "";
  const design::WindResult& wind = section.result.wind;
  const bool rms = std::ranges::any_of(wind.influences, [&](const auto& influence) {
    return influence.influence == design::Influence::limits &&
           influence.difference > negligible_change * wind.boresight_rms;
  });
  if (!rms && !section.slew_hangs_on_stroke) return "";
  const char* hanging = !rms ? "The achievable slew rate depends"
                        : section.slew_hangs_on_stroke
                            ? "The simulated rms and the slew rate depend"
                            : "The simulated rms depends";
  return fmt::format("{} on {}: state simulation.valve_stroke or the valve's rated flow.", hanging,
                     section.stroke_assumption);
}

std::optional<TimeDomainSection> section_of(const io::Case& antenna,
                                            std::optional<design::TimeDomainStudy> study) {
  if (!study) return std::nullopt;
  return TimeDomainSection{std::move(*study), io::demand_assumption(antenna),
                           io::loose_stribeck_text(*antenna.friction_curve)};
}

std::string limit_cycle_remark(const TimeDomainSection& section) {
  const double allowed = section.options.allowed_limit_cycle;
  const auto& limit_cycles = section.result.limit_cycles;
  if (design::is_limit_cycle_free(limit_cycles, allowed)) return "";
  return fmt::format(
      "On the nonlinear antenna it {}: `boresight tune` searches for a controller free of limit "
      "cycles.",
      limit_cycle_text(limit_cycles, allowed));
}

std::string decide(const TimeDomainSection& section) {
  const double allowed = section.options.allowed_limit_cycle;
  const double rms = section.own().simulated_rms() / millidegree;
  // No other did either: such a controller is never put before one that did.
  if (!std::isfinite(rms)) {
    return fmt::format(
        "No controller completed its run on the nonlinear antenna in {:.3g} m/s of wind: "
        "commission none before the cause is known.",
        section.wind_speed);
  }
  if (!design::is_limit_cycle_free(section.result.limit_cycles, allowed)) {
    const std::string evaluated_against = limit_cycle_text(section.result.limit_cycles, allowed);
    if (section.candidates.empty()) {
      return fmt::format(
          "On the nonlinear antenna {} has {:.3f} mdeg in wind, but {}. Measure the friction "
          "before commissioning it.",
          section.controller, rms, evaluated_against);
    }
    return fmt::format(
        "On the nonlinear antenna no controller that completes its run in wind is free of limit "
        "cycles: {} comes nearest with {:.3f} mdeg, but {}. Measure the friction before "
        "commissioning any.",
        section.controller, rms, evaluated_against);
  }
  // The recommended controller itself is named first: recommended_first.
  std::vector<std::string> sentences;
  for (const auto& candidate : section.candidates) {
    const design::WindResult &wind = candidate.result.wind, &chosen = section.result.wind;
    const double simulated = candidate.simulated_rms();
    const bool fit = std::isfinite(simulated) &&
                     design::is_limit_cycle_free(candidate.result.limit_cycles, allowed);
    const bool lower =
        simulated < section.own().simulated_rms() || wind.predicted_rms < chosen.predicted_rms;
    if (fit || !lower) continue;
    sentences.push_back(fmt::format(
        "Not {}, with {:.3f} mdeg on the linear plant: on the nonlinear antenna {}.",
        candidate.controller, wind.predicted_rms / millidegree, first_text(candidate, allowed)));
  }
  if (std::string stroke = assumed_stroke(section); !stroke.empty()) {
    sentences.push_back(std::move(stroke));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

std::string conclude(const TimeDomainSection& section) {
  std::string text = conclude_choice(section) + conclude_wind(section) + integration_text(section);
  for (const auto& limit_cycles : section.result.limit_cycles) {
    text += limit_cycle_text(limit_cycles, section.options.allowed_limit_cycle);
  }
  const auto& reversal = section.result.reversal;
  if (reversal && reversal->status == RunStatus::complete) {
    text += fmt::format(" Peak error at a velocity reversal at tracking rate: {:.1f} mdeg.",
                        reversal->boresight_error / millidegree);
  }
  for (const auto& sentence :
       {slew_not_achievable(section), assumed_stroke(section), section.friction_doubt}) {
    if (!sentence.empty()) text += " " + sentence;
  }
  return text;
}

}  // namespace boresight::app
