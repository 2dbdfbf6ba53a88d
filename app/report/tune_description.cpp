#include <algorithm>
#include <string>
#include <vector>

#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/tune_description.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/io/description/design_results.hpp>
#include <boresight/io/description/loop_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>
#include <boresight/io/description/wind_mast_description.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr io::NumberForm above_zero{.above = 0.0, .finite = true};

// A gain of a controller as the case writes it.
struct WrittenGain {
  std::string symbol, name, value;
};

// Up to which wind a controller meets one budget.
struct BudgetLimit {
  design::PointingBudget budget;
  double wind_speed = 0.0;  // m/s
};

void describe_goals(io::Visitor& v, const TuneSection& section) {
  const design::Constraints& goals = section.goals;
  const bool over_quantile = section.objective.kind == design::ObjectiveKind::quantile;
  io::describe_breaks(v, goals);
  v.number("control_effort", goals.control_effort, unit::radian_per_second,
           "Largest rms of the noise-driven valve command.", above_zero);
  v.number("bandwidth", goals.bandwidth, unit::hertz_of_radians,
           "Least, of the position loop; null: none asked for.");
  v.number("static_encoder_error", goals.static_encoder_error, unit::millidegree,
           "Largest that leakage leaves at rest in the mean wind; null: no goal.",
           {.minimum = 0.0});
  v.number("sensitivity_peak_standstill",
           goals.standstill ? std::optional(goals.standstill->sensitivity_peak) : std::nullopt,
           unit::ratio, "Largest Ms at the valve command near standstill; null: no goal.");
  v.numbers("standstill_friction",
            goals.standstill ? goals.standstill->friction : std::vector<double>{},
            {.suffix = "N_m_s_per_rad"},
            "Viscous frictions that dry friction amounts to in small motions, for that goal.",
            above_zero);
  v.number("crest_factor", goals.ask_for_gusts() ? std::optional(goals.crest_factor) : std::nullopt,
           unit::ratio, "Times the rms in gusts; null: saturation is no goal.");
  v.number("gust_demand", goals.gust_demand, unit::radian_per_second,
           "Largest valve command in gusts; null: no goal.");
  v.number("gust_torque", goals.gust_torque, unit::newton_metre,
           "Largest motor torque in gusts; null: no goal.");
  v.number("boresight_rms", section.boresight_rms_goal, unit::millidegree,
           "Largest boresight error at the first wind speed; null: no goal.");
  v.text("objective", design::to_string(section.objective.kind),
         "What is made least over the plants: nominal, expected, worst_case, quantile.");
  v.number("quantile", over_quantile ? std::optional(section.objective.quantile) : std::nullopt,
           unit::ratio, "Fraction of the plants; null for another objective.");
  v.word("rms_over", section.minimises_climate ? "climate" : "design_speed",
         {"design_speed", "climate"}, "Wind in which the rms that is made least is taken.");
}

void describe_mission(io::Visitor& v, const TuneSection& section) {
  v.list("bands", section.bands, "Radio bands.", [&](const design::PointingBand& band) {
    v.text("name", band.name, "Its name.");
    v.number("frequency", band.frequency, unit::hertz, "Its frequency.", above_zero);
    v.number("beamwidth", band.beamwidth, unit::millidegree, "Half-power beamwidth.", above_zero);
    v.text_or_null("illumination", band.illumination,
                   "Illumination that the beamwidth is computed from; null if its factor is "
                   "stated.");
  });
  v.list("budgets", section.budgets, "Pointing budgets.",
         [&](const design::PointingBudget& budget) {
           v.text("name", budget.name, "Its name.");
           v.text("band", budget.band, "Its band.");
           v.text("convention", budget.convention, "What the loss is taken of.");
           v.number("rms", budget.rms, unit::millidegree, "Error of one axis.", above_zero);
           v.number("wind_speed", budget.wind_speed, unit::metre_per_second,
                    "Up to which the budget must be met; null: it need not be met.");
         });
}

