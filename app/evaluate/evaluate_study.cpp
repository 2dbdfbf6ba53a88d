#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/evaluate/candidate_laws.hpp>
#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/design/decisions/pareto_front.hpp>
#include <boresight/design/problem/drive_reach.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::app {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view as_it_is = "as it is";

std::optional<SlewFigures> slew_of(const io::Case& antenna, double inertia) {
  if (!antenna.simulation) return std::nullopt;
  constexpr double distance = 10.0 * degree;
  constexpr double acceleration = 0.2 * degree;
  const double ratio = io::gear_ratio(antenna);
  SlewFigures slew;
  slew.distance = distance;
  slew.rate_asked = antenna.drive.slew_rate.value;
  const double open =
      antenna.simulation->valve_stroke.value * (1.0 - antenna.simulation->valve_overlap.value);
  const double wanted = std::min(slew.rate_asked * ratio, 0.999 * open);
  constexpr double any_acceleration = std::numeric_limits<double>::infinity();
  const auto reach =
      design::within_reach(make_nonlinear_antenna(antenna), inertia, {wanted, any_acceleration});
  slew.reachable_acceleration = std::max(0.0, reach.acceleration / ratio);
  slew.rate = std::max(0.0, reach.rate / ratio);
  slew.acceleration = std::max(0.0, std::min(acceleration * ratio, reach.acceleration) / ratio);
  if (slew.rate > 0.0 && slew.acceleration > 0.0) {
    const double ramps = slew.rate * slew.rate / slew.acceleration;
    slew.time = ramps >= distance ? 2.0 * std::sqrt(distance / slew.acceleration)
                                  : distance / slew.rate + slew.rate / slew.acceleration;
  }
  return slew;
}

CandidateFigures figures_of(const io::Case& antenna, const CandidateLaw& tuned,
                            const EvaluateSection& section) {
  const control::ControlLaw& law = tuned.design.tuning.law;
  const double factor = tuned.nonlinear_factor();
  const bool known = std::isfinite(factor);
  CandidateFigures figures;
  auto problem = make_problem(antenna);
  auto evaluator = design::make_evaluator(problem);
  evaluator.look_at_gusts(true);
  const auto evaluation = evaluator.evaluate(law, false);
  const auto losses = [&](double rms) {
    std::vector<double> found;
    for (const auto& band : section.bands) {
      found.push_back(known ? design::pointing_loss_db(rms, band.beamwidth,
                                                       design::LossConvention::mean_loss_two_axes)
                            : nan);
    }
    return found;
  };
  figures.supply_wind_speed = supply_wind_speed(antenna, problem);
  figures.losses = losses(factor * std::sqrt(evaluation.beam_variance()) / problem.gear_ratio);
  for (const auto& budget : section.budgets) {
    figures.speed_limits.push_back(known ? design::wind_speed_limit(problem, evaluator, law,
                                                                    evaluation.noise_variance,
                                                                    budget.rms / factor)
                                         : nan);
  }
  const double crest = antenna.goals.crest_factor ? antenna.goals.crest_factor->value
                                                  : design::HardGoals{}.crest_factor;
  const double mean = std::abs(plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) /
                               problem.gear_ratio);
  const auto& drive = problem.plant.drive;
  figures.supply_margin =
      io::torque_for_wind(antenna) / (mean + crest * std::sqrt(evaluation.wind_torque_variance));
  figures.demand_margin =
      io::largest_demand(antenna) / (drive.leakage_rate / drive.oil_stiffness * mean +
                                     crest * std::sqrt(evaluation.wind_demand_variance));
  figures.slew_rate_margin = plant::slew_rate_margin(drive_of(antenna));
  figures.slew = slew_of(antenna, motor_inertia(antenna, antenna.motor.flywheel_disks) +
                                      gear_train_inertia(antenna) + antenna_inertia(antenna));
  const auto climate = make_climate(antenna);
  if (!climate.empty()) {
    problem.climate = climate;
    figures.climate_rms =
        factor * std::sqrt(design::make_evaluator(problem).evaluate(law, false).beam_variance()) /
        problem.gear_ratio;
    figures.climate_losses = losses(*figures.climate_rms);
  }
  return figures;
}

