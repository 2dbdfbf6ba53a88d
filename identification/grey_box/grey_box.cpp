#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/grey_box/grey_box_search.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/numerics/singular_values.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using P = GreyBoxParameters;

void check(const GreyBoxOptions& options) {
  if (!(options.sample_rate >= 0.0) || options.further_starts < 0 || options.random_samples < 100 ||
      !(options.stretch > 0.0) || !(options.discrepancy.torque_balance >= 0.0) ||
      !(options.discrepancy.flow_balance >= 0.0) || !(options.discrepancy.stiffness >= 0.0) ||
      !(options.discrepancy.valve_lag >= 0.0)) {
    throw InvalidInput(fmt::format(
        "fit_grey_box: expected a sample rate from 0, further starts from 0, at least 100 samples, "
        "a "
        "positive stretch and discrepancies from 0, found {}, {}, {}, {}, {}, {} and {}",
        options.sample_rate, options.further_starts, options.random_samples, options.stretch,
        options.discrepancy.torque_balance, options.discrepancy.flow_balance,
        options.discrepancy.stiffness));
  }
}

double sample_rate(const DriveKnowledge& knowledge, const GreyBoxOptions& options) {
  if (options.sample_rate > 0.0) return options.sample_rate;
  double highest = 0.0;
  for (const auto& f : knowledge.locked_rotor_frequencies) highest = std::max(highest, f.value);
  return std::max(50.0, 8.0 * highest);
}

// Fraction of the flow that an error of the flow balance would make of the leakage's.
double leakage_discrepancy(const GreyBoxObjective& objective,
                           const std::vector<GreyBoxRecord>& records, const P& parameters,
                           const VectorXd& point, double flow_balance) {
  const VectorXd v = parameters.values(point);
  const double conductance = v(P::cross_leakage) + v(P::null_leakage) + 0.5 * v(P::case_leakage);
  double flow = 0.0, leaked = 0.0;
  for (const auto& channel : objective.channels()) {
    if (!channel.pressures) continue;
    flow += records[channel.record].motion.squaredNorm();
    leaked += (conductance * records[channel.record].torque).squaredNorm();
  }
  return flow > 0.0 && leaked > 0.0 ? flow_balance * std::sqrt(flow / leaked) : 0.0;
}

// Relative standard uncertainty of the valve's lag by what the model leaves out. Between samples
// the command and the pressures are straight lines, which leaves a twentieth of a sample interval:
// a lag of 5 ms is fitted 1.5 ms short in synthetic records of 20 ms.
double lag_discrepancy(const std::vector<GreyBoxRecord>& records, double lag, double relative) {
  constexpr double of_an_interval = 0.05;
  double interval = 0.0;
  for (const auto& record : records) {
    if (record.valve.size() > 0) interval = std::max(interval, record.sample_time);
  }
  return std::hypot(relative, of_an_interval * interval / lag);
}

class Progress {
 public:
  explicit Progress(const GreyBoxOptions& options) : options_(options) {}
  void operator()(const std::string& what, double fraction) const {
    if (options_.progress && !options_.progress(what, fraction)) {
      throw Interrupted("fit_grey_box: stopped as asked");
    }
  }

 private:
  const GreyBoxOptions& options_;
};

// Moves of the optimum when predictions reach farther and less far.
MatrixXd shifts_with_reach(const std::vector<GreyBoxRecord>& records, const P& parameters,
                           const VectorXd& point, unsigned threads) {
  MatrixXd shifts(point.size(), 2);
  for (Index i = 0; i < 2; ++i) {
    const P other = parameters.with_correction(i == 0 ? 0.4 : 1.6);
    GreyBoxObjective objective(records, other, threads);
    shifts.col(i) = search_with_scales(objective, point).x - point;
  }
  return shifts;
}

// Friction and offset that the drive's motion cannot tell apart, and a slope at a rate that it has
// not reached.
bool is_doubtful(const GreyBoxResult& result, const P& parameters, double DriveEstimate::*member) {
  const GreyBoxPosterior& posterior = result.posterior;
  if (member == &DriveEstimate::offset_as_recorded) return posterior.one_way != 0.0;
  if (member == &DriveEstimate::tracking_slope) {
    const double rate = parameters.tracking_rate();
    return !(rate > 0.0) || rate > result.motion.highest_rate;
  }
  return member == &DriveEstimate::coulomb_level &&
         (posterior.one_way != 0.0 || posterior.unsaturated > 0.0);
}

