#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/redesign/needed_budgets.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/climate_wording.hpp>
#include <boresight/app/report/loss_wording.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/table_columns.hpp>
#include <boresight/app/report/text_input_effects.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/report/text_state_space.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/io/description/loop_results.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using design::Design;
constexpr std::size_t valve = 1;  // of control::loop_breaks
constexpr std::size_t position = 2;

std::string mdeg(double angle) {
  return std::isfinite(angle) ? fmt::format("{:.4f}", angle / millidegree) : "-";
}

std::string decibel(double factor) {
  return std::isfinite(factor) && factor > 0.0 ? fmt::format("{:.1f}", 20.0 * std::log10(factor))
                                               : "none";
}

std::string verdict(const Design& design) {
  if (design.tuning.status == design::TuningStatus::unstable) return "none stable";
  if (design.tuning.status == design::TuningStatus::infeasible) return "infeasible";
  return design.verification.passed ? "ok" : "NOT VERIFIED";
}

// A wind speed limit beyond the search is infinite.
std::string speed(double limit, double unit) {
  return std::isfinite(limit) ? fmt::format("{:.{}f}", unit * limit, unit == 1.0 ? 2 : 1)
                              : fmt::format("> {:g}", 60.0 * unit);
}

std::string finite(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "none";
}

Document gains_part(const TuningSection& section) {
  const auto& controller = section.design.tuning.controller;
  if (controller.structure.state_space() != nullptr) {
    return wrapped(fmt::format("{}. Other interpretations and other flywheels are tuned with {}.",
                               state_space_text(controller.structure), section.loops->structure),
                   "  ");
  }
  const auto& descriptions = control::gain_descriptions(controller.structure);
  std::vector<std::vector<std::string>> rows{{"gain", "value", "unit", "searched"}};
  for (std::size_t i = 0; i < controller.gains.size(); ++i) {
    const auto& gain = descriptions[i];
    rows.push_back({fmt::format("{} {}", gain.symbol, gain.name),
                    fmt::format("{:.5g}", controller.gains[i]), std::string(gain.unit),
                    fmt::format("{:g} .. {:g}", gain.lower, gain.upper)});
  }
  return table(rows);
}

// Where a loop's gain is 1, the last for its bandwidth.
std::string crossovers_text(const control::Margins& margins) {
  std::vector<std::string> texts;
  for (const auto& crossover : margins.gain_crossovers) {
    texts.push_back(fmt::format("{:.3g}", crossover.frequency / two_pi));
  }
  return texts.empty() ? "none" : fmt::format("{}", fmt::join(texts, ", "));
}

Document breaks_part(const TuningSection& section) {
  std::vector<std::vector<std::string>> rows{
      {"loop cut at", "Ms", "limit", "at Hz", "crossover Hz"}};
  const auto append = [](std::vector<std::string>& row, const std::vector<std::string>& cells) {
    row.insert(row.end(), cells.begin(), cells.end());
  };
  append(rows.front(), columns_of(control::Margins{}).headings);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    if (!control::has_break(section.design.tuning.controller, control::loop_breaks[b])) continue;
    const auto& peak = section.design.verification.peaks[b];
    const auto& margins = section.design.margins[b];
    rows.push_back({std::string(control::to_string(control::loop_breaks[b])),
                    fmt::format("{:.4f}", peak.upper),
                    fmt::format("{:g}", section.goals.sensitivity_peak[b]),
                    finite(peak.frequency / two_pi, 3), crossovers_text(margins)});
    append(rows.back(), columns_of(margins).cells);
  }
  return table(rows);
}

// Gusts and torque behind the rms values.
Document wind_part(const TuningSection& section) {
  const auto gusts = plant::site_gusts(section.wind_site);
  Document text = wrapped(
      fmt::format("Gusts by the {} spectrum, {:.1f} % of the mean speed rms; torque coefficient "
                  "{:.4g}{}.",
                  plant::to_string(gusts.kind),
                  100.0 * std::sqrt(plant::gust_variance(gusts, section.design_speed)) /
                      section.design_speed,
                  section.wind_site.torque_coefficient,
                  section.wind_attitude
                      ? fmt::format(", from its table at yaw {:.4g} deg and elevation {:.4g} deg",
                                    section.wind_attitude->yaw / (1e3 * millidegree),
                                    section.wind_attitude->elevation / (1e3 * millidegree))
                      : ""),
      "  ");
  if (section.wind_mast) text += wrapped(mast_in_words(*section.wind_mast), "  ");
  return text;
}