std::string_view status_of(const TunedController& row) {
  switch (row.design.tuning.status) {
    case design::TuningStatus::optimal:
      return row.constraints_met ? "goals met" : "goals missed";
    case design::TuningStatus::infeasible:
      return "goals missed";
    case design::TuningStatus::unstable:
      break;
  }
  return "no stable controller";
}

void describe_losses(io::Visitor& v, const TuneSection& section, const TunedController& row) {
  const auto loss = [](const std::optional<double>& rms, const design::PointingBand& band) {
    return rms ? std::optional(design::pointing_loss_db(*rms, band.beamwidth,
                                                        design::LossConvention::mean_loss_two_axes))
               : std::nullopt;
  };
  v.list("bands", section.bands, "Losses, one a radio band.",
         [&](const design::PointingBand& band) {
           v.text("name", band.name, "Its name.");
           v.number("mean_loss_two_axes", loss(row.boresight_rms, band), unit::decibel_as_kept,
                    "Mean loss with both axes equally in error, by a parabola that does not hold "
                    "beyond 3 dB; texts say > 3 there.");
           v.number("climate_mean_loss_two_axes", loss(row.climate_rms, band),
                    unit::decibel_as_kept, "The same, expected over the wind climate.");
         });
}

void describe_limits(io::Visitor& v, const TuneSection& section, const TunedController& row) {
  std::vector<BudgetLimit> limits;
  for (std::size_t i = 0; i < row.speed_limits.size(); ++i) {
    limits.push_back({section.budgets[i], row.speed_limits[i]});
  }
  v.list("budgets", limits, "One a pointing budget.", [&](const BudgetLimit& one) {
    v.text("name", one.budget.name, "Its name.");
    v.text("band", one.budget.band, "Its band.");
    v.number(
        "wind_speed_limit", one.wind_speed, unit::metre_per_second,
        "Mean wind speed up to which the budget is met, by the effect of `simulated` where the "
        "controller ran, supply torque not counted; null: beyond 60 m/s.");
    describe_fraction_of_time(
        v, section.climate, std::min(one.wind_speed, section.torque_limited_wind_speed),
        "Fraction of the climate's time up to that speed, or up to the supply's if "
        "that is less; null without a climate or a stable controller.");
  });
}

void describe_gains(io::Visitor& v, const TuneSection& section, const TunedController& row) {
  std::vector<WrittenGain> gains;
  if (!v.by_example()) {
    const auto& descriptions = row.design.tuning.controller.structure.gains();
    const auto texts = section.gains_of(row);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      gains.push_back({descriptions[i].symbol, descriptions[i].name, texts[i]});
    }
  }
  v.list("gains_as_written", gains, "Gains in the units that the case writes them in.",
         [&](const WrittenGain& gain) {
           v.text("symbol", gain.symbol, "Its symbol.");
           v.text("name", gain.name, "Its name.");
           v.text("value", gain.value, "Number and unit.");
         });
}

void describe_prices(io::Visitor& v, const std::vector<design::ActiveConstraint>& limits) {
  v.list("limits", limits, "Active constraints with their shadow prices, largest first.",
         [&](const design::ActiveConstraint& limit) {
           v.text("constraint", design::describe(limit.goal),
                  "Which, where and at which frequency.");
           v.text("plant", limit.member.empty() ? "nominal" : limit.member, "On which plant.");
           v.number("ratio_to_limit", limit.goal.ratio, unit::ratio,
                    "Quantity over limit; limit over quantity where the limit is the least.");
           v.number("rms_per_limit", limit.shadow_price, unit::ratio,
                    "Per cent by which the rms falls for each per cent of the limit; the worst "
                    "ratio instead of the rms where the controller misses its goals.");
         });
}

