#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/studies/monte_carlo_summary.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

const std::vector<double>& fractions() {
  static const std::vector<double> all{0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};
  return all;
}

std::vector<double> mapped(const std::vector<double>& values,
                           const std::function<double(double)>& map) {
  std::vector<double> result(values.size());
  std::ranges::transform(values, result.begin(), map);
  return result;
}

double mean_loss(double rms, const PointingBand& band) {
  return pointing_loss_db(rms, band.beamwidth, LossConvention::mean_loss_two_axes);
}

// The plants that were evaluated, in their order.
class Evaluated {
 public:
  Evaluated(const MonteCarloRun& run, const PlantDistribution& distribution, std::uint64_t seed)
      : distribution_(distribution), seed_(seed), run_(run) {
    for (std::size_t block = 0; block < run.blocks(); ++block) {
      if (!run.whole(block)) continue;
      const std::uint64_t first = block * MonteCarloRun::block_size;
      for (std::uint64_t k = 0; k < run.outcomes(block).size(); ++k) {
        all_.push_back(first + k);
        if (run.outcome(first + k).stable()) stable_.push_back(first + k);
      }
    }
  }

  const std::vector<std::uint64_t>& all() const { return all_; }
  const std::vector<std::uint64_t>& stable() const { return stable_; }
  const PlantOutcome& outcome(std::uint64_t index) const { return run_.outcome(index); }
  PlantSample draw(std::uint64_t index) const { return distribution_.draw(seed_, index); }
  NotablePlant notable(std::uint64_t index) const { return {index, draw(index), outcome(index)}; }
  std::vector<double> of_stable(double PlantOutcome::*quantity) const {
    std::vector<double> values;
    values.reserve(stable_.size());
    for (const auto index : stable_) values.push_back(outcome(index).*quantity);
    return values;
  }
  std::uint64_t count(const std::function<bool(const PlantOutcome&)>& holds) const {
    return static_cast<std::uint64_t>(
        std::ranges::count_if(all_, [&](std::uint64_t index) { return holds(outcome(index)); }));
  }

 private:
  const PlantDistribution& distribution_;
  std::uint64_t seed_;
  const MonteCarloRun& run_;
  std::vector<std::uint64_t> all_, stable_;
};

void count_standings(const Evaluated& evaluated, MonteCarloSummary& section) {
  for (const auto index : evaluated.all()) {
    const PlantOutcome& outcome = evaluated.outcome(index);
    section.confirmed += outcome.confirmed;
    section.contradicted += outcome.contradicted;
    if (outcome.stable()) continue;
    ++(outcome.stability_basis == StabilityBasis::unstable ? section.unstable : section.undecided);
    if (section.unstable_plants.size() < MonteCarloSummary::max_listed) {
      section.unstable_plants.push_back(evaluated.notable(index));
    }
  }
  section.stable = evaluated.stable().size();
  section.instability = probability(section.unstable + section.undecided, section.plants);
}

void summarise_losses(const Evaluated& evaluated, MonteCarloSummary& section) {
  const auto rms = evaluated.of_stable(&PlantOutcome::boresight_rms);
  section.boresight_rms = summarise(rms, fractions());
  std::vector<double> climate_rms;
  if (section.climate) {
    climate_rms = evaluated.of_stable(&PlantOutcome::climate_rms);
    section.climate_rms = summarise(climate_rms, fractions());
  }
  for (auto& [band, loss, climate_loss] : section.losses) {
    const auto in_band = [&named = band](double value) { return mean_loss(value, named); };
    loss = summarise(mapped(rms, in_band), fractions());
    if (section.climate) {
      climate_loss = summarise(mapped(climate_rms, in_band), fractions());
    }
  }
  const NonlinearEffect effect = section.effect.for_budgets();
  for (auto& [budget, met] : section.budgets) {
    const double limit = budget.rms;
    const auto hits = evaluated.count([&](const PlantOutcome& one) {
      return one.stable() && within_budget(effect.rms(one.boresight_rms), limit);
    });
    met = probability(hits, section.plants);
  }
}