std::string ensemble_text(const design::EnsembleResult& ensemble, std::string_view source,
                          const design::Constraints& goals) {
  const auto& worst = ensemble.members[ensemble.worst];
  const double peak = *std::ranges::max_element(worst.sensitivity_peaks);
  return fmt::format(
      "The same gains on {} plants {}: {} stable, {} meet every constraint; rms {} .. {} mdeg, "
      "median {}, 95 % below {}. The worst, {}, {}.",
      ensemble.members.size(), source, ensemble.stable, ensemble.within_constraints,
      mdeg(ensemble.min_rms), mdeg(ensemble.largest_rms), mdeg(ensemble.median_rms),
      mdeg(ensemble.high_rms), worst.name,
      worst.stable
          ? fmt::format("has Ms {:.3f}, limit {:g}, and control effort {:.3f} rad/s, limit {:g}",
                        peak, goals.sensitivity_peak[0], worst.control_effort, goals.control_effort)
          : "is unstable");
}

// "0.869 (0.853 to 0.883)".
std::string probability_text(const design::EstimatedNumber& found) {
  return fmt::format("{:.3f} ({:.3f} to {:.3f})", found.value, found.lower, found.upper);
}

std::string overshoot_text(const design::EnsembleCurves& curves) {
  const auto percent = [](double fraction) { return fmt::format("{:.0f} %", 100.0 * fraction); };
  const auto range = [&](const design::StepOverEnsemble& step) {
    return fmt::format("{}, up to {} on the stable plants", percent(step.overshoot()),
                       percent(step.largest_overshoot()));
  };
  const std::string text = "Step overshoot: position loop " + range(curves.position_step);
  if (curves.rate_step.time.size() == 0) return text + ".";
  return fmt::format("{}; rate loop {}.", text, range(curves.rate_step));
}

// "24/30": plants of the ensemble on which a budget is met where it is needed.
std::string plants_text(const TuningSection& section, const BudgetResult& result) {
  if (!result.plants_met || !section.ensemble) return "-";
  return fmt::format("{}/{}", *result.plants_met, section.ensemble->members.size());
}

// What the antenna's own gains do, or what stands for them.
Document present_part(const TuningSection& section) {
  if (section.present.empty()) return {};
  std::vector<std::vector<std::string>> rows{
      {"compared with", "rms mdeg", "S rate", "S valve", "S pos.", "effort rad/s", "check"}};
  for (const auto& present : section.present) {
    const Design& design = present.design;
    std::vector<std::string> cells{present_label(present.structure, present.retuned)};
    if (design.tuning.status == design::TuningStatus::unstable) {
      cells.insert(cells.end(), 5, "-");
      cells.emplace_back("UNSTABLE");
    } else {
      cells.push_back(mdeg(design.boresight_rms));
      for (const auto& peak : design.verification.peaks) cells.push_back(finite(peak.upper, 3));
      cells.push_back(fmt::format("{:.3f}", design.control_effort));
      cells.push_back(design.verification.passed ? "ok" : design.verification.failure);
    }
    rows.push_back(std::move(cells));
  }
  Document text = table(rows, "lrrrrrl") + "\n";
  return section.present.front().retuned ? text : essential(std::move(text));
}

}  // namespace

std::string tuning_heading(const TuningSection& section) {
  return fmt::format("Tuned loops: {}, as built, {:.3g} m/s, wind model {}", section.name,
                     section.design_speed, plant::to_string(section.wind_model));
}

// The members of the ensemble include corners and are no random sample, nor are there many.
Document robustness_part(const TuningSection& section) {
  if (!section.ensemble || !section.constraints_met) return {};
  return wrapped(
      fmt::format("Constraints met: {} of {} ensemble members; sampled plants with probability {}.",
                  section.ensemble->within_constraints, section.ensemble->members.size(),
                  probability_text(*section.constraints_met)),
      "  ");
}

