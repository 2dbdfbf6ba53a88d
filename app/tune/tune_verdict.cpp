#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/report/assumed_demand.hpp>
#include <boresight/app/report/climate_wording.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/loss_wording.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/tune/controllers_in_time.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/control/analysis/delay_limited_bandwidth.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/studies/gains_at_bounds.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using design::GoalKind;
using design::NormalisedConstraint;

bool tuned(const TunedController& row) {
  return row.tuned_for != TunedFor::present;
}

std::vector<const TunedController*> rows_at(const TuneSection& section, double wind_speed) {
  std::vector<const TunedController*> rows;
  for (const auto& row : section.controllers) {
    if (tuned(row) && row.wind_speed == wind_speed) rows.push_back(&row);
  }
  return rows;
}

// A goal's limit and what the controller has instead, in the units of reports.
std::string found_and_limit(const NormalisedConstraint& goal, const design::Constraints& goals) {
  const std::size_t b = goal.loop_break ? static_cast<std::size_t>(*goal.loop_break) : 0;
  const auto maximum = [&](double limit, const char* unit) {
    return fmt::format("{:.4g}{}, limit at most {:.4g}", limit * goal.ratio, unit, limit);
  };
  const auto minimum = [&](double limit, double found, const char* unit) {
    return fmt::format("{:.4g}{}, limit at least {:.4g}", found, unit, limit);
  };
  constexpr double degrees = 180.0 / std::numbers::pi;
  switch (goal.kind) {
    case GoalKind::sensitivity_peak:
      return maximum(goals.sensitivity_peak.at(b), "");
    case GoalKind::control_effort:
      return maximum(goals.control_effort, " rad/s");
    case GoalKind::gain_margin: {
      const double limit = goals.gain_margin.at(b).value_or(1.0);
      return minimum(20.0 * std::log10(limit), 20.0 * std::log10(limit / goal.ratio), " dB");
    }
    case GoalKind::phase_margin: {
      const double limit = goals.phase_margin.at(b).value_or(0.0) * degrees;
      return minimum(limit, limit / goal.ratio, " deg");
    }
    case GoalKind::bandwidth: {
      const double limit = goals.bandwidth.value_or(0.0) / two_pi;
      return minimum(limit, limit / goal.ratio, " Hz");
    }
    case GoalKind::gust_demand:
      return maximum(goals.gust_demand.value_or(0.0), " rad/s");
    case GoalKind::gust_torque:
      return maximum(goals.gust_torque.value_or(0.0), " N.m");
    case GoalKind::static_encoder_error: {
      const double limit = goals.static_encoder_error.value_or(0.0);
      return fmt::format("{:.4g} mdeg, limit at most {:.4g}",
                         design::found_static_error(goal, limit) / millidegree,
                         limit / millidegree);
    }
    case GoalKind::standstill_peak:
      return maximum(goals.standstill ? goals.standstill->sensitivity_peak : 0.0, "");
  }
  return "";
}

// Whether one of its corners does nothing that a sampled controller can do.
bool has_idle_corner(const TuneSection& section, const TunedController& row) {
  return ends_beyond_sampling(row.design.tuning, control::sample_time_of(section.problem.delay));
}

// Every goal that stands in the way, once.
std::string standing_goals(const TunedController& row, const design::Constraints& goals) {
  std::vector<std::string> texts;
  for (const auto& limit : row.design.tuning.limits) {
    std::string text = fmt::format("{}{}: {}", design::describe(limit.goal),
                                   limit.member.empty() ? "" : ", on " + limit.member,
                                   found_and_limit(limit.goal, goals));
    if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
  }
  if (texts.empty()) texts = row.design.tuning.active_constraints;
  return fmt::format("{}", fmt::join(texts, "; "));
}

