#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

#include <fmt/format.h>

#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/app/io/field.hpp>
#include <boresight/app/io/wording.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/tune/engineer_units.hpp>
#include <boresight/app/tune/plant_members.hpp>
#include <boresight/design/drive_reach.hpp>
#include <boresight/design/parallel_loop.hpp>
#include <boresight/design/pareto_front.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

using design::TuningStatus;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double infinity = std::numeric_limits<double>::infinity();
// As many as the reference ensemble has.
constexpr std::size_t drawn_members = 30;
constexpr std::string_view as_it_is = "as it is";

std::vector<design::EnsembleMember> members_of(const Case& as_is, const Case& proposed,
                                               const PlantUncertainty& uncertainty,
                                               std::uint64_t seed) {
  if (!uncertainty.from_records) return plant_members(proposed, seed);
  std::vector<design::EnsembleMember> members{{"nominal", make_plant(proposed)}};
  for (std::size_t i = 0; i + 1 < drawn_members; ++i) {
    members.push_back({fmt::format("draw {}", i + 1),
                       proposed_plant(as_is, proposed, uncertainty.distribution.draw(seed, i))});
  }
  return members;
}

// One structure of one candidate.
struct Task {
  std::size_t candidate = 0;
  std::string structure;
  CandidateLaw law;
  bool whole = false;
};

double over_members(const design::EnsembleResult& ensemble) {
  double sum = 0.0;
  for (const auto& member : ensemble.members) {
    if (!member.stable) return infinity;
    sum += member.beam_rms * member.beam_rms;
  }
  return std::sqrt(sum / static_cast<double>(ensemble.members.size()));
}

class Study {
 public:
  Study(const Case& antenna, const std::vector<Case>& cases, const PlantUncertainty& uncertainty,
        const EvaluateOptions& options, int starts)
      : cases_(cases), options_(options), starts_(starts) {
    for (const auto& one : cases) {
      members_.push_back(members_of(antenna, one, uncertainty, options.seed));
    }
  }

  std::size_t members() const { return members_.front().size(); }

  void tune(Task& task) const {
    if (stopped()) return;
    const Case& antenna = cases_[task.candidate];
    design::DesignTask search;
    search.name = task.structure;
    search.problem = make_problem(antenna);
    if (antenna.goals.over_climate) search.problem.climate = make_climate(antenna);
    search.structure = loop_structure(antenna.loops, task.structure);
    search.goals = make_goals(antenna);
    search.options.seed = options_.seed;
    search.options.starts = starts_;
    search.options.stop = options_.interrupted;
    for (const auto& law : present_laws(antenna)) {
      if (law.structure == search.structure) search.options.warm_starts.push_back(law.gains);
    }
    const auto& members = members_[task.candidate];
    search.options.members = members;
    search.options.soft_goal = make_soft_goal(antenna);
    task.law.structure = task.structure;
    task.law.design = design::solve(search);
    if (task.law.design.tuning.interrupted || stopped()) return;
    task.law.member_rms = infinity;
    if (task.law.stable()) {
      const auto& law = task.law.design.tuning.law;
      task.law.gains = in_engineers_units(antenna, law);
      task.law.ensemble = design::judge(search.problem, members, law, search.goals, 1);
      task.law.member_rms = over_members(*task.law.ensemble);
      task.law.goals_met = task.law.design.tuning.status == TuningStatus::optimal &&
                           task.law.ensemble->within_goals == static_cast<int>(members.size());
    }
    task.whole = true;
  }

 private:
  bool stopped() const { return options_.interrupted && options_.interrupted(); }

  const std::vector<Case>& cases_;
  const EvaluateOptions& options_;
  int starts_;
  std::vector<std::vector<design::EnsembleMember>> members_;
};

// The best of laws: usable ones first, then those that meet their goals, then stable ones.
std::optional<std::size_t> choose(const std::vector<CandidateLaw>& laws) {
  std::optional<std::size_t> best;
  const auto rank = [&](std::size_t i) {
    const auto& law = laws[i];
    const int worth = law.usable() ? 0 : law.goals_met ? 1 : 2;
    const double nearness = worth < 2 ? law.member_rms : law.design.tuning.worst_goal_ratio;
    return std::pair(worth, nearness);
  };
  for (std::size_t i = 0; i < laws.size(); ++i) {
    if (laws[i].stable() && (!best || rank(i) < rank(*best))) best = i;
  }
  return best;
}

std::optional<SlewFigures> slew_of(const Case& antenna, double inertia) {
  if (!antenna.simulation) return std::nullopt;
  constexpr double distance = 10.0 * degree;
  constexpr double acceleration = 0.2 * degree;
  const double ratio = gear_ratio(antenna);
  SlewFigures slew;
  slew.distance = distance;
  slew.rate_asked = antenna.drive.slew_rate.value;
  const double open =
      antenna.simulation->valve_stroke.value * (1.0 - antenna.simulation->valve_overlap.value);
  const double wanted = std::min(slew.rate_asked * ratio, 0.999 * open);
  const auto limits = design::within_reach(make_nonlinear_antenna(antenna), inertia,
                                           {wanted, acceleration * ratio});
  slew.rate = std::max(0.0, limits.rate / ratio);
  slew.acceleration = std::max(0.0, limits.acceleration / ratio);
  if (slew.rate > 0.0 && slew.acceleration > 0.0) {
    const double ramps = slew.rate * slew.rate / slew.acceleration;
    slew.time = ramps >= distance ? 2.0 * std::sqrt(distance / slew.acceleration)
                                  : distance / slew.rate + slew.rate / slew.acceleration;
  }
  return slew;
}