Document seeds_part(const TuningSection& section) {
  if (section.seeds.empty()) return {};
  std::vector<std::string> seeds;
  for (const auto& seed : section.seeds) {
    seeds.push_back(mdeg(seed.boresight_rms) + (seed.verified ? "" : " (not verified)"));
  }
  return wrapped(fmt::format("From {} seeds: {} mdeg; {} of them within 1 % of the best.",
                             seeds.size(), fmt::join(seeds, ", "), section.seeds_within_1_percent),
                 "  ");
}

Document document_of(const TuningSection& section) {
  const Design& design = section.design;
  const auto& check = design.verification;
  Document text = heading(tuning_heading(section));
  text += present_part(section);
  if (design.tuning.status == design::TuningStatus::unstable) {
    return text + essential(wrapped(fmt::format("No stable controller among {} tried.",
                                                design.tuning.evaluations),
                                    "  "));
  }
  if (design.tuning.status == design::TuningStatus::infeasible) {
    text += essential(
        wrapped(fmt::format("INFEASIBLE: no controller found meets every constraint. Shown is the "
                            "nearest; it exceeds its worst limit by {:.3g} %.",
                            100.0 * (design.tuning.worst_constraint - 1.0)),
                "  "));
  }
  text += essential(gains_part(section) + "\n" + breaks_part(section) + robustness_part(section) +
                    "\n");
  text += wrapped(
      fmt::format("Rms {} mdeg at the sky (wind {}, sensor noise {}); control effort "
                  "{:.3f} rad/s, limit {:g}. Active constraints: {}.{}",
                  mdeg(design.boresight_rms), mdeg(design.wind_rms), mdeg(design.noise_rms),
                  design.control_effort, section.goals.control_effort,
                  design.tuning.active_constraints.empty()
                      ? "none"
                      : fmt::format("{}", fmt::join(design.tuning.active_constraints, "; ")),
                  design.tuning.gains_at_bound.empty()
                      ? ""
                      : fmt::format(" At the search limit: {}.",
                                    fmt::join(design.tuning.gains_at_bound, ", "))),
      "  ");
  text += wrapped(
      fmt::format("{}: largest real part of the eigenvalues {:.4f} 1/s (position loop open) and "
                  "{:.4f} 1/s (closed); the rational dead time omits {:.1e} of the return "
                  "difference; rms by Lyapunov equations and by the spectrum differ by {:.3f} %.",
                  check.passed ? "Verified by independent code"
                               : fmt::format("NOT VERIFIED ({})", check.failure),
                  check.stability.rate_loop_abscissa, check.stability.closed_loop_abscissa,
                  check.stability.dead_time_residue, 100.0 * check.rms_disagreement),
      "  ");
  text += seeds_part(section) + "\n";
  if (section.ensemble)
    text += wrapped(ensemble_text(*section.ensemble, section.ensemble_source, section.goals), "  ");
  if (section.curves) text += wrapped(overshoot_text(*section.curves), "  ");
  if (section.ensemble) text += "\n";
  std::vector<std::vector<std::string>> rows{{"wind model, same gains", "rms mdeg"}};
  for (const auto& alternative : section.wind_alternatives) {
    rows.push_back(
        {std::string(plant::to_string(alternative.model)), mdeg(alternative.boresight_rms)});
  }
  rows.push_back({"structural flexure beyond the encoder alone", mdeg(section.flexure_rms)});
  rows.push_back(
      {"static boresight error in the mean wind (not in the rms)", mdeg(section.static_error)});
  rows.push_back({"static encoder error by leakage in the mean wind (not in the rms)",
                  mdeg(section.static_encoder_error)});
  text += table(rows) + wind_part(section) + "\n";
  rows = {{"band", "beamwidth mdeg", "mean loss dB, two equal axes", "static error would add"}};
  for (const auto& loss : section.losses) {
    rows.push_back({fmt::format("{} {:g} GHz", loss.band.name, loss.band.frequency / 1e9),
                    fmt::format("{:.3f}", loss.band.beamwidth / millidegree),
                    loss_text(loss.mean_loss_db), loss_text(loss.static_error_db)});
  }
  const bool far_out = std::ranges::any_of(section.losses, [](const auto& loss) {
    return std::max(loss.mean_loss_db, loss.static_error_db) > largest_parabola_loss;
  });
  text += table(rows) +
          wrapped(
              "Losses exclude the static error in the mean wind, structural flexure included; "
              "remove it "
              "by a boresight scan.",
              "  ") +
          (far_out ? wrapped(beyond_the_parabola(), "  ") : Document()) + "\n";
  const auto& mast = section.wind_mast;
  rows = {
      {"budget", "band", "convention", "rms mdeg", "met up to m/s" + mast_column(mast), "km/h"}};
  const bool needed = std::ranges::any_of(
      section.budgets, [](const BudgetResult& one) { return one.budget.wind_speed.has_value(); });
  if (needed) {
    rows.front().insert(rows.front().end(),
                        {"required m/s" + mast_column(mast), "there on plants"});
  }
  const bool probable = std::ranges::any_of(
      section.budgets, [](const BudgetResult& one) { return one.probability.has_value(); });
  if (probable) rows.front().emplace_back("probability (95 %)");
  const bool climate = !section.climate.empty();
  if (climate) rows.front().emplace_back("of the time");
  for (const auto& result : section.budgets) {
    rows.push_back(
        {result.budget.name, result.budget.band, result.budget.convention, mdeg(result.budget.rms),
         speed(result.wind_speed_limit, 1.0) + speed_at_mast(mast, result.wind_speed_limit),
         speed(result.wind_speed_limit, 3.6)});
    const auto& need = result.budget.wind_speed;
    if (needed) {
      rows.back().push_back(need ? fmt::format("{:.3g}{}", *need, speed_at_mast(mast, *need))
                                 : "-");
      rows.back().push_back(plants_text(section, result));
    }
    if (probable) {
      rows.back().push_back(result.probability ? probability_text(*result.probability) : "-");
    }
    if (climate) {
      rows.back().push_back(percent_of_time(section.climate, reached_wind_speed(section, result)));
    }
  }
  text += essential(table(rows, "lllrrrrrrr"));
  if (std::isfinite(section.torque_limited_wind_speed)) {
    text += wrapped(fmt::format("Fixed gains, supply torque ignored: at {:.1f} m/s the mean wind "
                                "takes all of it that friction and offset leave.",
                                section.torque_limited_wind_speed),
                    "  ");
  }
  if (climate) {
    text += wrapped(
        fmt::format(
            "Of the time: fraction of the climate's time with winds up to that speed, or to the "
            "end of the supply torque if lower. The climate's highest speed is {:.4g} m/s.",
            design::highest_speed(section.climate)),
        "  ");
  }
  return text + input_effects_part(section);
}

