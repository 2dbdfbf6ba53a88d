#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/fast_integrator.hpp>

namespace boresight::plant {
namespace {

constexpr Eigen::Index stages = collocation_stages;
// The error scales with the sixth power of the step where the channels are smooth, at a kink with
// the second: a doubled step is tried when this little of the tolerance is used.
constexpr double easy = 1.0 / 50.0;
constexpr int patience = 6;  // steps after a refusal before a longer one is tried
// What the inner stages may be off, relative to the end of the step.
constexpr double inner_weight = 0.1;

FastIntegratorOptions checked(FastIntegratorOptions options, Eigen::Index channel_inputs) {
  if (!(options.interval > 0.0) || !std::isfinite(options.interval)) {
    throw InvalidInput(
        fmt::format("FastIntegrator: expected an interval above 0, found {} s", options.interval));
  }
  if (options.finest_rung < 0 || options.finest_rung > 30) {
    throw InvalidInput(fmt::format("FastIntegrator: expected a finest_rung of 0 to 30, found {}",
                                   options.finest_rung));
  }
  if (!(options.relative_tolerance >= 0.0) || !(options.relative_tolerance < 1.0)) {
    throw InvalidInput(
        fmt::format("FastIntegrator: expected a relative_tolerance of 0 to 1, found {}",
                    options.relative_tolerance));
  }
  const Eigen::VectorXd& absolute = options.absolute_tolerance;
  if (absolute.size() != 1 && absolute.size() != channel_inputs) {
    throw InvalidInput(
        fmt::format("FastIntegrator: expected one absolute_tolerance or {}, one for each channel "
                    "input, found {}",
                    channel_inputs, absolute.size()));
  }
  for (const double tolerance : absolute) {
    if (!(tolerance > 0.0) || !std::isfinite(tolerance)) {
      throw InvalidInput(
          fmt::format("FastIntegrator: expected absolute_tolerance above 0, found {}", tolerance));
    }
  }
  return options;
}

}  // namespace

FastIntegrator::FastIntegrator(const FeedbackSystem& system, FastIntegratorOptions options)
    : options_(checked(std::move(options), system.channel_inputs)),
      collocation_(system, options_.largest_condition, options_.interval),
      solver_(system.channels, system.channel_inputs, system.channel_outputs) {
  const Eigen::Index p = system.channel_inputs, q = system.channel_outputs;
  if (options_.absolute_tolerance.size() == 1) {
    options_.absolute_tolerance = Eigen::VectorXd::Constant(p, options_.absolute_tolerance[0]);
  }
  const FeedbackMatrices& matrices = collocation_.matrices();
  const Eigen::Index states = matrices.a.rows(), inputs = matrices.input.cols();
  channel_names_.assign(system.linear.inputs.end() - q, system.linear.inputs.end());
  channel_input_names_.assign(system.linear.outputs.begin(), system.linear.outputs.begin() + p);
  rungs_.resize(static_cast<std::size_t>(options_.finest_rung) + 1);
  start_.setZero(states + 2 * inputs);
  drive_.setZero(2 * inputs + stages * q);
  scratch_.setZero(states);
  free_.setZero(stages * p);
  for (auto* values : {&stages_, &past_}) values->setZero(stages * q);
  now_.n.setZero(q);
  for (auto* values : {&scale_, &now_.z}) values->setZero(p);
  for (auto* values : {&u_end_, &u_from_, &u_to_}) values->setZero(inputs);
  now_.slope.setZero(q, p);
  y_.setZero(matrices.output.rows());
  rung(0);
}

const CollocationStep& FastIntegrator::rung(int index) {
  auto& data = rungs_[static_cast<std::size_t>(index)];
  if (!data) data = collocation_.step(std::ldexp(options_.interval, -index));
  return *data;
}

void FastIntegrator::start_from(const Eigen::VectorXd& state, double time) {
  const Eigen::Index states = collocation_.matrices().a.rows();
  if (state.size() != states || !state.allFinite() || !std::isfinite(time)) {
    throw InvalidInput(fmt::format(
        "FastIntegrator: expected a finite time and a state of {} finite elements, found {} s and "
        "{}{}",
        states, time, state.size(), state.allFinite() ? "" : ", not all finite"));
  }
  start_.head(states) = collocation_.to_coordinates(state);
  time_ = interval_start_ = time;
  intervals_ = 0;
  rung_ = jump_rung_ = hold_off_ = 0;
  past_length_ = 0.0;
  known_ = failed_ = false;
  solver_.forget();
}

Eigen::VectorXd FastIntegrator::state() const {
  return collocation_.to_state(start_.head(collocation_.matrices().a.rows()));
}

// z and n at the start of an interval, after whatever the inputs did there.
void FastIntegrator::begin_interval(const Eigen::Ref<const Eigen::VectorXd>& u_start) {
  if (known_ && u_start == u_end_) return;
  const FeedbackMatrices& matrices = collocation_.matrices();
  now_.z.noalias() = collocation_.channel_output() * start_.head(matrices.a.rows());
  now_.z.noalias() += matrices.input_to_channels * u_start;
  const Eigen::Index bad = solver_.evaluate(now_);
  if (bad >= 0) {
    failed_ = true;
    throw NumericalFailure(
        fmt::format("FastIntegrator: the channel '{}' is not finite at t = {:.9g} s",
                    channel_names_[static_cast<std::size_t>(bad)], time_));
  }
  past_length_ = 0.0;
  solver_.forget();
  rung_ = std::max(rung_, jump_rung_);
}

// A first guess of n at the stages: the polynomial of the step before.
void FastIntegrator::extrapolate(double length) {
  const Eigen::Index q = now_.n.size();
  if (past_length_ == 0.0) {
    for (Eigen::Index j = 0; j < stages; ++j) stages_.segment(j * q, q) = now_.n;
    return;
  }
  const double ratio = length / past_length_;
  if (ratio != extrapolation_ratio_) {
    extrapolation_ratio_ = ratio;
    const auto& c = collocation_points;
    for (std::size_t j = 0; j < stages; ++j) {
      for (std::size_t k = 0; k < stages; ++k) {
        double& weight = extrapolation_[j][k];
        weight = 1.0;
        for (std::size_t i = 0; i < stages; ++i) {
          if (i != k) weight *= (1.0 + c[j] * ratio - c[i]) / (c[k] - c[i]);
        }
      }
    }
  }
  for (Eigen::Index i = 0; i < q; ++i) {
    for (std::size_t j = 0; j < stages; ++j) {
      const auto& weight = extrapolation_[j];
      stages_[static_cast<Eigen::Index>(j) * q + i] =
          weight[0] * past_[i] + weight[1] * past_[q + i] + weight[2] * past_[2 * q + i];
    }
  }
}

// Of the step just solved, relative to what is allowed.
double FastIntegrator::error_of(const CollocationStep& step) {
  const Eigen::Index p = now_.z.size(), q = now_.n.size();
  if (q == 0) return 0.0;
  const Eigen::VectorXd& error = solver_.error(step, now_, stages_);
  if (!std::isfinite(error.sum())) return std::numeric_limits<double>::infinity();
  double worst = 0.0;
  for (Eigen::Index j = 0; j < stages + 2; ++j) {
    const double weight = j + 1 < stages ? inner_weight : 1.0;
    for (Eigen::Index i = 0; i < p; ++i) {
      const double allowed =
          options_.absolute_tolerance[i] +
          options_.relative_tolerance *
              std::max(std::abs(now_.z[i]), std::abs(solver_.z()[(stages - 1) * p + i]));
      const double fraction = weight * std::abs(error[j * p + i]) / allowed;
      if (fraction <= worst) continue;
      worst = fraction;
      worst_input_ = i;
    }
  }
  return worst;
}

FastIntegrator::Refusal FastIntegrator::attempt(const CollocationStep& step) {
  free_.noalias() = step.start_to_stages * start_;
  if (!std::isfinite(free_.sum())) return Refusal::overflow;
  scale_ = options_.absolute_tolerance + options_.relative_tolerance * now_.z.cwiseAbs();
  extrapolate(step.length);
  const auto outcome = solver_.solve(step, free_, scale_, stages_);
  statistics_.newton_iterations += solver_.iterations();
  if (outcome == StageSolver::Outcome::not_finite) return Refusal::not_finite;
  if (outcome == StageSolver::Outcome::diverged) return Refusal::divergence;
  error_ = error_of(step);
  return error_ <= 1.0 ? Refusal::none : Refusal::error;
}

void FastIntegrator::accept(const CollocationStep& step) {
  const Eigen::Index n = scratch_.size(), m = u_end_.size();
  drive_ << start_.tail(2 * m), stages_;
  auto v = start_.head(n);
  step.propagate(v, scratch_);
  v.noalias() += step.drive_to_end * drive_;
  solver_.end(stages_, now_);
  past_.swap(stages_);
  past_length_ = step.length;
  ++statistics_.steps;
}

void FastIntegrator::advance(const Eigen::Ref<const Eigen::VectorXd>& u_start,
                             const Eigen::Ref<const Eigen::VectorXd>& u_end) {
  const Eigen::Index inputs = u_end_.size(), states = scratch_.size();
  if (u_start.size() != inputs || u_end.size() != inputs || !u_start.allFinite() ||
      !u_end.allFinite()) {
    throw InvalidInput(
        fmt::format("FastIntegrator: expected {} finite inputs at both ends, found {} and {}{}",
                    inputs, u_start.size(), u_end.size(),
                    u_start.allFinite() && u_end.allFinite() ? "" : ", not all finite"));
  }
  if (failed_) {
    throw InvalidInput("FastIntegrator: expected start_from after a failure, found advance");
  }
  begin_interval(u_start);
  const bool jumped = past_length_ == 0.0;
  known_ = false;  // should this interval fail
  const long long whole = 1LL << options_.finest_rung;
  long long place = 0;
  start_.tail(inputs) = u_start;
  while (place < whole) {
    const long long size = whole >> rung_;
    const CollocationStep& step = rung(rung_);
    const double end = static_cast<double>(place + size) / static_cast<double>(whole);
    start_.segment(states, inputs) = start_.tail(inputs);
    if (place + size == whole) {
      start_.tail(inputs) = u_end;
    } else {
      start_.tail(inputs) = u_start + end * (u_end - u_start);
    }
    const Refusal refusal = attempt(step);
    if (refusal != Refusal::none) {
      ++statistics_.rejected;
      start_.tail(inputs) = start_.segment(states, inputs);
      if (rung_ == options_.finest_rung) {
        give_up(refusal, time_ + options_.interval * static_cast<double>(place) /
                                     static_cast<double>(whole));
      }
      int finer = 1;
      if (refusal == Refusal::error && std::isfinite(error_)) {
        finer = std::clamp(static_cast<int>(std::ceil(std::log2(2.0 * error_) / 5.0)), 1, 4);
      }
      rung_ = std::min(rung_ + finer, options_.finest_rung);
      hold_off_ = patience;
      solver_.forget();
      continue;
    }
    accept(step);
    statistics_.finest_rung = std::max(statistics_.finest_rung, rung_);
    if (jumped && place == 0) jump_rung_ = error_ < easy ? std::max(rung_ - 1, 0) : rung_;
    place += size;
    if (hold_off_ > 0) {
      --hold_off_;
    } else if (error_ < easy && rung_ > 0 && place % (2 * size) == 0) {
      --rung_;
    }
  }
  ++intervals_;
  time_ = interval_start_ + options_.interval * static_cast<double>(intervals_);
  u_end_ = u_end;
  known_ = true;
  const FeedbackMatrices& matrices = collocation_.matrices();
  y_.noalias() = collocation_.output() * start_.head(states);
  y_.noalias() += matrices.input_to_output * u_end;
  y_.noalias() += matrices.channels_to_output * now_.n;
  if (!y_.allFinite() || !start_.allFinite()) give_up(Refusal::overflow, time_);
}

void FastIntegrator::give_up(Refusal refusal, double time) {
  failed_ = true;
  const double shortest = std::ldexp(options_.interval, -options_.finest_rung);
  switch (refusal) {
    case Refusal::not_finite:
      throw NumericalFailure(
          fmt::format("FastIntegrator: the channel '{}' is not finite behind t = {:.9g} s, however "
                      "short the step",
                      channel_names_[static_cast<std::size_t>(solver_.worst_channel())], time));
    case Refusal::divergence:
      throw NumericalFailure(fmt::format(
          "FastIntegrator: Newton's method does not converge behind t = {:.9g} s in a step of "
          "{:.3g} "
          "s, worst at the channel '{}'; see whether it is continuous and its slopes are right",
          time, shortest, channel_names_[static_cast<std::size_t>(solver_.worst_channel())]));
    case Refusal::overflow:
      throw NumericalFailure(fmt::format(
          "FastIntegrator: the state of this unstable system overflows near t = {:.9g} s", time));
    default:
      throw NumericalFailure(
          fmt::format("FastIntegrator: the error in '{}' is {:.3g} times its tolerance behind t = "
                      "{:.9g} s in a "
                      "step of {:.3g} s; loosen the tolerances, or allow a finer rung than {}",
                      channel_input_names_[static_cast<std::size_t>(worst_input_)], error_, time,
                      shortest, options_.finest_rung));
  }
}

void FastIntegrator::simulate(const Eigen::Ref<const Eigen::MatrixXd>& input,
                              Eigen::Ref<Eigen::MatrixXd> output, Interpolation interpolation) {
  const Eigen::Index intervals = output.rows();
  const bool held = interpolation == Interpolation::zero_order_hold;
  if (input.cols() != u_end_.size() || output.cols() != y_.size() ||
      input.rows() != intervals + (held ? 0 : 1)) {
    throw InvalidInput(
        fmt::format("FastIntegrator: expected {} x {} inputs for intervals x {} outputs, found {} "
                    "x {} for {} x "
                    "{}",
                    held ? "intervals" : "(intervals + 1)", u_end_.size(), y_.size(), input.rows(),
                    input.cols(), intervals, output.cols()));
  }
  for (Eigen::Index k = 0; k < intervals; ++k) {
    u_from_ = input.row(k);
    u_to_ = input.row(held ? k : k + 1);
    advance(u_from_, u_to_);
    output.row(k) = y_;
  }
}

}  // namespace boresight::plant
