#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include <boresight/design/commissioning/plant_update.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t fewest_plants = 20;
// Effective plants that make intervals of their own, and how many times the plants asked for may be
// drawn for them.
constexpr double enough = 40.0;
constexpr std::size_t most_times = 16, most_times_unexplained = 4;
constexpr double tail = 0.025;
constexpr double certainty = 0.99;

double squared_difference(const MeasuredQuantity& measured, const CommissioningStage& stage,
                          const StageObservation& seen) {
  const double predicted = value_of(measured.quantity, seen);
  const double difference = measured.value - with_effect(measured.quantity, predicted, stage);
  return std::isfinite(difference) ? std::pow(difference / comparison_deviation(measured, stage), 2)
                                   : infinity;
}

// Flow and command of the valve over the rate are one measurement; the flow depends less on
// friction.
std::vector<MeasuredQuantity> independent(const std::vector<MeasuredQuantity>& quantities) {
  std::vector<MeasuredQuantity> kept = quantities;
  const auto has_flow =
      std::ranges::count(kept, StageQuantity::flow_per_rate, &MeasuredQuantity::quantity) > 0;
  if (has_flow) {
    std::erase_if(kept, [](const MeasuredQuantity& one) {
      return one.quantity == StageQuantity::valve_per_rate;
    });
  }
  return kept;
}

double mismatch_of(StageObserver& observer, const CommissioningPlan& plan,
                   const std::vector<MeasuredStage>& records) {
  double sum = 0.0;
  for (const MeasuredStage& record : records) {
    if (record.measurement.quantities.empty()) continue;
    const CommissioningStage& stage = plan.stages[record.stage];
    const StageObservation seen = observer.observe(stage.controller);
    if (!seen.stable) return infinity;
    for (const auto& one : independent(record.measurement.quantities)) {
      sum += squared_difference(one, stage, seen);
    }
  }
  return sum;
}

PlantEstimate estimate(const std::vector<double>& values, const std::vector<double>& weights) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  PlantEstimate result{0.0, 0.0, 0.0};
  double below = 0.0;
  bool begun = false;
  for (const std::size_t i : order) {
    result.mean += weights[i] * values[i];
    below += weights[i];
    if (!begun && below >= tail) {
      result.lower = values[i];
      begun = true;
    }
    if (below - weights[i] < 1.0 - tail) result.upper = values[i];
  }
  return result;
}

// How much the records say of an input: by how many of its deviations it moves, and narrows.
double informed(const InputUpdate& update) {
  const double width = update.before.upper - update.before.lower;
  if (!(width > 0.0)) return 0.0;
  return std::abs(update.after.mean - update.before.mean) / width + 1.0 -
         (update.after.upper - update.after.lower) / width;
}

struct Drawn {
  PlantSample sample;
  double mismatch = 0.0;
  double final_rms = 0.0;
};

void check(const CommissioningPlan& plan, const std::vector<MeasuredStage>& records,
           std::size_t quantities, std::size_t count) {
  if (count < fewest_plants) {
    throw InvalidInput(
        fmt::format("updated_plants: expected at least {} plants, found {}", fewest_plants, count));
  }
  if (quantities == 0) {
    throw InvalidInput("updated_plants: expected at least one measured quantity, found none");
  }
  for (const MeasuredStage& record : records) {
    if (record.stage < plan.stages.size()) continue;
    throw InvalidInput(
        fmt::format("updated_plants: expected a stage of the {} of the plan, found {}",
                    plan.stages.size(), record.stage + 1));
  }
}

std::size_t quantities_of(const std::vector<MeasuredStage>& records) {
  std::size_t quantities = 0;
  for (const MeasuredStage& record : records) {
    quantities += independent(record.measurement.quantities).size();
  }
  return quantities;
}

double least_mismatch(const std::vector<Drawn>& drawn) {
  return std::ranges::min(drawn, {}, &Drawn::mismatch).mismatch;
}

