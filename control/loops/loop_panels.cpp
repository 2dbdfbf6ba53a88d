#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/loops/loop_evaluator_state.hpp>
#include <boresight/control/loops/panel_rule.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using ChannelValues = std::array<Complex, numerics::pack_size>;
// In ln w: of the panel that carries what lies below it.
constexpr double lowest_panel = 1e-3;

void check(const LoopQuadrature& quadrature, const SensorNoise& noise) {
  const auto& [lowest, highest] = quadrature.analysis;
  if (!(lowest > 0.0) || !(highest > lowest) || !std::isfinite(highest)) {
    throw InvalidInput(fmt::format(
        "LoopEvaluator: expected an analysis band with 0 < lowest < highest, found {} and {} Hz",
        lowest, highest));
  }
  const FrequencyBand& band = quadrature.band;
  if (!(band.lowest >= 0.0) || !(band.highest > band.lowest) || !(band.lowest < highest) ||
      !(band.highest > lowest)) {
    throw InvalidInput(fmt::format(
        "LoopEvaluator: expected a band for the variances that rises and meets the analysis band "
        "of {} to {} Hz, found {} to {} Hz",
        lowest, highest, band.lowest, band.highest));
  }
  if (!(quadrature.tolerance > 0.0) || !(quadrature.channel_tolerance > 0.0) ||
      !(quadrature.widest_panel > 0.0) || !(noise.bandwidth > 0.0)) {
    throw InvalidInput(fmt::format(
        "LoopEvaluator: expected positive tolerances, panel width and noise bandwidth, found {}, "
        "{}, {} and {} Hz",
        quadrature.tolerance, quadrature.channel_tolerance, quadrature.widest_panel,
        noise.bandwidth));
  }
}

// Whether the last two coefficients of the Legendre series are small.
bool polynomial(const ChannelValues& values, double tolerance) {
  const PanelRule& rule = panel_rule();
  Complex six = 0.0, seven = 0.0;
  double largest = 0.0;
  for (std::size_t j = 0; j < numerics::pack_size; ++j) {
    six += rule.weight[j] * rule.tail[j][2] * values[j];
    seven += rule.weight[j] * rule.tail[j][3] * values[j];
    largest = std::max(largest, std::norm(values[j]));
  }
  return std::norm(six) + std::norm(seven) <= tolerance * tolerance * largest;
}

}  // namespace

LoopEvaluator::State::State(std::function<plant::ResponsePoint(double)> channels,
                            PanelConditions conditions)
    : channels_{{}, std::move(channels)},
      delay_(conditions.delay),
      noise_(conditions.noise),
      wind_spectrum_(std::move(conditions.wind_spectrum)),
      band_(conditions.quadrature.band),
      tolerance_(conditions.quadrature.tolerance) {
  check(conditions.quadrature, noise_);
  make_panels(conditions.quadrature);
}

// Hz. The lowest panel stands for all below it, with the density of its own frequencies.
double LoopEvaluator::State::panel_weight(const FrequencyPanel& panel, std::size_t lane) const {
  const PanelRule& rule = panel_rule();
  if (panel.from == lowest_place_) return 0.5 * rule.weight[lane] * std::exp(panel.to) / two_pi;
  const double w = std::exp(panel.centre() + panel.half_width() * rule.node[lane]);
  return panel.half_width() * rule.weight[lane] * w / two_pi;
}

// Adds the panel; its values come from the plant.
void LoopEvaluator::State::add_panel(double from, double to) {
  const double half_width = 0.5 * (to - from), centre = 0.5 * (from + to);
  const PanelRule& rule = panel_rule();
  GridPack pack;
  for (std::size_t lane = 0; lane < numerics::pack_size; ++lane) {
    const double w = std::exp(centre + half_width * rule.node[lane]);
    const double hertz = w / two_pi;
    const plant::ResponsePoint response = channels_.at(w);
    pack.set(lane, w, response, delay_);
    const double weight = panel_weight({from, to, 0}, lane);
    // Edges of the bands are edges of panels.
    const bool within = hertz > band_.lowest && hertz < band_.highest;
    const double spectrum = within ? wind_spectrum_(hertz) : 0.0;
    pack.set_weights(lane, within ? weight * spectrum : 0.0,
                     within && hertz < noise_.bandwidth ? weight : 0.0);
    if (!std::isfinite(spectrum) || !std::isfinite(std::norm(response.boresight_command)) ||
        !std::isfinite(std::norm(response.boresight_wind))) {
      throw NumericalFailure(fmt::format(
          "LoopEvaluator: the plant's response or the wind's spectrum is not finite at {} Hz",
          hertz));
    }
  }
  packs_.push_back(pack);
  values_.emplace_back();
  panels_.add(from, to);
}