// Where a loop of one integrator and the delay alone has less than the bandwidth required.
std::string delay_text(const TuneSection& section) {
  const auto& goals = section.goals;
  const double delay = section.problem.delay, peak = goals.sensitivity_peak.back();
  if (!goals.bandwidth || !(delay > 0.0)) return "";
  const double reached = control::delay_limited_bandwidth(delay, peak);
  if (*goals.bandwidth <= reached) return "";
  return fmt::format(
      " With the delay of {:.3g} ms and Ms {:.3g}, a loop of one integrator around a plant without "
      "dynamics has a bandwidth of {:.3g} Hz, less than the {:.3g} Hz required. Require less, or "
      "shorten the delay.",
      1e3 * delay, peak, reached / two_pi, *goals.bandwidth / two_pi);
}

// Where no error at rest is allowed and no structure has an integral.
std::string integral_text(const TuneSection& section) {
  if (section.goals.static_encoder_error != 0.0) return "";
  std::vector<std::string> without;
  for (const auto& row : section.controllers) {
    if (!tuned(row)) continue;
    if (row.design.tuning.controller.structure.has_integral_action()) return "";
    if (std::ranges::find(without, row.structure) == without.end())
      without.push_back(row.structure);
  }
  return fmt::format(
      " A static encoder error of 0 needs an integral in the rate or position loop that acts on "
      "every error, which {} {} not have. Allow the error found, or take structures with "
      "integrals, such as PI, LL, DPF or FULL.",
      fmt::join(without, ", "), without.size() == 1 ? "does" : "do");
}

// The rms in wind that budgets are held against, and what else the nonlinear antenna adds.
std::string rms_text(const TunedController& row) {
  const double linear = row.boresight_rms / millidegree;
  if (!row.in_time) return fmt::format("{:.4f} mdeg", linear);
  if (!std::isfinite(row.in_time->rms())) {
    return fmt::format("{:.4f} mdeg on the linear plant", linear);
  }
  const double simulated = row.in_time->rms() / millidegree;
  std::string text =
      simulated > linear
          ? fmt::format("{:.4f} mdeg on the nonlinear antenna ({:.4f} linear)", simulated, linear)
          : fmt::format("{:.4f} mdeg on the linear plant ({:.4f} simulated)", linear, simulated);
  if (row.in_time->limit_cycles > 0.0) {
    text += fmt::format(", {:.4f} with the limit cycle", row.budget_rms() / millidegree);
  }
  return text;
}

// What the linear plant puts before the controller that is named, and why it is not the one.
std::string left_out_text(const TuneSection& section, const TunedController& named) {
  if (named.left_out()) {
    return fmt::format(" On the nonlinear antenna it {}, and no other {} controller is fit.",
                       evaluated_against(named), to_string(named.tuned_for));
  }
  std::vector<std::string> texts;
  for (const auto* row : rows_at(section, named.wind_speed)) {
    if (row->tuned_for != named.tuned_for || !row->usable() || !row->left_out() ||
        row->boresight_rms >= named.budget_rms()) {
      continue;
    }
    texts.push_back(fmt::format("{}, {:.4f} mdeg on the linear plant, {}", name_and_purpose(*row),
                                row->boresight_rms / millidegree, evaluated_against(*row)));
  }
  if (texts.empty()) return "";
  return fmt::format(" Excluded by the nonlinear antenna: {}.", fmt::join(texts, "; "));
}

// The controller that comes nearest to an rms that none reaches, behind the one recommended if that
// is another. `more_of`: what is said of a controller behind its rms.
template <typename MoreOf>
std::string nearest_text(const TuneSection& section, const TunedController& nearest,
                         const MoreOf& more_of) {
  const TunedController* recommended = recommended_tuned_controller(section, nearest.wind_speed);
  if (recommended == nullptr || recommended == &nearest) {
    return fmt::format("{} comes nearest with {}{}.{}", name_and_purpose(nearest),
                       rms_text(nearest), more_of(nearest), left_out_text(section, nearest));
  }
  return fmt::format(
      "{}, the recommended controller, has {}{}. {} comes nearest with {}, but {}.{}",
      name_and_purpose(*recommended), rms_text(*recommended), more_of(*recommended),
      name_and_purpose(nearest), rms_text(nearest),
      why_not_recommended(section, nearest, *recommended), left_out_text(section, *recommended));
}

