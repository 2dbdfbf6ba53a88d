#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/limits/robust_constraints.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

// Peaks are read off a parabola between frequencies: what it can miss is kept in hand.
constexpr double reserve = 1e-3;
constexpr double unstable = 3.0;

}  // namespace

void validate(const SampledLoopGoals& goals) {
  if (goals.sensitivity_peak > 1.0 && goals.standstill_peak > 1.0 && goals.edge_peak > 1.0 &&
      goals.position_peak.value_or(2.0) > 1.0 && goals.control_effort > 0.0) {
    return;
  }
  const std::string position =
      goals.position_peak ? fmt::format(", {} of the position loop", *goals.position_peak) : "";
  throw InvalidInput(fmt::format(
      "sampled loops: expected peaks of the sensitivity above 1 and a valve_effort above 0, found "
      "{}, {} at standstill, {} at an edge{} and {} rad/s",
      goals.sensitivity_peak, goals.standstill_peak, goals.edge_peak, position,
      goals.control_effort));
}

RobustConstraints::RobustConstraints(std::span<const SampledSetting> plants,
                                     std::span<const SampledSetting> at_standstill,
                                     std::span<const SampledSetting> at_edges,
                                     const SampledLoopGoals& goals, unsigned threads)
    : plants_(plants),
      at_standstill_(at_standstill),
      at_edges_(at_edges),
      goals_(goals),
      threads_(threads) {
  validate(goals);
  if (plants.empty()) throw InvalidInput("sampled loops: expected at least one plant, found none");
  const Eigen::ArrayXd& frequency = plants.front().frequency();
  for (const auto settings : {plants, at_standstill, at_edges}) {
    for (const SampledSetting& one : settings) {
      if (one.frequency().size() != frequency.size() || (one.frequency() != frequency).any()) {
        throw InvalidInput("sampled loops: expected the same frequencies in every setting");
      }
    }
  }
}

bool RobustConstraints::stable(const plant::StateSpace& controller) const {
  if (!(numerics::spectral_radius(controller.a) < 1.0)) return false;
  for (const auto settings : {at_standstill_, at_edges_, plants_}) {
    std::vector<double> radius(settings.size());
    numerics::for_each_index(radius.size(), threads_, [&](std::size_t i) {
      radius[i] = settings[i].spectral_radius(controller);
    });
    if (!std::ranges::all_of(radius, [](double one) { return one < 1.0; })) return false;
  }
  return true;
}

Eigen::VectorXd RobustConstraints::peaks(const plant::StateSpace& controller) const {
  const Eigen::ArrayXXcd response =
      SampledSetting::controller_response(controller, plants_.front().frequency());
  struct Limited {
    const SampledSetting* setting;
    bool position;
    double goal;
  };
  std::vector<Limited> limited;
  const auto limit = [&](std::span<const SampledSetting> settings, bool position, double goal) {
    for (const SampledSetting& one : settings) limited.push_back({&one, position, goal});
  };
  limit(plants_, false, goals_.sensitivity_peak);
  limit(at_standstill_, false, goals_.standstill_peak);
  limit(at_edges_, false, goals_.edge_peak);
  if (goals_.position_peak) {
    limit(plants_, true, *goals_.position_peak);
    limit(at_standstill_, true, goals_.standstill_peak);
  }
  Eigen::VectorXd ratios(static_cast<Eigen::Index>(limited.size()));
  numerics::for_each_index(limited.size(), threads_, [&](std::size_t i) {
    const auto& [setting, position, goal] = limited[i];
    const double peak =
        (position ? setting->highest_position_peak(response) : setting->highest_peak(response))
            .magnitude;
    ratios[static_cast<Eigen::Index>(i)] = std::isfinite(peak) ? std::log(peak / goal) : HUGE_VAL;
  });
  return ratios;
}

double RobustConstraints::excess(const plant::StateSpace& controller) const {
  return excess(controller, peaks(controller));
}

double RobustConstraints::excess(const plant::StateSpace& controller,
                                 const Eigen::VectorXd& peaks) const {
  const double of_peak = peaks.maxCoeff() + reserve;
  if (of_peak > 0.0) return std::min(of_peak, unstable);
  if (!stable(controller)) return unstable;
  std::vector<double> effort(plants_.size());
  numerics::for_each_index(plants_.size(), threads_, [&](std::size_t i) {
    effort[i] = plants_[i].control_effort(controller);
  });
  const double largest = *std::ranges::max_element(effort);
  return std::min(std::max(of_peak, std::log(largest / goals_.control_effort) + 1e-6), unstable);
}

Eigen::VectorXd RobustConstraints::rms(const plant::StateSpace& controller) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(plants_.size() + at_standstill_.size()));
  numerics::for_each_index(static_cast<std::size_t>(result.size()), threads_, [&](std::size_t i) {
    const SampledSetting& setting =
        i < plants_.size() ? plants_[i] : at_standstill_[i - plants_.size()];
    result[static_cast<Eigen::Index>(i)] = setting.boresight_rms(controller);
  });
  return result;
}

double RobustConstraints::largest_rms(const plant::StateSpace& controller) const {
  std::vector<double> rms(plants_.size());
  numerics::for_each_index(rms.size(), threads_,
                           [&](std::size_t i) { rms[i] = plants_[i].boresight_rms(controller); });
  return *std::ranges::max_element(rms);
}

}  // namespace boresight::design
