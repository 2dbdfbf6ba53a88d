#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/uncertainty/distribution_source.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using design::PlantOutcome;

const std::vector<double>& shares() {
  static const std::vector<double> all{0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};
  return all;
}

std::vector<double> mapped(const std::vector<double>& values,
                           const std::function<double(double)>& map) {
  std::vector<double> result(values.size());
  std::ranges::transform(values, result.begin(), map);
  return result;
}

double mean_loss(double rms, const design::PointingBand& band) {
  return design::pointing_loss_db(rms, band.beamwidth, design::LossConvention::mean_loss_two_axes);
}

// The plants that were judged, in their order.
class Judged {
 public:
  Judged(const design::MonteCarloRun& run, const design::PlantDistribution& distribution,
         std::uint64_t seed)
      : distribution_(distribution), seed_(seed), run_(run) {
    for (std::size_t block = 0; block < run.blocks(); ++block) {
      if (!run.whole(block)) continue;
      const std::uint64_t first = block * design::MonteCarloRun::block_size;
      for (std::uint64_t k = 0; k < run.outcomes(block).size(); ++k) {
        all_.push_back(first + k);
        if (run.outcome(first + k).stable()) stable_.push_back(first + k);
      }
    }
  }

  const std::vector<std::uint64_t>& all() const { return all_; }
  const std::vector<std::uint64_t>& stable() const { return stable_; }
  const PlantOutcome& outcome(std::uint64_t index) const { return run_.outcome(index); }
  design::PlantDraw draw(std::uint64_t index) const { return distribution_.draw(seed_, index); }
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
  const design::PlantDistribution& distribution_;
  std::uint64_t seed_;
  const design::MonteCarloRun& run_;
  std::vector<std::uint64_t> all_, stable_;
};

void count_standings(const Judged& judged, MonteCarloSection& section) {
  for (const auto index : judged.all()) {
    const PlantOutcome& outcome = judged.outcome(index);
    section.confirmed += outcome.confirmed;
    section.contradicted += outcome.contradicted;
    if (outcome.stable()) continue;
    ++(outcome.standing == design::Standing::unstable ? section.unstable : section.undecided);
    if (section.unstable_plants.size() < MonteCarloSection::most_listed) {
      section.unstable_plants.push_back(judged.notable(index));
    }
  }
  section.stable = judged.stable().size();
  section.instability = design::probability(section.unstable + section.undecided, section.plants);
}

void summarise_losses(const Judged& judged, MonteCarloSection& section) {
  const auto rms = judged.of_stable(&PlantOutcome::beam_rms);
  section.beam_rms = design::summarise(rms, shares());
  std::vector<double> climate_rms;
  if (section.climate) {
    climate_rms = judged.of_stable(&PlantOutcome::climate_rms);
    section.climate_rms = design::summarise(climate_rms, shares());
  }
  for (auto& [band, loss, climate_loss] : section.losses) {
    const auto in_band = [&named = band](double value) { return mean_loss(value, named); };
    loss = design::summarise(mapped(rms, in_band), shares());
    if (section.climate) {
      climate_loss = design::summarise(mapped(climate_rms, in_band), shares());
    }
  }
  for (auto& [budget, met] : section.budgets) {
    const double limit = budget.rms;
    const auto hits = judged.count(
        [&](const PlantOutcome& one) { return one.stable() && one.beam_rms <= limit; });
    met = design::probability(hits, section.plants);
  }
}

void count_goals(const Judged& judged, MonteCarloSection& section) {
  const auto names = design::goal_names(section.goals);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto hits = judged.count([&](const PlantOutcome& one) {
      return one.stable() && ((one.broken_goals >> k) & 1U) != 0;
    });
    section.goals_broken.push_back({names[k], design::probability(hits, section.plants)});
  }
  const auto met =
      judged.count([](const PlantOutcome& one) { return one.stable() && one.broken_goals == 0; });
  section.all_goals_met = design::probability(met, section.plants);
}

void correlate(const Judged& judged, MonteCarloSection& section) {
  const auto rms = judged.of_stable(&PlantOutcome::beam_rms);
  std::vector<design::PlantDraw> draws;
  draws.reserve(rms.size());
  for (const auto index : judged.stable()) draws.push_back(judged.draw(index));
  for (const auto input : section.inputs) {
    std::vector<double> values;
    values.reserve(draws.size());
    for (const auto& draw : draws) values.push_back(draw[input]);
    section.correlations.push_back({input, design::rank_correlation(values, rms)});
  }
  std::ranges::stable_sort(section.correlations, [](const auto& one, const auto& other) {
    return std::abs(one.with_rms.value) > std::abs(other.with_rms.value);
  });
}