// Goals that no controller of one wind speed and purpose meets.
void find_unmet_goals(const TuneSection& section, double speed, TunedFor purpose,
                      std::vector<Shortfall>& shortfalls) {
  const TunedController* nearest = nullptr;
  std::vector<std::string> names;
  bool any = false;
  for (const auto* row : rows_at(section, speed)) {
    if (row->tuned_for != purpose) continue;
    any = true;
    if (row->constraints_met) return;
    names.push_back(row->structure);
    if (row->stable() && (nearest == nullptr || row->design.tuning.worst_constraint <
                                                    nearest->design.tuning.worst_constraint)) {
      nearest = row;
    }
  }
  if (!any) return;
  const bool robust = purpose == TunedFor::robust;
  const auto plants =
      robust ? fmt::format("all {} ensemble members", section.ensemble_size) : "this antenna";
  if (nearest == nullptr) {
    shortfalls.push_back({fmt::format("No controller of {} within the search bounds stabilises {}.",
                                      fmt::join(names, ", "), plants),
                          "Widen the gain bounds, or check dead time and structural modes."});
    return;
  }
  const auto standing = nearest->design.tuning.limits.size();
  // Of a limit of 0 no percentage says anything.
  const double worst = nearest->design.tuning.worst_constraint;
  const std::string beyond =
      worst < 100.0 ? fmt::format(", {:.1f} % beyond its worst limits", 100.0 * (worst - 1.0)) : "";
  shortfalls.push_back(
      {fmt::format("No controller of {} meets every constraint at {:.3g} m/s{}{}.",
                   fmt::join(names, ", "), speed, robust ? " on " + plants : "",
                   standing > 1 ? ": the constraints are mutually incompatible" : ""),
       fmt::format("{} comes nearest{}: {}.{}{}{}", name_and_purpose(*nearest), beyond,
                   standing_goals(*nearest, section.goals),
                   assumed_demand(nearest->design.tuning, section.demand_assumption),
                   delay_text(section), integral_text(section))});
}

// The structures that were tuned, in the order of the table.
std::vector<std::string> structures_of(const TuneSection& section) {
  std::vector<std::string> names;
  for (const auto& row : section.controllers) {
    if (row.tuned_for == TunedFor::present) continue;
    if (std::ranges::find(names, row.structure) == names.end()) names.push_back(row.structure);
  }
  return names;
}

// Up to which wind speed a controller meets a budget.
std::string reached_text(const TuneSection& section, const TunedController& controller,
                         double limit) {
  return fmt::format(
      "; the budget is met up to {:.3g} m/s{}{}{}", limit, dish_and_mast(section.wind_mast, limit),
      controller.in_time ? " by simulation" : "", climate_text(section.climate, limit));
}

// Behind what no controller keeps: why those do not whose rms, at the wind speed of `best` and
// tuned for the same, is within it; empty where there is none, and the rms is the reason.
std::string barred_by_limit_cycle(const TuneSection& section, const TunedController& best,
                                  double rms) {
  bool any = false, seen = true;
  for (const auto* row : rows_at(section, best.wind_speed)) {
    if (row->tuned_for != best.tuned_for || !row->usable() || !row->in_time) continue;
    if (!std::isfinite(row->in_time->rms()) || !design::within_budget(row->wind_rms(), rms))
      continue;
    if (row->keeps(rms)) continue;
    any = true;
    seen = seen && row->in_time->limit_cycle_runs_complete;
  }
  if (!any) return "";
  return seen ? ": the controllers that meet it in wind limit-cycle beyond it"
              : ": the controllers that meet it in wind limit-cycle beyond it, or are not shown "
                "free of limit cycles";
}

