#include <optional>
#include <string>
#include <vector>

#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/io/description/design_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>
#include <boresight/io/description/wind_mast_description.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr io::NumberForm positive{.minimum = 0.0};
constexpr io::NumberForm known{.finite = true};
constexpr io::KeyUnit inertia_unit{.suffix = "kg_m2"};
constexpr io::KeyUnit degree_per_second{.suffix = "deg_per_s", .divisor = unit::degree.divisor};
constexpr io::KeyUnit degree_per_second_squared{.suffix = "deg_per_s2",
                                                .divisor = unit::degree.divisor};

// A gain in the engineer's units.
struct WrittenGain {
  std::string symbol, name, value;
};

// A controller with its gains.
struct WrittenController {
  CandidateController controller;
  std::vector<std::string> gains;
};

// What the chosen controller does in a band.
struct BandLosses {
  std::string name;
  double loss = 0.0;
  std::optional<double> climate_loss;
};

// Up to which wind it meets a budget.
struct MetBudget {
  design::PointingBudget budget;
  double speed_limit = 0.0;
  std::optional<int> plants_met;
};

void describe_change(io::Visitor& v, const io::ChangeRow& change) {
  v.text("key", change.key, "The case's key.");
  v.text("from", change.before, "As the case has it.");
  v.text("to", change.after, "As the proposal has it.");
  v.text("basis", to_string(change.basis), "What the number rests on.");
  v.text_or_null("source", change.source, "Why.");
}

void describe_derived_quantity(io::Visitor& v, const io::DerivedChange& one) {
  v.text("quantity", one.quantity, "Which.");
  v.text("unit", one.unit, "Of before and after.");
  v.number("before", one.before, unit::ratio, "In that unit.");
  v.number("after", one.after, unit::ratio, "In that unit.");
  v.text("follows_from", one.follows_from, "Equation or rule.");
}

void describe_controller(io::Visitor& v, const WrittenController& written) {
  const CandidateController& controller = written.controller;
  std::vector<WrittenGain> gains;
  for (std::size_t i = 0; i < written.gains.size(); ++i) {
    const auto& gain = controller.design.tuning.controller.structure.gains().at(i);
    gains.push_back({gain.symbol, gain.name, written.gains[i]});
  }
  v.text("structure", controller.structure, "As asked for.");
  v.flag("constraints_met", controller.constraints_met,
         "Every constraint on the nominal plant and on each of the ensemble.");
  v.number(
      "ensemble_rms", controller.member_rms, unit::millidegree,
      "Root of the mean square of the boresight rms over the ensemble, of linear loops; null if a "
      "plant is unstable.");
  v.number("simulated_to_linear_rms", controller.simulated_to_linear_rms(), unit::ratio,
           "Simulated rms (expected_rms) over the linear one; 1 without a run, null if one did not "
           "complete.",
           positive);
  v.number(
      "compared_rms", controller.compared_rms(), unit::millidegree,
      "ensemble_rms times simulated_to_linear_rms, with the rms of the limit cycle in quadrature "
      "(amplitude over the root of 2): what controllers and proposals are compared by; null if "
      "one of them is.",
      positive);
  v.number("limit_cycle_amplitude", controller.effect().amplitude, unit::millidegree,
           "Half of peak to peak of the boresight, at rest or tracking; 0 without a run.", known);
  v.object("expected_rms", controller.expected,
           "Simulated in several records of wind; null if that was not asked for.");
  v.object("time_domain", controller.time_domain,
           "The controller on the proposal's nonlinear antenna; null if that was not asked for.");
  v.list("gains_as_written", gains, "In the engineer's units.", [&](const WrittenGain& gain) {
    v.text("symbol", gain.symbol, "Its symbol.");
    v.text("name", gain.name, "Its name.");
    v.text("value", gain.value, "Number with unit.");
  });
  v.group_if("design", controller.stable(),
             "On the proposal's nominal plant; null without a stable controller.",
             [&] { describe(v, controller.design); });
  v.object("ensemble", controller.ensemble, "With fixed gains; null without a stable controller.");
}