void count_goals(const Evaluated& evaluated, const control::Controller& controller,
                 MonteCarloSummary& section) {
  const auto names = goal_names(section.goals);
  const auto applied = goals_applied(section.goals, controller);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!applied[k]) continue;
    const auto hits = evaluated.count([&](const PlantOutcome& one) {
      return one.stable() && ((one.violated_constraints >> k) & 1U) != 0;
    });
    section.constraints_violated.push_back({names[k], probability(hits, section.plants)});
  }
  const auto met = evaluated.count(
      [](const PlantOutcome& one) { return one.stable() && one.violated_constraints == 0; });
  section.all_constraints_met = probability(met, section.plants);
}

void correlate(const Evaluated& evaluated, MonteCarloSummary& section) {
  const auto rms = evaluated.of_stable(&PlantOutcome::boresight_rms);
  std::vector<PlantSample> random_samples;
  random_samples.reserve(rms.size());
  for (const auto index : evaluated.stable()) random_samples.push_back(evaluated.draw(index));
  for (const auto input : section.inputs) {
    std::vector<double> values;
    values.reserve(random_samples.size());
    for (const auto& draw : random_samples) values.push_back(draw[input]);
    section.correlations.push_back({input, rank_correlation(values, rms)});
  }
  std::ranges::stable_sort(section.correlations, [](const auto& one, const auto& other) {
    return std::abs(one.with_rms.value) > std::abs(other.with_rms.value);
  });
}

void find_worst(const Evaluated& evaluated, MonteCarloSummary& section) {
  constexpr std::size_t maximum = 10;
  auto order = evaluated.stable();
  const std::size_t count = std::min(maximum, order.size());
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(count),
                            [&](std::uint64_t one, std::uint64_t other) {
                              const double a = evaluated.outcome(one).boresight_rms;
                              const double b = evaluated.outcome(other).boresight_rms;
                              return a > b || (a == b && one < other);
                            });
  for (std::size_t k = 0; k < count; ++k) section.worst.push_back(evaluated.notable(order[k]));
}

void summarise_retuned(const Evaluated& evaluated, MonteCarloSummary& section) {
  MonteCarloSummary::Retuned retuned;
  std::vector<double> rms, fixed_gain_cost;
  for (const auto index : evaluated.all()) {
    const PlantOutcome& one = evaluated.outcome(index);
    if (std::isnan(one.retuned_rms)) continue;
    ++retuned.found;
    rms.push_back(one.retuned_rms);
    if (one.stable()) {
      fixed_gain_cost.push_back(one.boresight_rms / one.retuned_rms - 1.0);
    } else {
      ++retuned.only_retuned;
    }
  }
  retuned.boresight_rms = summarise(std::move(rms), fractions());
  retuned.fixed_gain_cost = summarise(std::move(fixed_gain_cost), fractions());
  section.retuned = std::move(retuned);
}

}  // namespace

MonteCarloSummary summarise(const MonteCarloRun& run, const Mission& mission,
                            const PlantDistribution& distribution, std::uint64_t seed,
                            unsigned threads) {
  const MonteCarlo& study = run.study();
  const Evaluated evaluated(run, distribution, seed);
  if (evaluated.all().empty()) {
    throw Interrupted("montecarlo: interrupted before a block of plants was whole");
  }
  MonteCarloSummary section;
  for (const auto& band : mission.bands) section.losses.push_back({band, {}, {}});
  for (const auto& budget : mission.budgets) section.budgets.push_back({budget, {}});
  if (!section.budgets.empty()) {
    section.effect = simulated_effect(mission, study.controller, seed, threads);
  }
  section.plants_asked = study.plants;
  section.plants = evaluated.all().size();
  section.interrupted = section.plants < section.plants_asked;
  section.inputs = distribution.inputs();
  section.goals = study.goals;
  section.climate = !study.problem.climate.empty();
  section.confirm_peak = study.fixed_gain.confirm_peak;
  section.confirm_every = study.confirm_every;
  count_standings(evaluated, section);
  summarise_losses(evaluated, section);
  count_goals(evaluated, study.controller, section);
  correlate(evaluated, section);
  find_worst(evaluated, section);
  if (study.retune) summarise_retuned(evaluated, section);
  return section;
}

}  // namespace boresight::design
