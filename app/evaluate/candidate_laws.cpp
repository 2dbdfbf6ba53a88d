#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/evaluate/candidate_laws.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/budgets_on_plants.hpp>
#include <boresight/app/tune/engineer_units.hpp>
#include <boresight/app/tune/plant_members.hpp>
#include <boresight/design/tuning/structure_parts.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::app {
namespace {

using design::TuningStatus;

constexpr double infinity = std::numeric_limits<double>::infinity();
// As many as the reference ensemble has.
constexpr std::size_t drawn_members = 30;
std::vector<design::EnsembleMember> members_of(const io::Case& as_is, const io::Case& proposed,
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

double over_members(const design::EnsembleResult& ensemble) {
  double sum = 0.0;
  for (const auto& member : ensemble.members) {
    if (!member.stable) return infinity;
    sum += member.beam_rms * member.beam_rms;
  }
  return std::sqrt(sum / static_cast<double>(ensemble.members.size()));
}

// One structure of one candidate.
struct Task {
  std::size_t candidate = 0;
  std::string name;  // as the user has it; empty: tuned only to start others from
  control::LoopStructure structure;
  std::vector<std::size_t> parts = {};  // tasks whose structures this one extends
  design::Design design = {};
  CandidateLaw law = {};
  bool whole = false;
};

class Study {
 public:
  Study(const std::vector<io::Case>& cases, const PlantUncertainty& uncertainty, int starts,
        const EvaluateOptions& options)
      : cases_(cases), options_(options), starts_(starts) {
    for (const auto& one : cases) {
      members_.push_back(members_of(cases.front(), one, uncertainty, options.seed));
    }
  }

  std::size_t members() const { return members_.front().size(); }

  void search(Task& task) const {
    if (stopped()) return;
    task.design = design::solve(search_of(task));
    task.whole = !task.design.tuning.interrupted && !stopped();
  }

  // So that no law is worse than what it extends.
  void improve(Task& task, const std::vector<Task>& tasks) const {
    if (stopped() || !task.whole) return;
    std::vector<std::vector<double>> starts;
    for (const std::size_t part : task.parts) {
      const auto& tuning = tasks[part].design.tuning;
      if (!tasks[part].whole || tuning.status == TuningStatus::unstable) continue;
      std::ranges::move(design::starts_from_part(tuning.law, task.structure, options_.seed),
                        std::back_inserter(starts));
    }
    design::improve_from(search_of(task), starts, task.design);
  }

  void finish(Task& task) const {
    task.whole = task.whole && !stopped();
    if (!task.whole) return;
    const io::Case& antenna = cases_[task.candidate];
    const design::DesignTask search = search_of(task);
    task.law.structure = task.name;
    task.law.design = std::move(task.design);
    task.law.member_rms = infinity;
    if (!task.law.stable()) return;
    const auto& law = task.law.design.tuning.law;
    const auto& members = search.options.members;
    task.law.gains = in_engineers_units(antenna, law);
    task.law.ensemble = design::judge(search.problem, members, law, search.goals, 1);
    task.law.member_rms = over_members(*task.law.ensemble);
    task.law.goals_met = task.law.design.tuning.status == TuningStatus::optimal &&
                         task.law.ensemble->within_goals == static_cast<int>(members.size());
    if (options_.time_domain) {
      const auto options = comparison_options(antenna, options_.seed);
      task.law.time_domain = run_in_time_domain(antenna, make_problem(antenna), law, options);
      task.law.still = !task.law.time_domain ||
                       design::holds_still(task.law.time_domain->hunting, options.settled_error);
    }
    task.law.budgets_met =
        plants_within_budgets(make_problem(antenna), members, law, search.goals,
                              make_budgets(antenna), task.law.nonlinear_factor(), 1);
  }

 private:
  bool stopped() const { return options_.interrupted && options_.interrupted(); }

  design::DesignTask search_of(const Task& task) const {
    const io::Case& antenna = cases_[task.candidate];
    design::DesignTask search;
    search.name = task.name;
    search.problem = make_problem(antenna);
    if (antenna.goals.over_climate) search.problem.climate = make_climate(antenna);
    search.structure = task.structure;
    search.goals = make_goals(antenna);
    search.options.seed = options_.seed;
    search.options.starts =
        task.name.empty() ? std::min(starts_, design::starts_of_a_part) : starts_;
    search.options.stop = options_.interrupted;
    for (const auto& law : present_laws(antenna)) {
      if (law.structure == search.structure) search.options.warm_starts.push_back(law.gains);
    }
    search.options.members = members_[task.candidate];
    search.options.soft_goal = make_soft_goal(antenna);
    return search;
  }

  const std::vector<io::Case>& cases_;
  const EvaluateOptions& options_;
  int starts_;
  std::vector<std::vector<design::EnsembleMember>> members_;
};

std::vector<Task> tasks_of(const std::vector<io::Case>& cases,
                           const std::vector<std::vector<std::string>>& names) {
  std::vector<Task> tasks;
  for (std::size_t candidate = 0; candidate < cases.size(); ++candidate) {
    std::vector<control::LoopStructure> structures;
    for (const auto& name : names[candidate]) {
      structures.push_back(io::loop_structure(cases[candidate], name));
    }
    const auto missing =
        design::missing_parts(structures, io::usual_structures_with_lag(cases[candidate]));
    structures.insert(structures.end(), missing.begin(), missing.end());
    const auto parts = design::parts_of(structures);
    const std::size_t first = tasks.size();
    for (std::size_t s = 0; s < structures.size(); ++s) {
      const bool asked = s < names[candidate].size();
      Task task{candidate, asked ? names[candidate][s] : std::string(), structures[s]};
      for (const std::size_t part : parts[s]) task.parts.push_back(first + part);
      tasks.push_back(std::move(task));
    }
  }
  return tasks;
}

}  // namespace

TunedCandidates tune_candidates(const std::vector<io::Case>& cases,
                                const std::vector<std::vector<std::string>>& structures,
                                const PlantUncertainty& uncertainty, int starts,
                                const EvaluateOptions& options) {
  const Study study(cases, uncertainty, starts, options);
  auto tasks = tasks_of(cases, structures);
  std::vector<std::vector<std::size_t>> parts;
  for (const auto& task : tasks) parts.push_back(task.parts);
  // One step more is left to the comparison that follows.
  numerics::StepCounter counter(design::steps_of_search(parts) + tasks.size() + 1,
                                options.progress);
  const auto search = [&](std::size_t i) {
    study.search(tasks[i]);
    counter.step();
  };
  const auto improve = [&](std::size_t i) {
    study.improve(tasks[i], tasks);
    counter.step();
  };
  design::search_then_improve(parts, options.threads, search, improve);
  numerics::for_each_index(tasks.size(), options.threads, [&](std::size_t i) {
    if (!tasks[i].name.empty()) study.finish(tasks[i]);
    counter.step();
  });
  TunedCandidates result;
  result.members = study.members();
  result.candidates.resize(cases.size());
  for (auto& task : tasks) {
    if (task.name.empty()) continue;
    TunedCandidate& candidate = result.candidates[task.candidate];
    candidate.whole = candidate.whole && task.whole;
    if (task.whole) candidate.laws.push_back(std::move(task.law));
  }
  return result;
}

}  // namespace boresight::app