std::string interpretations_heading(const std::vector<InterpretationResult>& interpretations) {
  return std::ranges::any_of(interpretations, &InterpretationResult::contradicts)
             ? "Contradictory inputs: result of each interpretation"
             : "Open inputs: result of each interpretation";
}

namespace {

// Conditions of figures evaluated on one plant.
Document linear_part() {
  return wrapped("rms mdeg: linear loops, each tuned and evaluated on its own plant only.", "  ");
}

bool overdamped(const Design& design) {
  return design.hydraulic_mode.damping_ratio > 1.0;
}

// Meaning of a damping ratio above 1.
Document overdamped_part() {
  return wrapped(
      "Damping above 1: two real poles p1, p2 with frequency sqrt(p1 p2)/(2 pi), possibly another "
      "mode than in rows with less friction.",
      "  ");
}

// Choices made for rigid masses, with which the flexible antenna does not resonate as measured.
Document missed_part(const std::vector<InterpretationResult>& interpretations) {
  std::vector<std::string> missed;
  double wanted = 0.0;
  for (const auto& choice : interpretations) {
    const auto frequency = choice.missed_resonance();
    if (!frequency) continue;
    wanted = choice.wanted_frequency.value_or(wanted);
    missed.push_back(fmt::format("'{}' ({:.3f} Hz)", choice.name, *frequency));
  }
  if (missed.empty()) return {};
  return wrapped(fmt::format("These do not resolve the contradiction, as the flexible antenna "
                             "still misses the measured {:.3g} Hz: {}.",
                             wanted, fmt::join(missed, ", ")),
                 "  ");
}

}  // namespace