void describe_controller(io::Visitor& v, const TuneSection& section, const TunedController& row) {
  const design::TuningResult& tuning = row.design.tuning;
  v.text("structure", row.structure, "As --structure names it.");
  v.word("tuned_for", to_string(row.tuned_for), {"present", "nominal", "robust"},
         "present: the gains that the antenna runs on now; nominal: tuned for its plant alone; "
         "robust: tuned for all of the ensemble.");
  v.number("design_wind_speed", row.wind_speed, unit::metre_per_second, "Mean wind speed.",
           above_zero);
  v.word("status", status_of(row), {"goals met", "goals missed", "no stable controller"},
         "What became of the goals.");
  v.flag("constraints_met", row.constraints_met,
         "Every constraint is met, by a robust controller on every plant.");
  v.flag("interrupted", tuning.interrupted,
         "The user stopped its tuning: the controller is the best found until then.");
  v.flag("recommended", recommended_tuned_controller(section, row.wind_speed) == &row,
         "The controller that the conclusions name at its wind speed, the nonlinear antenna "
         "considered.");
  v.number("boresight_rms", row.boresight_rms, unit::millidegree,
           "Boresight error at the wind speed; null without a stable controller.");
  v.number(
      "climate_boresight_rms", row.climate_rms, unit::millidegree,
      "Root of the mean square of the boresight error over the site's wind climate; null if the "
      "case states none.");
  describe_losses(v, section, row);
  describe_limits(v, section, row);
  describe_gains(v, section, row);
  describe_prices(v, tuning.limits);
  v.group_if("design", row.stable(),
             "The controller with its verification; null without a stable one.",
             [&] { describe(v, row.design); });
  v.group_if("simulated", row.in_time.has_value(),
             "On the nonlinear antenna at that wind speed; null where it did not run.", [&] {
               const ControllerInTime run = row.in_time.value_or(ControllerInTime{});
               v.number(
                   "budget_rms", row.budget_rms(), unit::millidegree,
                   "What budgets are compared with: the larger of the linear and the simulated "
                   "rms, limit cycle added in quadrature; null if a run did not complete.");
               v.flag("limit_cycle_free", run.limit_cycle_free,
                      "No limit cycle beyond the allowed amplitude.");
               v.object("effect", row.effect(), "Beyond the linear rms.");
               v.object("expected_rms", run.expected,
                        "Over several records of wind; null if there was but one.");
             });
  v.object("ensemble", row.ensemble,
           "Evaluated with fixed gains on every member of the ensemble; null without a stable "
           "controller.");
}

}  // namespace

void describe(io::Visitor& v, const TuneSection& section) {
  v.defined_as("tuned", "What the command tune found: every controller, evaluated.");
  v.texts("structures", section.structures, "What was tuned.", {.minimum = 1});
  v.numbers("wind_speeds", section.wind_speeds, unit::metre_per_second,
            "The design's wind speeds, and those up to which budgets must be met.", above_zero,
            {.minimum = 1});
  v.word("wind_model", plant::to_string(section.wind_model), {"uniform", "vickery", "coherence"},
         "Model of the wind torque.");
  v.group("constraints", "What every controller must meet, and what is made least.",
          [&] { describe_goals(v, section); });
  describe_mission(v, section);
  v.number("torque_limited_wind_speed", section.torque_limited_wind_speed, unit::metre_per_second,
           "Mean wind speed whose mean torque takes what friction and offset leave of the "
           "supply's; null: none does.");
  v.text("ensemble_source", to_string(section.ensemble_source),
         "What the plants of the ensemble were drawn from.");
  v.count("ensemble_members", section.ensemble_size, "Its plants.");
  v.count("starts", section.starts, "Random starts of each search.", {.minimum = 1});
  v.list("controllers", section.controllers,
         "One a structure, purpose and wind speed; at the sky, one axis.",
         [&](const TunedController& row) { describe_controller(v, section, row); });
  v.texts("not_run", section.not_run_texts(), "Tunings that an interrupt left out.");
  v.list("shortfalls", section.shortfalls, "What cannot be reached (exit code 3).",
         [&](const Shortfall& one) {
           v.text("infeasible", one.infeasible, "What it is.");
           v.text("closest", one.closest, "What comes nearest.");
         });
  v.optional_members(section.wind_mast, [&](const plant::WindMast& mast) {
    v.object("wind_mast", mast, "Where the case names one.");
  });
}

}  // namespace boresight::app