void describe_slew(io::Visitor& v, const SlewFigures& slew) {
  v.number("distance", slew.distance, unit::degree, "At the sky.", known);
  v.number("rate", slew.rate, degree_per_second, "Achieved.", known);
  v.number("rate_asked", slew.rate_asked, degree_per_second, "The case's.", known);
  v.number("acceleration", slew.acceleration, degree_per_second_squared, "Achieved.", known);
  v.number("reachable_acceleration", slew.reachable_acceleration, degree_per_second_squared,
           "What the drive has reserve for at that rate, whatever is asked.", known);
  v.number("time", slew.time, unit::second, "Null if the supply cannot move it.");
}

std::vector<BandLosses> band_losses(const EvaluateSection& section,
                                    const CandidateFigures& figures) {
  std::vector<BandLosses> bands;
  for (std::size_t i = 0; i < section.bands.size(); ++i) {
    bands.push_back({section.bands[i].name, figures.losses[i], std::nullopt});
    if (!figures.climate_losses.empty()) bands.back().climate_loss = figures.climate_losses[i];
  }
  return bands;
}

std::vector<MetBudget> met_budgets(const EvaluateSection& section, const Candidate& candidate,
                                   const CandidateFigures& figures) {
  std::vector<MetBudget> budgets;
  const CandidateController* controller = candidate.chosen_controller();
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    budgets.push_back({section.budgets[i], figures.speed_limits[i], std::nullopt});
    if (controller != nullptr && i < controller->budgets_met.size()) {
      budgets.back().plants_met = controller->budgets_met[i];
    }
  }
  return budgets;
}

void describe_figures(io::Visitor& v, const EvaluateSection& section, const Candidate& candidate,
                      const CandidateFigures& figures) {
  v.number("climate_boresight_rms", figures.climate_rms, unit::millidegree,
           "Over the site's winds; null if the case states no climate.");
  v.list("bands", band_losses(section, figures), "Losses.", [&](const BandLosses& band) {
    v.text("name", band.name, "Its name.");
    v.number(
        "mean_loss_two_axes", band.loss, unit::decibel_as_kept,
        "Mean loss over two equal axes. A parabola, which does not hold beyond 3 dB; texts say "
        "> 3 there.");
    v.number("climate_mean_loss_two_axes", band.climate_loss, unit::decibel_as_kept,
             "The same over the climate; null without one.");
  });
  v.list("budgets", met_budgets(section, candidate, figures),
         "Wind speeds up to which budgets are met.", [&](const MetBudget& one) {
           v.text("name", one.budget.name, "Its name.");
           v.text("band", one.budget.band, "Its band.");
           v.number("wind_speed_limit", one.speed_limit, unit::metre_per_second,
                    "Mean wind speed; null above 60 m/s.");
           v.number("needed_wind_speed", one.budget.wind_speed, unit::metre_per_second,
                    "Up to which the case needs it; null if it states none.");
           v.count("plants_met", one.plants_met,
                   "Plants of the ensemble on which it is met in that wind, supply torque not "
                   "counted; null without such a wind.");
         });
  v.number("supply_margin", figures.supply_margin, unit::ratio,
           "Supply torque, less friction at the tracking rate and offset torque, over mean wind "
           "torque and the gusts' crest.");
  v.number("gust_stroke_margin", figures.demand_margin, unit::ratio,
           "Valve stroke over the demand in the same.");
  v.number("slew_rate_margin", figures.slew_rate_margin, unit::ratio,
           "The highest rate that the drive holds against friction and offset, the valve fully "
           "open, over the slew rate; null if the case states no stroke.");
  v.number(
      "reversal_boresight_error", candidate.reversal_error(), unit::millidegree,
      "Largest boresight error after a velocity reversal at the tracking rate, on the nonlinear "
      "antenna; null where that did not run.");
  v.optional_group("slew", figures.slew,
                   "A move from rest to rest with the reserve that the drive has; null if the case "
                   "has no [simulation].",
                   [&](const SlewFigures& slew) { describe_slew(v, slew); });
}

