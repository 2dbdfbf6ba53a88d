#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/loops/loop_evaluator_state.hpp>
#include <boresight/control/loops/panel_rule.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using ChannelValues = std::array<Complex, numerics::pack_size>;
constexpr double two_pi = 2.0 * std::numbers::pi;
// In ln w: what turns within less is taken for an undamped pole, which nothing would resolve.
constexpr double narrowest_panel = 1e-7;
// In ln w: of the panel that carries what lies below it.
constexpr double lowest_panel = 1e-3;
// Panels kept between evaluations, some 2.5 kB each, and those of one evaluation.
constexpr std::size_t most_panels = 4000;
constexpr std::size_t most_leaves = 4000;

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
double LoopEvaluator::State::panel_weight(const Panel& panel, std::size_t lane) const {
  const PanelRule& rule = panel_rule();
  if (panel.from == lowest_place_) return 0.5 * rule.weight[lane] * std::exp(panel.to) / two_pi;
  const double w = std::exp(panel.centre() + panel.half_width() * rule.node[lane]);
  return panel.half_width() * rule.weight[lane] * w / two_pi;
}

// Adds the panel; its values come from the plant.
std::uint32_t LoopEvaluator::State::add_panel(double from, double to) {
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
    if (!std::isfinite(spectrum) || !std::isfinite(std::norm(response.beam_command)) ||
        !std::isfinite(std::norm(response.beam_wind))) {
      throw NumericalFailure(fmt::format(
          "LoopEvaluator: the plant's response or the wind's spectrum is not finite at {} Hz",
          hertz));
    }
  }
  packs_.push_back(pack);
  panels_.push_back({from, to, 0});
  return static_cast<std::uint32_t>(packs_.size() - 1);
}

void LoopEvaluator::State::add_resolved(double from, double to, const LoopQuadrature& quadrature) {
  const double half_width = 0.5 * (to - from), centre = 0.5 * (from + to);
  const std::uint32_t i = add_panel(from, to);
  const GridPack& pack = packs_[i];
  const auto resolved = [&](const numerics::ComplexPack& channel) {
    ChannelValues values;
    for (std::size_t j = 0; j < numerics::pack_size; ++j) {
      values[j] = {channel.re[j], channel.im[j]};
    }
    return polynomial(values, quadrature.channel_tolerance);
  };
  const bool fine =
      half_width < narrowest_panel ||
      (half_width <= 0.5 * quadrature.widest_panel && resolved(pack.tachometer_command) &&
       resolved(pack.torque_command) && resolved(pack.encoder_command) &&
       resolved(pack.beam_command) && resolved(pack.tachometer_wind) &&
       resolved(pack.torque_wind) && resolved(pack.encoder_wind) && resolved(pack.beam_wind));
  if (fine) {
    first_panels_.push_back(i);
    return;
  }
  packs_.pop_back();
  panels_.pop_back();
  add_resolved(from, centre, quadrature);
  add_resolved(centre, to, quadrature);
}

void LoopEvaluator::State::make_panels(const LoopQuadrature& quadrature) {
  std::vector<double> edges;
  const auto& [lowest, highest] = quadrature.analysis;
  for (const double edge : {lowest, highest, band_.lowest, band_.highest, noise_.bandwidth}) {
    if (edge >= lowest && edge <= highest) edges.push_back(std::log(two_pi * edge));
  }
  if (band_.lowest < lowest) {
    lowest_place_ = std::log(two_pi * lowest);
    edges.push_back(lowest_place_ + lowest_panel);
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    const double width = edges[e + 1] - edges[e];
    if (width < narrowest_panel) continue;
    const double parts = std::ceil(width / quadrature.widest_panel);
    for (double k = 0.0; k < parts; ++k) {
      add_resolved(edges[e] + width * k / parts, edges[e] + width * (k + 1.0) / parts, quadrature);
    }
  }
  values_.resize(packs_.size());
  use_first_panels();
}

struct LoopEvaluator::State::Limits {
  double beam = 0.0, effort = 0.0, demand = 0.0, torque = 0.0;  // squares of errors allowed
};

bool LoopEvaluator::State::close_enough(std::uint32_t i, const Limits& limits) const {
  const Panel& panel = panels_[i];
  const double half_width = panel.half_width();
  if (half_width < narrowest_panel) return true;
  const LoopValues& values = values_[i];
  // The lowest panel is smooth: it is narrow.
  if (packs_[i].weighted && panel.from != lowest_place_) {
    // The narrower the panel, the further in it a gain moves a pole: the gradient's error against
    // the variance's grows.
    const double allowed = half_width;
    if (PanelTail(values.beam_tail).error_square() > allowed * limits.beam ||
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
  if (packs_.size() > most_panels) keep_first_panels();
  sweep_values(sweep, first_panels_.data(), first_panels_.size());
  numerics::RealPack beam{}, effort{}, demand{}, torque{};
  for (const std::uint32_t i : first_panels_) {
    const LoopValues& values = values_[i];
    beam += values.wind + values.noise;
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
  const Limits limits{limit(beam), limit(effort), limit(demand), limit(torque)};
  leaves_.clear();
  // Each halving leaves one more to come back to.
  std::array<std::uint32_t, 64> waiting{};
  for (const std::uint32_t first : first_panels_) {
    std::size_t count = 1;
    waiting[0] = first;
    while (count > 0) {
      const std::uint32_t i = waiting[--count];
      if (count + 2 > waiting.size() || leaves_.size() > most_leaves || close_enough(i, limits)) {
        leaves_.push_back(i);
        continue;
      }
      if (panels_[i].first_half == 0) {
        const auto [from, to, none] = panels_[i];
        const double middle = 0.5 * (from + to);
        const std::uint32_t half = add_panel(from, middle);
        add_panel(middle, to);
        panels_[i].first_half = half;
        values_.resize(packs_.size());
      }
      const std::uint32_t half = panels_[i].first_half;
      const std::array<std::uint32_t, 2> halves{half, half + 1};
      sweep_values(sweep, halves.data(), 2);
      waiting[count++] = half + 1;
      waiting[count++] = half;
    }
  }
}

// Forgets what evaluations added.
void LoopEvaluator::State::keep_first_panels() {
  packs_.resize(first_panels_.size());
  panels_.resize(first_panels_.size());
  values_.resize(first_panels_.size());
  for (Panel& panel : panels_) panel.first_half = 0;
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
    plant::set_point(channels_.response, k,
                     {value(pack.tachometer_command) * advance,
                      value(pack.torque_command) * advance, value(pack.encoder_command) * advance,
                      value(pack.beam_command) * advance, value(pack.tachometer_wind),
                      value(pack.torque_wind), value(pack.encoder_wind), value(pack.beam_wind)});
  }
}

}  // namespace boresight::control