Document document_of(const std::vector<InterpretationResult>& interpretations) {
  Document text = heading(interpretations_heading(interpretations));
  std::vector<std::vector<std::string>> rows{{"interpretation", "K N.m/rad", "J kg.m2", "R",
                                              "hydraulic Hz", "damping", "rms mdeg", "verified"}};
  for (const auto& choice : interpretations) {
    std::vector<std::string> row{choice.name, fmt::format("{:.2f}", choice.oil_stiffness),
                                 fmt::format("{:.3f}", choice.reflected_inertia),
                                 choice.motor_to_load_ratio > 0.0
                                     ? fmt::format("{:.2f}", choice.motor_to_load_ratio)
                                     : "none"};
    if (choice.design) {
      const Design& design = *choice.design;
      row.insert(row.end(), {fmt::format("{:.3f}", design.hydraulic_mode.frequency),
                             fmt::format("{:.3f}", design.hydraulic_mode.damping_ratio),
                             mdeg(design.boresight_rms), verdict(design)});
    } else {
      row.insert(row.end(), {"-", "-", "-", "no plant"});
    }
    rows.push_back(std::move(row));
  }
  text += table(rows);
  for (const auto& choice : interpretations) {
    text += wrapped(
        fmt::format(
            "{}: {}.{}", choice.name, choice.says,
            choice.impossible.empty() ? "" : fmt::format(" Not possible: {}.", choice.impossible)),
        "  ");
  }
  const bool attitudes =
      std::ranges::any_of(interpretations, &InterpretationResult::other_attitude);
  text +=
      wrapped(fmt::format("Structural frequencies stay fixed, so a lighter antenna is softer{}.",
                          attitudes ? ", except in an alternative that keeps the springs" : ""),
              "  ");
  text += linear_part();
  if (std::ranges::any_of(interpretations, [](const InterpretationResult& choice) {
        return choice.design && overdamped(*choice.design);
      })) {
    text += overdamped_part();
  }
  return text + missed_part(interpretations);
}

Document document_of(const MatchingSection& section) {
  Document text = heading("Inertia matching: re-tuned at each motor inertia");
  for (const auto& series : section.series) {
    text += subheading(fmt::format("{}; {}", control::to_string(series.structure),
                                   series.friction.empty()
                                       ? friction_text(series)
                                       : fmt::format("friction: {}, {:.3g} N.m.s/rad",
                                                     series.friction, series.viscous_friction)));
    std::vector<std::vector<std::string>> rows{
        {"motors", "disks", "R", "J kg.m2", "hydr. Hz", "damping", "S rate", "S valve", "S pos.",
         "PM valve", "GM valve", "PM pos.", "GM pos.", "rms mdeg", "check"}};
    for (std::size_t i = 0; i < section.rows.size(); ++i) {
      const MatchingRow& row = section.rows[i];
      const Design& design = series.designs[i];
      std::vector<std::string> cells{row.label,
                                     fmt::format("{:.2f}", row.disks),
                                     fmt::format("{:.3f}", row.motor_to_load_ratio),
                                     fmt::format("{:.3f}", row.reflected_inertia),
                                     fmt::format("{:.3f}", design.hydraulic_mode.frequency),
                                     fmt::format("{:.3f}", design.hydraulic_mode.damping_ratio)};
      if (design.tuning.status == design::TuningStatus::unstable) {
        cells.insert(cells.end(), 8, "-");
      } else {
        for (const auto& peak : design.verification.peaks) {
          cells.push_back(fmt::format("{:.3f}", peak.upper));
        }
        for (const std::size_t loop : {valve, position}) {
          cells.push_back(fmt::format("{:.1f}", design.margins[loop].phase_margin_deg));
          cells.push_back(decibel(design.margins[loop].increasing_gain_margin));
        }
        cells.push_back(mdeg(design.boresight_rms));
      }
      cells.push_back(verdict(design));
      rows.push_back(std::move(cells));
    }
    text += table(rows);
  }
  text += "\n";
  text += wrapped(
      "S: maximum sensitivity Ms with the loop cut at rate loop alone, valve command, position "
      "loop; PM, GM: phase margin in degrees, gain margin in dB.",
      "  ");
  text += linear_part();
  if (std::ranges::any_of(section.series, [](const MatchingSeries& series) {
        return std::ranges::any_of(series.designs, overdamped);
      })) {
    text += overdamped_part();
  }
  return text;
}

}  // namespace boresight::app