CandidateFigures figures_of(const Case& antenna, const control::ControlLaw& law,
                            const EvaluateSection& section) {
  CandidateFigures figures;
  auto problem = make_problem(antenna);
  auto evaluator = design::make_evaluator(problem);
  evaluator.look_at_gusts(true);
  const auto evaluation = evaluator.evaluate(law, false);
  const auto losses = [&](double rms) {
    std::vector<double> found;
    for (const auto& band : section.bands) {
      found.push_back(design::pointing_loss_db(rms, band.beamwidth,
                                               design::LossConvention::mean_loss_two_axes));
    }
    return found;
  };
  figures.losses = losses(std::sqrt(evaluation.beam_variance()) / problem.gear_ratio);
  for (const auto& budget : section.budgets) {
    figures.speed_limits.push_back(
        design::wind_speed_limit(problem, evaluator, law, evaluation.noise_variance, budget.rms));
  }
  const double crest = antenna.goals.crest_factor ? antenna.goals.crest_factor->value
                                                  : design::HardGoals{}.crest_factor;
  const double mean = std::abs(plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) /
                               problem.gear_ratio);
  const auto& drive = problem.plant.drive;
  figures.supply_margin =
      supply_torque(antenna) / (mean + crest * std::sqrt(evaluation.wind_torque_variance));
  const double slewing = antenna.drive.slew_rate.value * problem.gear_ratio;
  const double stroke = antenna.simulation ? antenna.simulation->valve_stroke.value : slewing;
  figures.demand_margin = stroke / (drive.leakage_rate / drive.oil_stiffness * mean +
                                    crest * std::sqrt(evaluation.wind_demand_variance));
  if (antenna.simulation) figures.slew_stroke_margin = stroke / slewing;
  figures.slew = slew_of(antenna, motor_inertia(antenna, antenna.motor.flywheel_disks) +
                                      gear_train_inertia(antenna) + antenna_inertia(antenna));
  const auto climate = make_climate(antenna);
  if (!climate.empty()) {
    problem.climate = climate;
    figures.climate_rms =
        std::sqrt(design::make_evaluator(problem).evaluate(law, false).beam_variance()) /
        problem.gear_ratio;
    figures.climate_losses = losses(*figures.climate_rms);
  }
  return figures;
}

Candidate describe_candidate(const Case& antenna) {
  Candidate candidate;
  candidate.motor_inertia = motor_inertia(antenna, antenna.motor.flywheel_disks);
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  candidate.reflected_inertia = candidate.motor_inertia + load;
  candidate.motor_to_load_ratio = candidate.motor_inertia / load;
  return candidate;
}

Candidate describe_candidate(const ProposedCase& proposed, const Proposal& proposal) {
  Candidate candidate = describe_candidate(proposed.antenna);
  candidate.name = proposal.name;
  candidate.path = proposal.path;
  candidate.description = proposal.description;
  candidate.cost = proposal.cost.amount.value;
  if (proposal.cost.amount.uncertainty_given) {
    candidate.cost_uncertainty = proposal.cost.amount.standard_uncertainty;
  }
  candidate.cost_assumed = proposal.cost.amount.basis == Basis::assumed;
  candidate.risks = proposal.risks;
  candidate.changes = proposed.changes;
  candidate.consequences = proposed.consequences;
  return candidate;
}

void check_together(const std::vector<Proposal>& proposals) {
  if (proposals.empty()) {
    throw InvalidInput("evaluate: expected a proposal or more, found none");
  }
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const auto& one = proposals[i];
    if (one.name == as_it_is) {
      refuse_at(
          one.name_location, "name",
          fmt::format("expected another name than {}, which is the antenna without proposals, "
                      "found it",
                      quoted(as_it_is)));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (proposals[k].name == one.name) {
        refuse_at(one.name_location, "name",
                  fmt::format("expected a name of its own, found {}, which {} has too",
                              quoted(one.name), proposals[k].path));
      }
      if (proposals[k].cost.currency != one.cost.currency) {
        refuse_at(one.cost_location, "cost.currency",
                  fmt::format("expected the currency of {}, {}, since costs are compared, found {}",
                              proposals[k].path, quoted(proposals[k].cost.currency),
                              quoted(one.cost.currency)));
      }
    }
  }
}

// In rising cost, by the nominal rms of those with a stable law.
std::vector<std::size_t> front_of(const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> places;
  std::vector<design::CostPoint> points;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const CandidateLaw* law = candidates[i].chosen_law();
    if (law == nullptr || !law->usable()) continue;
    places.push_back(i);
    points.push_back({candidates[i].cost, law->member_rms});
  }
  std::vector<std::size_t> front;
  for (const std::size_t i : design::pareto_front(points)) front.push_back(places[i]);
  return front;
}

}  // namespace