void find_worst(const Judged& judged, MonteCarloSection& section) {
  constexpr std::size_t most = 10;
  auto order = judged.stable();
  const std::size_t count = std::min(most, order.size());
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(count),
                            [&](std::uint64_t one, std::uint64_t other) {
                              const double a = judged.outcome(one).beam_rms;
                              const double b = judged.outcome(other).beam_rms;
                              return a > b || (a == b && one < other);
                            });
  for (std::size_t k = 0; k < count; ++k) section.worst.push_back(judged.notable(order[k]));
}

void summarise_retuned(const Judged& judged, MonteCarloSection& section) {
  MonteCarloSection::Retuned retuned;
  std::vector<double> rms, price;
  for (const auto index : judged.all()) {
    const PlantOutcome& one = judged.outcome(index);
    if (std::isnan(one.retuned_rms)) continue;
    ++retuned.found;
    rms.push_back(one.retuned_rms);
    if (one.stable()) {
      price.push_back(one.beam_rms / one.retuned_rms - 1.0);
    } else {
      ++retuned.only_retuned;
    }
  }
  retuned.beam_rms = design::summarise(std::move(rms), shares());
  retuned.price = design::summarise(std::move(price), shares());
  section.retuned = std::move(retuned);
}

std::string per_cent(double share) {
  const double value = 100.0 * share;
  return value > 0.0 && value < 0.01 ? fmt::format("{:.2g} %", value)
                                     : fmt::format("{:.2f} %", value);
}

std::string between(const design::EstimatedNumber& number) {
  return fmt::format("{} ({} to {})", per_cent(number.value), per_cent(number.lower),
                     per_cent(number.upper));
}

}  // namespace

void summarise(const design::MonteCarloRun& run, const design::PlantDistribution& distribution,
               MonteCarloSection& section) {
  const design::MonteCarlo& study = run.study();
  const Judged judged(run, distribution, section.seed);
  if (judged.all().empty()) {
    throw Interrupted("montecarlo: interrupted before a block of plants was whole");
  }
  section.plants_asked = study.plants;
  section.plants = judged.all().size();
  section.interrupted = section.plants < section.plants_asked;
  section.distribution = source_text(distribution);
  section.inputs = distribution.inputs();
  section.goals = study.goals;
  section.climate = !study.problem.climate.empty();
  section.confirm_peak = study.held.confirm_peak;
  section.confirm_every = study.confirm_every;
  count_standings(judged, section);
  summarise_losses(judged, section);
  count_goals(judged, section);
  correlate(judged, section);
  find_worst(judged, section);
  if (study.retune) summarise_retuned(judged, section);
}

std::vector<std::string> conclude(const MonteCarloSection& section) {
  std::vector<std::string> sentences;
  const std::string wind = fmt::format("in the {} wind model at {:g} m/s mean speed",
                                       plant::to_string(section.wind_model), section.wind_speed);
  if (section.stable > 0) {
    const auto& q = section.beam_rms.quantiles;
    sentences.push_back(fmt::format(
        "With these gains held, {} beam rms is {:.4f} mdeg in the middle and up to {:.4f} mdeg on "
        "95 "
        "% of the plants that are stable: so far as the plants are what they are drawn from.",
        wind, q[3].number.value / millidegree, q[5].number.value / millidegree));
  }
  const std::uint64_t lost = section.unstable + section.undecided;
  sentences.push_back(
      lost == 0 ? fmt::format("None of {} plants is unstable: fewer than {} of all may be (95 %).",
                              section.plants, per_cent(section.instability.upper))
                : fmt::format(
                      "The loop is not stable on {} of {} plants, {}: they are counted and listed, "
                      "and enter no mean.",
                      lost, section.plants, between(section.instability)));
  for (const auto& [budget, met] : section.budgets) {
    sentences.push_back(
        fmt::format("The budget '{}' (band {}, {:.4f} mdeg) is met {} by {} of the "
                    "plants, one axis, linear.",
                    budget.name, budget.band, budget.rms / millidegree, wind, between(met)));
  }
  sentences.push_back(fmt::format("All hard goals are met by {}.", between(section.all_goals_met)));
  if (!section.correlations.empty() && section.stable > 9) {
    const auto& first = section.correlations.front();
    sentences.push_back(fmt::format(
        "What moves the rms most among the inputs is the {} (rank correlation {:+.2f}): a rank "
        "correlation sees trends, not causes that turn.",
        to_string(first.input), first.with_rms.value));
  }
  if (section.retuned) {
    const auto& retuned = *section.retuned;
    sentences.push_back(
        retuned.price.draws > 0
            ? fmt::format(
                  "Holding one law for all costs {:.1f} % of rms in the middle and {:.1f} % "
                  "on 5 % of the plants, against a law tuned for each plant alone.",
                  100.0 * retuned.price.quantiles[3].number.value,
                  100.0 * retuned.price.quantiles[5].number.value)
            : std::string("No plant is stable under both the held law and one of its own."));
  }
  return sentences;
}

}  // namespace boresight::app