// Whether drawings and data sheets give the prior; a wide guess does of the others.
bool is_stated(double DriveEstimate::*member) {
  return member != &DriveEstimate::leakage_rate && member != &DriveEstimate::offset_as_recorded &&
         member != &DriveEstimate::coulomb_level && member != &DriveEstimate::tracking_slope &&
         member != &DriveEstimate::valve_lag;
}

void add_quantities(GreyBoxResult& result, const P& parameters, const GreyBoxOptions& options) {
  GreyBoxPosterior prior;
  prior.point = VectorXd::Zero(parameters.size());
  prior.covariance = MatrixXd::Identity(parameters.size(), parameters.size());
  const auto before =
      posterior_samples(parameters, prior, options.random_samples, options.seed + 1);
  const DriveEstimate centre = drive_estimate(parameters, prior.point);
  const auto& quantities = drive_quantities();
  const auto count = static_cast<Index>(quantities.size());
  MatrixXd all(options.random_samples, count);
  for (Index q = 0; q < count; ++q) {
    const auto& quantity = quantities[static_cast<std::size_t>(q)];
    VectorXd was(options.random_samples);
    for (Index i = 0; i < options.random_samples; ++i) {
      all(i, q) = result.random_samples[static_cast<std::size_t>(i)].*quantity.member;
      was(i) = before[static_cast<std::size_t>(i)].*quantity.member;
    }
    GreyBoxQuantity out;
    out.name = quantity.name;
    out.unit = quantity.unit;
    out.posterior = numerics::interval_from_samples(result.estimate.*quantity.member, all.col(q));
    out.prior = numerics::interval_from_samples(centre.*quantity.member, was);
    const double ratio = out.prior.standard_uncertainty > 0.0
                             ? out.posterior.standard_uncertainty / out.prior.standard_uncertainty
                             : 1.0;
    out.learnt = std::max(0.0, 1.0 - ratio * ratio);
    out.identified = out.learnt >= 0.5 && !is_doubtful(result, parameters, quantity.member);
    out.prior_from_drawings = is_stated(quantity.member);
    if (quantity.member == &DriveEstimate::bulk_modulus ||
        quantity.member == &DriveEstimate::oil_stiffness) {
      out.prior_from_drawings = parameters.list()[P::bulk_modulus].from_drawings;
    }
    result.quantities.push_back(out);
  }
  const MatrixXd centred = all.rowwise() - all.colwise().mean();
  const MatrixXd covariance = centred.transpose() * centred;
  result.correlation = MatrixXd::Identity(count, count);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < i; ++j) {
      const double size = std::sqrt(covariance(i, i) * covariance(j, j));
      result.correlation(i, j) = result.correlation(j, i) =
          size > 0.0 ? covariance(i, j) / size : 0.0;
    }
  }
}

void add_notes(GreyBoxResult& result) {
  auto& notes = result.notes;
  const auto& j = result.quantity("inertia as recorded");
  notes.push_back(
      fmt::format("The inertia as recorded ({:.4g} kg m2) and the offset carry the transducers' "
                  "errors, which no "
                  "test removes; the inertia itself ({:.4g} kg m2) has them in its interval.",
                  j.posterior.value, result.quantity("inertia").posterior.value));
  for (const auto& q : result.quantities) {
    if (q.identified) continue;
    notes.push_back(fmt::format(
        fmt::runtime(q.prior_from_drawings ? "The records add little about the {} ({:.0f} % of the "
                                             "variance before them remain): "
                                             "its interval, {:.4g} to {:.4g} {}, is that of "
                                             "drawings, data sheets and what was "
                                             "given."
                                           : "The {} is not identifiable from these records "
                                             "({:.0f} % of the variance before them "
                                             "remain): its interval, {:.4g} to {:.4g} {}, is a "
                                             "wide guess; do not build on it."),
        q.name, 100.0 * (1.0 - q.learnt), q.posterior.lower, q.posterior.upper, q.unit));
  }
  std::string unknown;
  for (const auto& p : result.parameters) {
    if (p.identified || !(p.parameter.spread > 0.0) || p.parameter.from_drawings) continue;
    unknown += (unknown.empty() ? "" : ", ") + p.parameter.name;
  }
  if (!unknown.empty()) {
    notes.push_back("Not identified and left near their guesses: " + unknown + ".");
  }
  for (const auto& number : result.stated_numbers) {
    if (std::abs(number.departure) < StatedNumberCheck::doubtful_beyond) continue;
    notes.push_back(fmt::format(
        "Records and all other stated numbers give {:.4g} ({:.4g} to {:.4g}) of the stated {}, "
        "{:.1f} standard uncertainties away; without it the inertia is {:.4g} kg m2 ({:.4g} to "
        "{:.4g}).",
        number.by_others.value, number.by_others.lower, number.by_others.upper, number.name,
        std::abs(number.departure), number.inertia.value, number.inertia.lower,
        number.inertia.upper));
  }
  if (!result.without_valve.empty()) {
    std::string names;
    for (const auto& name : result.without_valve) names += (names.empty() ? "" : ", ") + name;
    notes.push_back("Nothing is known of the valve in " + names +
                    ": these records say nothing of oil and leakage.");
  }
  Index white = 0;
  for (const auto& r : result.residuals) white += r.white ? 1 : 0;
  notes.push_back(fmt::format(
      "The prediction errors of {} of {} channels are white; for what is left of correlation and "
      "misfit the variances were raised {:.1f} times on average.",
      white, result.residuals.size(), result.posterior.inflation));
}

}  // namespace