void find_unreached_rms(const TuneSection& section, std::vector<Shortfall>& shortfalls) {
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    const design::PointingBudget& budget = section.budgets[i];
    if (!budget.wind_speed) continue;
    if (section.torque_limited_wind_speed < *budget.wind_speed) {
      shortfalls.push_back(
          {fmt::format(
               "The budget '{}' in band {} cannot be met up to {:.3g} m/s{} by any controller.",
               budget.name, budget.band, *budget.wind_speed,
               dish_and_mast(section.wind_mast, *budget.wind_speed)),
           fmt::format("At {:.1f} m/s the mean wind takes all supply torque that friction and "
                       "offset leave.",
                       section.torque_limited_wind_speed)});
      continue;
    }
    const TunedController* best = nearest_to_budget(section, budget.wind_speed);
    if (best == nullptr || best->keeps(budget.rms)) continue;
    const auto more_of = [&](const TunedController& controller) {
      return fmt::format(
          ", {} dB on two equal axes in band {}{}",
          loss_text(design::pointing_loss_db(controller.budget_rms(), budget.beamwidth,
                                             design::LossConvention::mean_loss_two_axes),
                    3),
          budget.band,
          controller.left_out() ? ""
                                : reached_text(section, controller, controller.speed_limits[i]));
    };
    const std::string barred = barred_by_limit_cycle(section, *best, budget.rms);
    shortfalls.push_back(
        {fmt::format("The budget '{}' in band {} ({:.4f} mdeg) {} up to {:.3g} m/s{} by {} ({}){}.",
                     budget.name, budget.band, budget.rms / millidegree,
                     barred.empty() ? "cannot be met" : "is met", *budget.wind_speed,
                     dish_and_mast(section.wind_mast, *budget.wind_speed),
                     barred.empty() ? "the tuned controllers" : "no tuned controller",
                     fmt::join(structures_of(section), ", "), barred),
         nearest_text(section, *best, more_of)});
  }
  if (!section.boresight_rms_goal) return;
  const double speed = section.wind_speeds.front();
  const TunedController* best = nearest_to_budget(section, speed);
  if (best == nullptr || best->keeps(*section.boresight_rms_goal)) return;
  const std::string barred = barred_by_limit_cycle(section, *best, *section.boresight_rms_goal);
  shortfalls.push_back({fmt::format("A boresight error of {:.4f} mdeg rms {} at {:.3g} m/s{}{}.",
                                    *section.boresight_rms_goal / millidegree,
                                    barred.empty() ? "cannot be met" : "is met", speed,
                                    barred.empty() ? "" : " by no tuned controller", barred),
                        nearest_text(section, *best, [](const TunedController&) { return ""; })});
}

}  // namespace

std::string name_and_purpose(const TunedController& row) {
  return fmt::format("{} ({})", row.structure, to_string(row.tuned_for));
}