// The likelihoods, which sum to 1. At least one mismatch is finite.
std::vector<double> weights_of(const std::vector<Drawn>& drawn) {
  const double least = least_mismatch(drawn);
  std::vector<double> weights;
  double sum = 0.0;
  for (const Drawn& one : drawn) {
    weights.push_back(std::exp(-0.5 * (one.mismatch - least)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double effective_number(const std::vector<Drawn>& drawn) {
  if (!std::isfinite(least_mismatch(drawn))) return 0.0;
  double square = 0.0;
  for (const double weight : weights_of(drawn)) square += weight * weight;
  return 1.0 / square;
}

void add_inputs(const PlantDistribution& distribution, const std::vector<Drawn>& drawn,
                const std::vector<double>& even, const std::vector<double>& weights,
                PlantUpdate& update) {
  for (const UncertainInput input : distribution.inputs()) {
    std::vector<double> values;
    for (const Drawn& one : drawn) values.push_back(one.sample[input]);
    update.inputs.push_back({input, estimate(values, even), estimate(values, weights)});
  }
  std::ranges::stable_sort(update.inputs, std::ranges::greater(), informed);
}

}  // namespace

double comparison_deviation(const MeasuredQuantity& measured, const CommissioningStage& stage) {
  constexpr double of_rms = 0.1;
  double model = of_rms * measured.value;
  if (measured.quantity == StageQuantity::overshoot) {
    model = overshoot_resolution;
  } else if (measured.quantity == StageQuantity::rise_time ||
             measured.quantity == StageQuantity::settling_time) {
    model = time_resolution * measured.value;
  } else if (measured.quantity == StageQuantity::valve_per_rate ||
             measured.quantity == StageQuantity::flow_per_rate) {
    model = valve_resolution * measured.value;
  } else if (measured.quantity == StageQuantity::oil_stiffness) {
    model = stiffness_resolution * measured.value;
  }
  // Friction torques within their allowance are two deviations.
  const auto effect =
      std::ranges::find(stage.effects, measured.quantity, &ExperimentEffect::quantity);
  double by_friction = 0.0;
  if (effect != stage.effects.end()) {
    by_friction = 0.25 * (effect->upper - effect->lower);
    if (measured.quantity != StageQuantity::overshoot) {
      by_friction *= measured.value / effect->nominal;
    }
  }
  return std::hypot(measured.uncertainty, model, by_friction);
}

std::vector<MeasuredStage> combined(const std::vector<MeasuredStage>& records) {
  std::vector<MeasuredStage> result;
  for (const MeasuredStage& record : records) {
    auto same = std::ranges::find(result, record.stage, &MeasuredStage::stage);
    if (same == result.end()) {
      result.push_back({record.stage, {}});
      same = std::prev(result.end());
    }
    for (const auto& one : record.measurement.quantities)
      same->measurement.quantities.push_back(one);
  }
  for (MeasuredStage& stage : result) {
    std::map<StageQuantity, MeasuredQuantity> means;
    std::map<StageQuantity, double> counts;
    for (const auto& one : stage.measurement.quantities) {
      auto& mean = means.try_emplace(one.quantity, MeasuredQuantity{one.quantity}).first->second;
      mean.value += one.value;
      mean.uncertainty = std::hypot(mean.uncertainty, one.uncertainty);
      mean.steps += one.steps;
      counts[one.quantity] += 1.0;
    }
    stage.measurement.quantities.clear();
    for (auto& [quantity, mean] : means) {
      mean.value /= counts[quantity];
      mean.uncertainty /= counts[quantity];
      stage.measurement.quantities.push_back(mean);
    }
  }
  return result;
}

PlantUpdate updated_plants(const Mission& mission, const PlantDistribution& distribution,
                           const CommissioningPlan& plan, const CommandedMove& move,
                           const std::vector<MeasuredStage>& measured,
                           const std::vector<AntennaFault>& faults, std::size_t count,
                           const TrialOptions& options) {
  const std::vector<MeasuredStage> records = combined(measured);
  PlantUpdate update;
  update.quantities = quantities_of(records);
  check(plan, records, update.quantities, count);
  const TrialAntenna antenna(mission, move);
  std::vector<Drawn> drawn;
  const auto draw_more = [&](std::size_t more) {
    const std::size_t before = drawn.size();
    drawn.resize(before + more);
    for_each_plant(before, drawn.size(), options, [&](std::size_t i) {
      Drawn& one = drawn[i];
      one.sample = distribution.draw(options.seed, i);
      StageObserver observer = antenna.observer(changes_of(one.sample));
      one.mismatch = mismatch_of(observer, plan, records);
      one.final_rms = observer.observe(plan.stages.back().controller).boresight_rms;
      // One that is unstable at the end has no rms: it cannot be left.
      if (!std::isfinite(one.final_rms)) one.mismatch = infinity;
    });
  };
  const double explained =
      numerics::chi_squared_quantile(certainty, static_cast<double>(update.quantities));
  const auto most = [&] {
    return count * (least_mismatch(drawn) <= explained ? most_times : most_times_unexplained);
  };
  draw_more(count);
  while (effective_number(drawn) < enough && drawn.size() < most()) draw_more(drawn.size());
  update.plants = drawn.size();
  update.mismatch = least_mismatch(drawn);
  update.explained = update.mismatch <= explained;
  if (!update.explained) {
    for (const AntennaFault& fault : faults) {
      StageObserver observer = antenna.observer(fault.changes, fault.factors);
      const double mismatch = mismatch_of(observer, plan, records);
      if (mismatch < update.mismatch) update.faults.push_back({fault.name, mismatch});
    }
    std::ranges::stable_sort(update.faults, {}, &FaultFit::mismatch);
  }
  if (!std::isfinite(update.mismatch)) return update;
  const std::vector<double> even(drawn.size(), 1.0 / static_cast<double>(drawn.size()));
  const std::vector<double> weights = weights_of(drawn);
  update.effective = effective_number(drawn);
  add_inputs(distribution, drawn, even, weights, update);
  std::vector<double> rms, of_stable;
  for (const Drawn& one : drawn) {
    const bool stable = std::isfinite(one.final_rms);
    rms.push_back(stable ? one.final_rms : 0.0);
    of_stable.push_back(stable ? 1.0 : 0.0);
  }
  const double stable = std::reduce(of_stable.begin(), of_stable.end());
  for (double& weight : of_stable) weight /= stable;
  update.final_rms_before = estimate(rms, of_stable);
  update.final_rms_after = estimate(rms, weights);
  return update;
}

}  // namespace boresight::design