plant::AntennaPlant proposed_plant(const Case& as_is, const Case& proposed, const PlantDraw& draw) {
  PlantDraw own = draw;
  const double slope = tracking_friction(as_is);
  if (slope > 0.0) {
    own.values.at(static_cast<std::size_t>(UncertainInput::friction_slope)) *=
        tracking_friction(proposed) / slope;
  }
  return make_plant(proposed, own);
}

void check_proposals(const Case& antenna, const std::vector<Proposal>& proposals) {
  check_together(proposals);
  for (const auto& proposal : proposals) {
    design::validate(make_goals(apply_proposal(antenna, proposal).antenna));
  }
}

EvaluateSection evaluate_proposals(const Case& antenna, const std::vector<Proposal>& proposals,
                                   const PlantUncertainty& uncertainty,
                                   const EvaluateOptions& options) {
  check_together(proposals);
  constexpr std::size_t least_draws = 100;
  if (options.draws < least_draws) {
    throw InvalidInput(
        fmt::format("evaluate: expected {} draws or more, found {}", least_draws, options.draws));
  }
  std::vector<std::string> structures = options.structures;
  if (structures.empty()) structures = {"PI"};
  for (const auto& name : structures) loop_structure(antenna.loops, name);

  EvaluateSection section;
  section.bands = make_bands(antenna);
  section.budgets = make_budgets(antenna);
  section.wind_speed = antenna.wind.design_speed.value;
  section.wind_model = make_problem(antenna).wind.model;
  section.climate = !make_climate(antenna).empty();
  section.minimises_climate = antenna.goals.over_climate;
  section.currency = proposals.front().cost.currency;
  section.starts = options.starts != 0 ? options.starts : static_cast<int>(antenna.tuning.starts);
  if (section.starts == 0) section.starts = design::TuningOptions{}.starts;
  if (section.minimises_climate && !section.climate) {
    throw InvalidInput(
        "evaluate: expected [[wind.climate]] in the case for the goal rms_over = "
        "climate, found none");
  }

  std::vector<Case> cases{antenna};
  section.candidates.push_back(describe_candidate(antenna));
  section.candidates.front().name = as_it_is;
  section.candidates.front().description = "the antenna of the case, re-tuned";
  std::vector<Task> tasks;
  const auto add_tasks = [&](const std::vector<std::string>& names) {
    for (const auto& name : names) tasks.push_back({cases.size() - 1, name, {}, false});
  };
  add_tasks(structures);
  for (const auto& proposal : proposals) {
    ProposedCase proposed = apply_proposal(antenna, proposal);
    section.candidates.push_back(describe_candidate(proposed, proposal));
    cases.push_back(std::move(proposed.antenna));
    design::validate(make_goals(cases.back()));
    add_tasks(proposal.structures.empty() ? structures : proposal.structures);
  }

  const Study study(antenna, cases, uncertainty, options, section.starts);
  section.ensemble_size = study.members();
  section.ensemble_source = uncertainty.from_records ? "drawn from what the records leave open"
                                                     : "drawn from the ranges of the case";
  std::size_t done = 0;
  std::mutex mutex;
  // The last task is the draws.
  const std::size_t all = tasks.size() + 1;
  design::for_each_index(tasks.size(), options.threads, [&](std::size_t i) {
    study.tune(tasks[i]);
    const std::lock_guard lock(mutex);
    ++done;
    if (options.progress) options.progress(done, all);
  });

  std::vector<bool> whole(section.candidates.size(), true);
  for (auto& task : tasks) {
    if (!task.whole) {
      whole[task.candidate] = false;
      continue;
    }
    section.candidates[task.candidate].laws.push_back(std::move(task.law));
  }
  for (std::size_t i = whole.size(); i-- > 0;) {
    if (whole[i]) continue;
    section.not_run.insert(section.not_run.begin(), section.candidates[i].name);
    section.candidates.erase(section.candidates.begin() + static_cast<std::ptrdiff_t>(i));
    cases.erase(cases.begin() + static_cast<std::ptrdiff_t>(i));
  }
  design::for_each_index(section.candidates.size(), options.threads, [&](std::size_t i) {
    Candidate& candidate = section.candidates[i];
    candidate.chosen = choose(candidate.laws);
    if (!candidate.chosen) return;
    candidate.figures =
        figures_of(cases[i], candidate.laws[*candidate.chosen].design.tuning.law, section);
  });
  section.front = front_of(section.candidates);
  const bool stopped = options.interrupted && options.interrupted();
  if (!stopped && section.not_run.empty()) {
    section.decision = decide(section.candidates, cases, uncertainty.distribution, options);
    if (section.decision->draws == 0) section.decision.reset();
  }
  if (!section.decision) section.not_run.emplace_back("chances, regrets and tests");
  if (options.progress) options.progress(all, all);
  return section;
}

}  // namespace boresight::app