void describe_candidate(io::Visitor& v, const EvaluateSection& section,
                        const Candidate& candidate) {
  const CandidateController* chosen = candidate.chosen_controller();
  std::vector<WrittenController> controllers;
  for (std::size_t i = 0; i < candidate.controllers.size(); ++i) {
    controllers.push_back({candidate.controllers[i], candidate.gains.at(i)});
  }
  v.defined_as("candidate", "The antenna as it is (first) or as a proposal makes it.");
  v.text("name", candidate.name, "Its name.");
  v.text_or_null("path", candidate.path, "Of the proposal; null for the antenna as it is.");
  v.text("description", candidate.description, "In words.");
  v.number("cost", candidate.cost, unit::ratio,
           "In the section's currency; null if the proposal states none.");
  v.number("cost_uncertainty", candidate.cost_uncertainty, unit::ratio,
           "Standard uncertainty; 0 if not given.", known);
  v.flag("cost_assumed", candidate.cost_assumed, "Nobody has quoted it.");
  v.texts("risks", candidate.risks, "As the proposal says.");
  v.list("changes", candidate.changes, "Of the case's numbers.",
         [&](const io::ChangeRow& change) { describe_change(v, change); });
  v.list("derived_quantities", candidate.derived_quantities,
         "What follows from them, of quantities that the proposal does not name.",
         [&](const io::DerivedChange& one) { describe_derived_quantity(v, one); });
  v.number("reflected_inertia", candidate.reflected_inertia, inertia_unit, "All at the motors.",
           known);
  v.number("motor_inertia", candidate.motor_inertia, inertia_unit, "All motors.", known);
  v.number("motor_to_load_ratio", candidate.motor_to_load_ratio, unit::ratio,
           "Motors over gear train and antenna.");
  v.object("oil_mode", candidate.oil_mode,
           "The plant's mode of the largest oil fraction, no loop closed.");
  v.flag("feasible", candidate.feasible(),
         "The chosen controller meets every goal on every plant, passes its verification and, "
         "where the "
         "case has a simulation, does not limit-cycle beyond the allowed amplitude.");
  v.text_or_null("chosen_structure", chosen != nullptr ? chosen->structure : "",
                 "Of the controller that stands for it; null without a stable one.");
  v.list("controllers", controllers, "One a structure, tuned robustly on the proposal's plants.",
         [&](const WrittenController& controller) { describe_controller(v, controller); });
  v.optional_group(
      "figures", candidate.figures,
      "What the chosen controller and the drive do at the design's wind speed; null without "
      "a stable controller.",
      [&](const CandidateFigures& figures) { describe_figures(v, section, candidate, figures); });
}

}  // namespace

void describe(io::Visitor& v, const EvaluateSection& section) {
  std::vector<std::string> front;
  for (const std::size_t i : section.front) front.push_back(section.candidates[i].name);
  v.defined_as("evaluated", "Proposals, each re-tuned on the same samples of what is uncertain.");
  v.number("wind_speed", section.wind_speed, unit::metre_per_second, "Mean, of the design.", known);
  v.text("wind_model", plant::to_string(section.wind_model), "Its model.");
  v.optional_members(section.wind_mast, [&](const plant::WindMast& mast) {
    v.object("wind_mast", mast, "Where the case names one.");
  });
  v.flag("wind_climate_stated", section.climate, "The case states one.");
  v.word("rms_over", section.minimises_climate ? "climate" : "design_speed",
         {"design_speed", "climate"}, "What the tuning made least.");
  v.word(
      "compared_on", section.time_domain ? "nonlinear_antenna" : "linear_plant",
      {"nonlinear_antenna", "linear_plant"},
      "Whether controllers and proposals are compared by simulated runs with friction, orifices, "
      "backlash, limits and encoder steps, or by linear loops only.");
  v.text("currency", section.currency, "Of all costs; empty if no proposal states one.");
  v.text("ensemble_source", section.ensemble_source, "What its members are drawn from.");
  v.count("ensemble_members", section.ensemble_size, "How many.");
  v.count("starts", section.starts, "Of each search.");
  v.list("candidates", section.candidates, "The antenna as it is, then the proposals.",
         [&](const Candidate& candidate) { describe_candidate(v, section, candidate); });
  v.texts("pareto_front", front,
          "Names on the Pareto front of cost and rms over the ensemble, in rising cost.");
  v.optional_group(
      "decision", section.decision, "Null if interrupted before it.",
      [&](const DecisionSection& decision) { describe_decision(v, section, decision); });
  v.texts("not_run", section.not_run, "What an interrupt left out.");
}

}  // namespace boresight::app