Candidate describe_candidate(const io::Case& antenna) {
  Candidate candidate;
  candidate.motor_inertia = motor_inertia(antenna, antenna.motor.flywheel_disks);
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  candidate.reflected_inertia = candidate.motor_inertia + load;
  candidate.motor_to_load_ratio = candidate.motor_inertia / load;
  candidate.oil_mode = plant::mode_of_oil(plant::plant_modes(make_plant(antenna)));
  return candidate;
}

Candidate describe_candidate(const io::ProposedCase& proposed, const io::Proposal& proposal) {
  Candidate candidate = describe_candidate(proposed.antenna);
  candidate.name = proposal.name;
  candidate.path = proposal.path;
  candidate.description = proposal.description;
  if (proposal.cost) {
    const io::Quantity& amount = proposal.cost->amount;
    candidate.cost = amount.value;
    if (amount.uncertainty_given) candidate.cost_uncertainty = amount.standard_uncertainty;
    candidate.cost_assumed = amount.basis == io::Basis::assumed;
  }
  candidate.risks = proposal.risks;
  candidate.changes = proposed.changes;
  candidate.consequences = proposed.consequences;
  return candidate;
}

void check_together(const std::vector<io::Proposal>& proposals) {
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const auto& one = proposals[i];
    if (one.name == as_it_is) {
      io::refuse_at(
          one.name_location, "name",
          fmt::format("expected another name than {}, which is the antenna without proposals, "
                      "found it",
                      io::in_quotes(as_it_is)));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (proposals[k].name == one.name) {
        io::refuse_at(one.name_location, "name",
                      fmt::format("expected a name of its own, found {}, which {} has too",
                                  io::in_quotes(one.name), proposals[k].path));
      }
      const auto& other = proposals[k].cost;
      if (one.cost && other && other->currency != one.cost->currency) {
        io::refuse_at(
            one.cost_location, "cost.currency",
            fmt::format("expected the currency of {}, {}, since costs are compared, found {}",
                        proposals[k].path, io::in_quotes(other->currency),
                        io::in_quotes(one.cost->currency)));
      }
    }
  }
}

// In rising cost, by the rms of those with a usable law and a cost.
std::vector<std::size_t> front_of(const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> places;
  std::vector<design::CostPoint> points;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const CandidateLaw* law = candidates[i].chosen_law();
    if (law == nullptr || !law->usable() || !std::isfinite(law->compared_rms())) continue;
    const auto& cost = candidates[i].cost;
    if (!cost) continue;
    places.push_back(i);
    points.push_back({*cost, law->compared_rms()});
  }
  std::vector<std::size_t> front;
  for (const std::size_t i : design::pareto_front(points)) front.push_back(places[i]);
  return front;
}

}  // namespace

double CandidateLaw::nonlinear_factor() const {
  if (!time_domain) return 1.0;
  const auto& wind = time_domain->wind;
  const bool complete = wind.status == design::RunStatus::complete;
  return complete ? wind.beam_rms / wind.continuous_rms : std::numeric_limits<double>::infinity();
}

std::optional<double> Candidate::reversal_error() const {
  const CandidateLaw* law = chosen_law();
  if (law == nullptr || !law->time_domain || !law->time_domain->reversal) return std::nullopt;
  const auto& reversal = *law->time_domain->reversal;
  if (reversal.status != design::RunStatus::complete) return std::nullopt;
  return reversal.beam_error;
}

plant::AntennaPlant proposed_plant(const io::Case& as_is, const io::Case& proposed,
                                   const design::PlantDraw& draw) {
  design::PlantDraw own = draw;
  const double slope = io::tracking_friction(as_is);
  if (slope > 0.0) {
    own.values.at(static_cast<std::size_t>(design::UncertainInput::friction_slope)) *=
        io::tracking_friction(proposed) / slope;
  }
  return make_plant(proposed, changes_of(own));
}

void check_proposals(const io::Case& antenna, const std::vector<io::Proposal>& proposals) {
  check_together(proposals);
  for (const auto& proposal : proposals) {
    design::validate(make_goals(apply_proposal(antenna, proposal).antenna));
  }
}

