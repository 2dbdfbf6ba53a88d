#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/limits/robust_constraints.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

// Peaks are interpolated between frequencies, to 2e-4, at the edges of encoder codes to 3e-3.
constexpr double reserve = 1e-3;
constexpr double unstable = 3.0;

// 1/s, from encoder to command.
double static_gain(const plant::StateSpace& controller) {
  const Eigen::Index column = plant::input_index(controller, "encoder");
  return std::abs(numerics::transfer_matrix(controller.a, controller.b.col(column), controller.c,
                                            controller.d.col(column), 1.0)(0, 0));
}

}  // namespace

void validate(const SampledLoopGoals& goals) {
  if (goals.sensitivity_peak > 1.0 && goals.standstill_peak > 1.0 && goals.edge_peak > 1.0 &&
      goals.position_peak.value_or(2.0) > 1.0 && goals.control_effort > 0.0 &&
      goals.locked_motor_gain.value_or(1.0) > 0.0 && goals.static_gain.value_or(1.0) > 0.0 &&
      std::isfinite(goals.static_gain.value_or(1.0))) {
    return;
  }
  const auto if_given = [](const char* text, const std::optional<double>& value) {
    return value ? fmt::format(fmt::runtime(text), *value) : std::string();
  };
  throw InvalidInput(fmt::format(
      "sampled loops: expected maximum sensitivities above 1, a control effort and a gain above "
      "0, found {}, {} at standstill, {} at an edge{} and {} rad/s{}{}",
      goals.sensitivity_peak, goals.standstill_peak, goals.edge_peak,
      if_given(", {} of the position loop", goals.position_peak), goals.control_effort,
      if_given(", {} N.m/rad", goals.locked_motor_gain),
      if_given(", {} 1/s at rest", goals.static_gain)));
}

RobustConstraints::RobustConstraints(const ConstrainedPlants& plants, const SampledLoopGoals& goals,
                                     unsigned threads)
    : on_(plants), goals_(goals), threads_(threads) {
  validate(goals);
  if (on_.plants.empty()) {
    throw InvalidInput("sampled loops: expected at least one plant, found none");
  }
  const Eigen::ArrayXd& frequency = on_.plants.front().frequency();
  for (const auto settings :
       {on_.plants, on_.at_standstill, on_.at_edges, on_.corners, on_.motor_locked}) {
    for (const SampledSetting& one : settings) {
      if (one.frequency().size() != frequency.size() || (one.frequency() != frequency).any()) {
        throw InvalidInput("sampled loops: expected the same frequencies in every setting");
      }
    }
  }
}

bool RobustConstraints::stable(const plant::StateSpace& controller) const {
  if (!(numerics::spectral_radius(controller.a) < 1.0)) return false;
  for (const auto settings : {on_.at_standstill, on_.at_edges, on_.corners, on_.plants}) {
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
      SampledSetting::controller_response(controller, on_.plants.front().frequency());
  using Peak = SampledPeak (SampledSetting::*)(const Eigen::ArrayXXcd&) const;
  struct Limited {
    const SampledSetting* setting;
    Peak peak;
    double goal;
  };
  std::vector<Limited> limited;
  const auto limit = [&](std::span<const SampledSetting> settings, Peak peak, double goal) {
    for (const SampledSetting& one : settings) limited.push_back({&one, peak, goal});
  };
  limit(on_.plants, &SampledSetting::highest_peak, goals_.sensitivity_peak);
  limit(on_.at_standstill, &SampledSetting::highest_peak, goals_.standstill_peak);
  limit(on_.at_edges, &SampledSetting::highest_peak, goals_.edge_peak);
  limit(on_.corners, &SampledSetting::highest_peak, goals_.sensitivity_peak);
  if (goals_.position_peak) {
    limit(on_.plants, &SampledSetting::highest_position_peak, *goals_.position_peak);
    limit(on_.at_standstill, &SampledSetting::highest_position_peak, goals_.standstill_peak);
  }
  if (goals_.locked_motor_gain)
    limit(on_.motor_locked, &SampledSetting::highest_locked_motor_gain, *goals_.locked_motor_gain);
  const auto peaks = static_cast<Eigen::Index>(limited.size());
  Eigen::VectorXd ratios(peaks + (goals_.static_gain ? 1 : 0));
  numerics::for_each_index(limited.size(), threads_, [&](std::size_t i) {
    const auto& [setting, peak, goal] = limited[i];
    const double found = (setting->*peak)(response).magnitude;
    ratios[static_cast<Eigen::Index>(i)] = std::isfinite(found) ? std::log(found / goal) : HUGE_VAL;
  });
  if (goals_.static_gain) {
    const double found = static_gain(controller);
    ratios[peaks] = found > 0.0 ? std::log(*goals_.static_gain / found) : HUGE_VAL;
  }
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
  std::vector<double> effort(on_.plants.size());
  numerics::for_each_index(on_.plants.size(), threads_, [&](std::size_t i) {
    effort[i] = on_.plants[i].control_effort(controller);
  });
  const double largest = *std::ranges::max_element(effort);
  return std::min(std::max(of_peak, std::log(largest / goals_.control_effort) + 1e-6), unstable);
}

Eigen::VectorXd RobustConstraints::rms(const plant::StateSpace& controller) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(on_.plants.size() + on_.at_standstill.size()));
  numerics::for_each_index(static_cast<std::size_t>(result.size()), threads_, [&](std::size_t i) {
    const SampledSetting& setting =
        i < on_.plants.size() ? on_.plants[i] : on_.at_standstill[i - on_.plants.size()];
    result[static_cast<Eigen::Index>(i)] = setting.boresight_rms(controller);
  });
  return result;
}

double RobustConstraints::largest_rms(const plant::StateSpace& controller) const {
  std::vector<double> rms(on_.plants.size());
  numerics::for_each_index(rms.size(), threads_, [&](std::size_t i) {
    rms[i] = on_.plants[i].boresight_rms(controller);
  });
  return *std::ranges::max_element(rms);
}

}  // namespace boresight::design