std::string why_not_recommended(const TuneSection& section, const TunedController& other,
                                const TunedController& recommended) {
  std::vector<std::string> reasons;
  const auto points_worse = [&](double rms, double by_recommended) {
    reasons.push_back(fmt::format("has {:.4f} mdeg rms instead of {:.4f}", rms / millidegree,
                                  by_recommended / millidegree));
  };
  if (other.in_time && recommended.in_time) {
    const ControllerInTime &run = *other.in_time, &chosen = *recommended.in_time;
    if (const auto change = figure_change(recommended, other);
        change && change->lower <= 0.0 && change->upper >= 0.0) {
      return fmt::format(
          "is a tie over the same {} winds ({:+.1f} % rms, limit cycle included; 95 % {:+.1f} to "
          "{:+.1f} %)",
          chosen.expected->records, 100.0 * change->value, 100.0 * change->lower,
          100.0 * change->upper);
    }
    const bool has_larger_limit_cycle =
        run.limit_cycles * (1.0 - negligible_change) > chosen.limit_cycles;
    // The reason is the limit cycle, and not a negligible loss in wind.
    const double fraction = has_larger_limit_cycle ? negligible_change : 0.0;
    if (run.rms() > (1.0 + fraction) * chosen.rms()) points_worse(run.rms(), chosen.rms());
    if (has_larger_limit_cycle) {
      reasons.push_back(fmt::format("limit-cycles by +-{:.4f} mdeg instead of +-{:.4f}",
                                    run.limit_cycles / millidegree,
                                    chosen.limit_cycles / millidegree));
    }
  } else if (recommended.in_time) {
    reasons.emplace_back("was not run on the nonlinear antenna");
  } else if (other.boresight_rms > recommended.boresight_rms) {
    points_worse(other.boresight_rms, recommended.boresight_rms);
  }
  if (has_idle_corner(section, other) && !has_idle_corner(section, recommended)) {
    reasons.emplace_back("has a corner beyond half the sampling rate, where it has no effect");
  }
  const auto parts = [](const TunedController& row) {
    return row.design.tuning.controller.structure.parts();
  };
  if (reasons.empty() && parts(other) > parts(recommended)) {
    reasons.push_back(fmt::format("is better by no more than {:.0f} % with {} {} instead of {}",
                                  100.0 * negligible_change, parts(other),
                                  other.is_state_space() ? "states" : "gains", parts(recommended)));
  } else if (reasons.empty()) {
    reasons.push_back(fmt::format("is better by no more than {:.0f} %", 100.0 * negligible_change));
  }
  return fmt::format("{}", fmt::join(reasons, ", and "));
}

std::string ties_text(const design::TuningStudy& study, const TunedController& recommended) {
  std::vector<std::string> names;
  for (const auto* row : tied_with(study, recommended)) names.push_back(name_and_purpose(*row));
  if (names.empty()) return "";
  return fmt::format(
      "A tie with {}: {}, {}.", name_and_purpose(recommended), fmt::join(names, ", "),
      recommended.in_time && recommended.in_time->expected
          ? fmt::format("within {:.0f} %, or the 95 % interval of the difference "
                        "over the same {} winds, simulated",
                        100.0 * negligible_change, recommended.in_time->expected->records)
          : fmt::format("within {:.0f} %", 100.0 * negligible_change));
}

std::vector<std::string> TuneSection::not_run_texts() const {
  std::vector<std::string> texts;
  for (const auto& one : not_run) {
    texts.push_back(
        fmt::format("{}, {}, {:g} m/s", one.structure, to_string(one.tuned_for), one.wind_speed));
  }
  return texts;
}

TuneSection section_of(const io::Case& antenna, design::TuningStudy study) {
  TuneSection section{std::move(study),
                      io::GainUnits(antenna),
                      antenna.wind->mast,
                      io::demand_assumption(antenna),
                      {},
                      std::nullopt};
  section.shortfalls = find_shortfalls(section);
  return section;
}

std::vector<Shortfall> find_shortfalls(const TuneSection& section) {
  std::vector<Shortfall> shortfalls;
  // An interrupted study proves nothing infeasible.
  if (!section.not_run.empty()) return shortfalls;
  for (const auto& row : section.controllers) {
    if (row.design.tuning.interrupted) return shortfalls;
  }
  for (const double speed : section.wind_speeds) {
    const std::size_t before = shortfalls.size();
    find_unmet_goals(section, speed, TunedFor::nominal, shortfalls);
    // An objective over the ensemble asks for its constraints there.
    const bool asked = section.objective.kind != design::ObjectiveKind::nominal;
    if (asked && shortfalls.size() == before) {
      find_unmet_goals(section, speed, TunedFor::robust, shortfalls);
    }
  }
  find_unreached_rms(section, shortfalls);
  return shortfalls;
}

}  // namespace boresight::app