void LoopEvaluator::State::add_resolved(double from, double to, const LoopQuadrature& quadrature) {
  const double half_width = 0.5 * (to - from), centre = 0.5 * (from + to);
  add_panel(from, to);
  const GridPack& pack = packs_.back();
  const auto resolved = [&](const numerics::ComplexPack& channel) {
    ChannelValues values;
    for (std::size_t j = 0; j < numerics::pack_size; ++j) {
      values[j] = {channel.re[j], channel.im[j]};
    }
    return polynomial(values, quadrature.channel_tolerance);
  };
  const bool fine =
      half_width < AdaptivePanels::narrowest ||
      (half_width <= 0.5 * quadrature.widest_panel && resolved(pack.tachometer_command) &&
       resolved(pack.torque_command) && resolved(pack.encoder_command) &&
       resolved(pack.boresight_command) && resolved(pack.tachometer_wind) &&
       resolved(pack.torque_wind) && resolved(pack.encoder_wind) && resolved(pack.boresight_wind));
  if (fine) {
    panels_.start_from_last();
    return;
  }
  packs_.pop_back();
  values_.pop_back();
  panels_.drop_last();
  add_resolved(from, centre, quadrature);
  add_resolved(centre, to, quadrature);
}

void LoopEvaluator::State::make_panels(const LoopQuadrature& quadrature) {
  const auto& [lowest, highest] = quadrature.analysis;
  std::vector<double> edges = places_within(
      lowest, highest, {lowest, highest, band_.lowest, band_.highest, noise_.bandwidth});
  if (band_.lowest < lowest) {
    lowest_place_ = std::log(two_pi * lowest);
    edges.push_back(lowest_place_ + lowest_panel);
  }
  for (const FrequencyPanel& panel : panels_between(std::move(edges), quadrature.widest_panel)) {
    add_resolved(panel.from, panel.to, quadrature);
  }
  use_first_panels();
}

struct LoopEvaluator::State::Limits {
  double boresight = 0.0, effort = 0.0, demand = 0.0, torque = 0.0;  // squares of errors allowed
};

bool LoopEvaluator::State::close_enough(std::uint32_t i, const Limits& limits) const {
  const FrequencyPanel& panel = panels_[i];
  const double half_width = panel.half_width();
  if (half_width < AdaptivePanels::narrowest) return true;
  const LoopValues& values = values_[i];
  // The lowest panel is smooth: it is narrow.
  if (packs_[i].weighted && panel.from != lowest_place_) {
    // The narrower the panel, the further in it a gain moves a pole: the gradient's error against
    // the variance's grows.
    const double allowed = half_width;
    if (PanelTail(values.boresight_tail).error_square() > allowed * limits.boresight ||
        PanelTail(values.effort_tail).error_square() > allowed * limits.effort) {
      return false;
    }
    if (gusts_ && (PanelTail(values.demand_tail).error_square() > allowed * limits.demand ||
                   PanelTail(values.torque_tail).error_square() > allowed * limits.torque)) {
      return false;
    }
  }
  return !any_negative(values.turn);
}

void LoopEvaluator::State::choose_leaves(const Sweep& sweep) {
  const std::vector<std::uint32_t>& first = panels_.first();
  if (panels_.drop_halves_if_too_many()) {
    packs_.resize(first.size());
    values_.resize(first.size());
  }
  sweep_values(sweep, first.data(), first.size());
  numerics::RealPack boresight{}, effort{}, demand{}, torque{};
  for (const std::uint32_t i : first) {
    const LoopValues& values = values_[i];
    boresight += values.wind + values.noise;
    effort += values.effort;
    if (gusts_) {
      demand += values.wind_demand;
      torque += values.wind_torque;
    }
  }
  const auto limit = [&](const numerics::RealPack& total) {
    const double error = tolerance_ * numerics::sum(total);
    return error * error;
  };
  const Limits limits{limit(boresight), limit(effort), limit(demand), limit(torque)};
  panels_.choose(
      leaves_, [&](double from, double to) { add_panel(from, to); },
      [&](const std::uint32_t* packs, std::size_t count) { sweep_values(sweep, packs, count); },
      [&](std::uint32_t i) { return close_enough(i, limits); });
}

// What others read of the grid.
void LoopEvaluator::State::use_first_panels() {
  const auto count = static_cast<Eigen::Index>(packs_.size() * numerics::pack_size);
  weight_.resize(count);
  channels_.response = plant::unset_response(Eigen::ArrayXd(count));
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k) / numerics::pack_size;
    const auto lane = static_cast<std::size_t>(k) % numerics::pack_size;
    const GridPack& pack = packs_[i];
    const double w = pack.frequency[lane], hertz = w / two_pi;
    const bool within = hertz > band_.lowest && hertz < band_.highest;
    weight_[k] = within ? panel_weight(panels_[i], lane) : 0.0;
    channels_.response.frequency[k] = w;
    const Complex advance = std::polar(1.0, w * delay_);
    const auto value = [&](const numerics::ComplexPack& channel) {
      return Complex{channel.re[lane], channel.im[lane]};
    };
    plant::set_point(
        channels_.response, k,
        {value(pack.tachometer_command) * advance, value(pack.torque_command) * advance,
         value(pack.encoder_command) * advance, value(pack.boresight_command) * advance,
         value(pack.tachometer_wind), value(pack.torque_wind), value(pack.encoder_wind),
         value(pack.boresight_wind)});
  }
}

}  // namespace boresight::control