EvaluateSection evaluate_proposals(const io::Case& antenna,
                                   const std::vector<io::Proposal>& proposals,
                                   const PlantUncertainty& uncertainty,
                                   const EvaluateOptions& options) {
  check_together(proposals);
  constexpr std::size_t least_draws = 100;
  if (options.draws < least_draws) {
    throw InvalidInput(
        fmt::format("evaluate: expected {} draws or more, found {}", least_draws, options.draws));
  }
  std::vector<std::string> structures;
  for (const auto& one : structure_option(antenna, options.structures)) {
    structures.push_back(one.name);
  }

  EvaluateSection section;
  section.bands = make_bands(antenna);
  section.budgets = make_budgets(antenna);
  section.wind_speed = antenna.wind.design_speed.value;
  section.wind_model = make_problem(antenna).wind.model;
  section.wind_mast = antenna.wind.mast;
  section.climate = !make_climate(antenna).empty();
  section.minimises_climate = antenna.goals.over_climate;
  for (const auto& proposal : proposals) {
    if (proposal.cost) section.currency = proposal.cost->currency;
  }
  section.starts = options.starts != 0 ? options.starts : static_cast<int>(antenna.tuning.starts);
  if (section.starts == 0) section.starts = design::TuningOptions{}.starts;
  if (section.minimises_climate && !section.climate) {
    throw InvalidInput(
        "evaluate: expected [[wind.climate]] in the case for the goal rms_over = "
        "climate, found none");
  }

  std::vector<io::Case> cases{antenna};
  section.candidates.push_back(describe_candidate(antenna));
  section.candidates.front().name = as_it_is;
  section.candidates.front().cost = 0.0;
  section.candidates.front().description = "the antenna of the case, re-tuned";
  std::vector<std::vector<std::string>> names{structures};
  for (const auto& proposal : proposals) {
    io::ProposedCase proposed = apply_proposal(antenna, proposal);
    section.candidates.push_back(describe_candidate(proposed, proposal));
    cases.push_back(std::move(proposed.antenna));
    design::validate(make_goals(cases.back()));
    names.push_back(proposal.structures.empty() ? structures : proposal.structures);
  }

  auto tuned = tune_candidates(cases, names, uncertainty, section.starts, options);
  section.ensemble_size = tuned.members;
  section.ensemble_source = uncertainty.from_records ? "drawn from what the records leave open"
                                                     : "drawn from the ranges of the case";
  if (options.time_domain && antenna.simulation) {
    section.time_domain = comparison_options(mission_of(antenna), options.seed);
  }
  std::vector<bool> whole;
  for (std::size_t i = 0; i < section.candidates.size(); ++i) {
    whole.push_back(tuned.candidates[i].whole);
    section.candidates[i].laws = std::move(tuned.candidates[i].laws);
    section.candidates[i].chosen = tuned.candidates[i].chosen;
  }
  for (std::size_t i = whole.size(); i-- > 0;) {
    if (whole[i]) continue;
    section.not_run.insert(section.not_run.begin(), section.candidates[i].name);
    section.candidates.erase(section.candidates.begin() + static_cast<std::ptrdiff_t>(i));
    cases.erase(cases.begin() + static_cast<std::ptrdiff_t>(i));
  }
  numerics::for_each_index(section.candidates.size(), options.threads, [&](std::size_t i) {
    Candidate& candidate = section.candidates[i];
    if (!candidate.chosen) return;
    candidate.figures = figures_of(cases[i], candidate.laws[*candidate.chosen], section);
  });
  if (!section.currency.empty()) section.front = front_of(section.candidates);
  const bool stopped = options.interrupted && options.interrupted();
  if (!stopped && section.not_run.empty()) {
    section.decision = decide(section.candidates, cases, uncertainty.distribution, options);
    if (section.decision->draws == 0) section.decision.reset();
  }
  if (!section.decision && !proposals.empty()) {
    section.not_run.emplace_back("chances, regrets and tests");
  }
  if (options.progress) options.progress(1, 1);
  return section;
}

}  // namespace boresight::app