const GreyBoxQuantity& GreyBoxResult::quantity(const std::string& name) const {
  for (const auto& q : quantities) {
    if (q.name == name) return q;
  }
  throw InvalidInput(
      fmt::format("GreyBoxResult::quantity: '{}' is not among the quantities", name));
}

GreyBoxResult fit_grey_box(const Campaign& campaign,
                           const std::optional<numerics::Interval>& bulk_modulus,
                           const GreyBoxOptions& options) {
  check(options);
  const Progress progress(options);
  const unsigned threads = numerics::thread_count(options.threads);
  GreyBoxRecordOptions record_options;
  record_options.sample_rate = sample_rate(campaign.knowledge, options);
  const auto records = prepare_records(campaign, record_options);
  const P parameters(campaign, records, bulk_modulus, options.bulk_modulus_guessed);

  GreyBoxResult result;
  for (const auto& record : campaign.records) {
    const auto used = std::find_if(records.begin(), records.end(),
                                   [&](const auto& r) { return r.name == record.name; });
    if (used == records.end()) {
      result.left_out.push_back(record.name);
    } else {
      result.records.push_back(record.name);
      if (used->valve.size() == 0) result.without_valve.push_back(record.name);
    }
  }

  GreyBoxObjective objective(records, parameters, threads);
  const double all = 3.0 + options.further_starts;
  progress("fitting from the priors", 0.0);
  auto best = search_with_scales(objective, VectorXd::Zero(parameters.size()));
  result.starts.push_back({best.sum_of_squares, best.iterations, best.converged()});
  numerics::LeastSquaresOptions coarse;
  coarse.iterations = 14;
  coarse.cost_tolerance = 1e-4;
  coarse.step_tolerance = 1e-4;
  for (int start = 1; start <= options.further_starts; ++start) {
    progress(fmt::format("fitting from start {}", start), (start + 1.0) / all);
    try {
      const VectorXd from =
          drawn_start(parameters, options.seed, static_cast<std::uint64_t>(start));
      auto found = search(objective, from, coarse);
      // On with it only where it may still win.
      if (!found.converged() && found.sum_of_squares < 1.3 * best.sum_of_squares) {
        const int before = found.iterations;
        numerics::LeastSquaresOptions longer = coarse;
        longer.iterations = 25;
        found = search(objective, found.x, longer);
        found.iterations += before;
      }
      result.starts.push_back({found.sum_of_squares, found.iterations, found.converged()});
      if (found.sum_of_squares < 0.999 * best.sum_of_squares) {
        // Scales and optimum together, from the better place.
        best = search_with_scales(objective, found.x);
      }
    } catch (const InvalidInput&) {
      // No prediction from there.
      result.starts.push_back({std::numeric_limits<double>::infinity(), 0, false});
    }
  }
  result.status = best.status;
  if (!best.converged()) {
    throw NumericalFailure(
        fmt::format("fit_grey_box: no start arrived ({}); look at the records and at the stated "
                    "numbers, of which one may be off by its unit",
                    numerics::describe(best.status)));
  }
  progress("judging how sure the result is", (all - 1.5) / all);
  const MatrixXd shifts = shifts_with_reach(records, parameters, best.x, threads);
  result.posterior = grey_box_posterior(objective, best.x, shifts, options.stretch);
  result.posterior.torque_discrepancy = options.discrepancy.torque_balance;
  result.posterior.stiffness_discrepancy = options.discrepancy.stiffness;
  result.posterior.lag_discrepancy = lag_discrepancy(
      records, parameters.values(best.x)(P::valve_lag), options.discrepancy.valve_lag);
  result.posterior.leakage_discrepancy =
      leakage_discrepancy(objective, records, parameters, best.x, options.discrepancy.flow_balance);
  const double unknown =
      torque_per_pressure(campaign.knowledge) * campaign.instruments.unknown_pressure_sum;
  result.posterior.offset_discrepancy =
      offset_discrepancy(objective, result.posterior, records, parameters,
                         options.discrepancy.torque_balance, unknown);
  result.stated_numbers = check_stated_numbers(parameters, result.posterior);
  result.influences = record_influences(objective, records, parameters, result.posterior);
  result.conflict = grey_box_conflict(parameters, best.x, result.stated_numbers);
  widen(result.posterior, parameters, result.conflict);
  result.motion = motion_of(records);
  add_unidentifiable_directions(result.posterior, parameters, result.motion);
  const MatrixXd products = objective.products(best.x);
  const auto svd =
      numerics::singular_values(products.topLeftCorner(parameters.size(), parameters.size()));
  result.rank = (svd.values.array() > 1.0).count();
  result.condition = std::sqrt(svd.values(0) + 1.0);
  result.residuals = residual_statistics(objective, records, best.x);
  const VectorXd values = parameters.values(best.x);
  for (Index i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters.list()[static_cast<std::size_t>(i)];
    GreyBoxParameterResult out;
    out.parameter = p;
    out.value = values(i);
    out.departure = best.x(i);
    out.remaining = std::sqrt(result.posterior.covariance(i, i));
    out.identified = out.remaining < 0.7;
    result.varied += p.spread > 0.0 ? 1 : 0;
    result.parameters.push_back(out);
  }
  result.estimate = drive_estimate(parameters, best.x);
  result.estimate.contradicted = result.conflict.widening > 1.0;
  const bool in_doubt =
      result.conflict.widening == 1.0 &&
      !departing_numbers(result.stated_numbers, StatedNumberCheck::doubtful_beyond).empty();
  result.random_samples =
      in_doubt
          ? samples_in_doubt(parameters, result.posterior, result.stated_numbers,
                             options.random_samples, options.seed)
          : posterior_samples(parameters, result.posterior, options.random_samples, options.seed);
  add_quantities(result, parameters, options);
  std::vector<double> times, rates, pressures;
  for (const auto& record : records) times.push_back(record.sample_time);
  for (const auto& r : result.residuals) (r.pressures ? pressures : rates).push_back(r.rms);
  result.sample_time = numerics::median(times);
  result.rate_scale = rates.empty() ? 0.0 : numerics::median(rates);
  result.pressure_scale = pressures.empty() ? 0.0 : numerics::median(pressures);
  result.model.push_back(parameters);
  add_notes(result);
  progress("done", 1.0);
  return result;
}

numerics::Interval friction_interval(const GreyBoxResult& result, double rate) {
  VectorXd random_samples(static_cast<Index>(result.random_samples.size()));
  for (Index i = 0; i < random_samples.size(); ++i) {
    random_samples(i) =
        friction_torque(result.random_samples[static_cast<std::size_t>(i)].friction, rate);
  }
  return numerics::interval_from_samples(friction_torque(result.estimate.friction, rate),
                                         random_samples);
}

std::vector<GreyBoxComparison> compare_with(
    const GreyBoxResult& result, const std::string& quantity,
    const std::vector<std::pair<std::string, numerics::Interval>>& others) {
  const numerics::Interval& own = result.quantity(quantity).posterior;
  std::vector<GreyBoxComparison> out;
  for (const auto& [name, other] : others) {
    const double spread = std::hypot(own.standard_uncertainty, other.standard_uncertainty);
    const double difference = other.value - own.value;
    out.push_back({name, other, difference / own.value,
                   spread > 0.0 ? difference / spread : std::numeric_limits<double>::infinity()});
  }
  return out;
}

}  // namespace boresight::identification
