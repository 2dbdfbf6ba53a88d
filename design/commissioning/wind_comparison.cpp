#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/commissioning/band_power.hpp>
#include <boresight/design/commissioning/wind_coherence.hpp>
#include <boresight/design/commissioning/wind_comparison.hpp>
#include <boresight/identification/signals/spectrum.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::design {
namespace {

constexpr Eigen::Index fewest_samples = 256;
constexpr double segment_fraction = 1.0 / 8.0;
// Of one over the segment: the first bin loses power to the straight line.
constexpr double first_bin_edge = 1.5;
constexpr std::size_t records_of_regression = 3;
constexpr double equal_speeds = 1.1;
// Of the rms of one controller between records in the same mean wind, relative.
constexpr double scatter_in_equal_wind = 0.1;
constexpr double power_below_band = 0.05;  // and as much above
constexpr double different_direction = 30.0 * degree;

[[noreturn]] void refuse(const WindyRecord& record, const std::string& text) {
  throw InvalidInput(fmt::format("compare_in_wind: {} in the record '{}'", text, record.name));
}

double duration_of(const WindyRecord& record) {
  return record.sample_time * static_cast<double>(record.error.values.size());
}

std::vector<bool> both_valid(const WindyRecord& record) {
  if (record.error.valid.empty() && record.wind_speed.valid.empty()) return {};
  std::vector<bool> valid;
  for (Eigen::Index i = 0; i < record.error.values.size(); ++i) {
    valid.push_back(record.error.is_valid(i) && record.wind_speed.is_valid(i));
  }
  return valid;
}

void check(const WindyRecord& record) {
  const Eigen::Index samples = record.error.values.size();
  if (samples < fewest_samples || !(record.sample_time > 0.0)) {
    refuse(record, fmt::format("expected at least {} samples at a positive sample time, found {} "
                               "at {} s",
                               fewest_samples, samples, record.sample_time));
  }
  const auto check_signal = [&](const identification::Signal& signal, const char* name) {
    const auto mask = static_cast<Eigen::Index>(signal.valid.size());
    if (signal.values.size() != samples || (mask != 0 && mask != samples)) {
      refuse(record, fmt::format("expected {} samples of the {}, found {}", samples, name,
                                 signal.values.size()));
    }
    if (!signal.values.allFinite()) refuse(record, fmt::format("expected a finite {}", name));
  };
  check_signal(record.error, "error");
  if (!(record.error.values.maxCoeff() > record.error.values.minCoeff())) {
    refuse(record, "expected an error that varies, found none");
  }
  check_signal(record.wind_speed, "wind speed");
  if (record.wind_direction) check_signal(*record.wind_direction, "wind direction");
}

struct Moments {
  double mean = 0.0, deviation = 0.0;
};

Moments moments_of(const identification::Signal& signal) {
  double count = 0.0, sum = 0.0, squares = 0.0;
  for (Eigen::Index i = 0; i < signal.values.size(); ++i) {
    if (!signal.is_valid(i)) continue;
    count += 1.0;
    sum += signal.values[i];
    squares += signal.values[i] * signal.values[i];
  }
  if (count == 0.0) return {};
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

// Channels: squared wind speed, error.
identification::SpectralMatrix spectra_of(const WindyRecord& record, double segment) {
  identification::SpectrumOptions options;
  options.segment_length = std::max<Eigen::Index>(
      8, static_cast<Eigen::Index>(std::llround(segment / record.sample_time)));
  options.detrend = identification::Detrend::line;
  Eigen::MatrixXd channels(record.error.values.size(), 2);
  channels.col(0) = record.wind_speed.values.array().square().matrix();
  channels.col(1) = record.error.values;
  try {
    return identification::spectral_matrix(channels, record.sample_time, options,
                                           both_valid(record));
  } catch (const NumericalFailure&) {
    refuse(record,
           fmt::format("expected {:.3g} s of valid samples at a stretch, found none", segment));
  }
}

std::optional<double> mean_direction(const std::vector<WindyRecord>& records) {
  std::complex<double> sum;
  for (const WindyRecord& record : records) {
    if (!record.wind_direction) continue;
    std::complex<double> one;
    for (Eigen::Index i = 0; i < record.wind_direction->values.size(); ++i) {
      if (record.wind_direction->is_valid(i)) {
        one += std::polar(1.0, record.wind_direction->values[i]);
      }
    }
    if (std::abs(one) > 0.0) sum += one / std::abs(one);
  }
  if (!(std::abs(sum) > 0.0)) return std::nullopt;
  const double angle = std::arg(sum);
  return angle < 0.0 ? angle + two_pi : angle;
}

struct Evaluated {
  std::vector<identification::SpectralMatrix> spectra;
  std::vector<BandPower> power;
};

class Comparison {
 public:
  Comparison(const std::vector<WindyRecord>& before, const std::vector<WindyRecord>& after,
             const WindComparisonOptions& options)
      : options_(options) {
    check_options();
    double segment = options.longest_segment;
    double highest = std::numeric_limits<double>::infinity();
    for (const auto* records : {&before, &after}) {
      if (records->empty()) {
        throw InvalidInput(fmt::format("compare_in_wind: expected records, found none {}",
                                       records == &before ? "before" : "after"));
      }
      for (const WindyRecord& record : *records) {
        check(record);
        segment = std::min(segment, segment_fraction * duration_of(record));
        highest = std::min(highest, 0.5 / record.sample_time);
      }
    }
    result_.lowest = first_bin_edge / segment;
    result_.highest = highest;
    if (!(result_.lowest < result_.highest)) {
      throw InvalidInput(fmt::format(
          "compare_in_wind: expected records whose lengths and sampling rates leave a "
          "common band, found {:.3g} Hz from the shortest and {:.3g} Hz from the slowest",
          result_.lowest, result_.highest));
    }
    evaluate(before, segment, result_.before, evaluated_[0]);
    evaluate(after, segment, result_.after, evaluated_[1]);
  }

  WindComparison compare() {
    measure_gusts();
    compare_coherence();
    if (result_.before.wind_direction && result_.after.wind_direction) {
      const double difference =
          std::remainder(*result_.after.wind_direction - *result_.before.wind_direction, two_pi);
      result_.directions_differ = std::abs(difference) > different_direction;
    }
    const bool enough = std::min(result_.before.records.size(), result_.after.records.size()) >=
                        records_of_regression;
    enough ? regress() : compare_equal_wind();
    return std::move(result_);
  }

 private:
  void check_options() const {
    const bool valid =
        options_.confidence > 0.0 && options_.confidence < 1.0 && options_.longest_segment > 0.0 &&
        options_.reference_speed.value_or(1.0) > 0.0 && options_.design_speed.value_or(1.0) > 0.0;
    if (!valid) {
      throw InvalidInput(
          "compare_in_wind: expected a confidence within (0, 1), positive wind speeds and a "
          "positive segment, found others");
    }
  }

  void evaluate(const std::vector<WindyRecord>& records, double segment, ConditionInWind& condition,
                Evaluated& evaluated) {
    for (const WindyRecord& record : records) {
      evaluated.spectra.push_back(spectra_of(record, segment));
      const auto& spectra = evaluated.spectra.back();
      // The last bin reaches beyond the band by half its width.
      const BandPower power =
          band_power(spectra, 1, result_.lowest, result_.highest + 0.5 / segment);
      const Moments wind = moments_of(record.wind_speed);
      if (!(wind.mean > 0.0)) refuse(record, "expected a positive mean wind speed, found none");
      evaluated.power.push_back(power);
      condition.records.push_back({record.name, duration_of(record), wind.mean,
                                   wind.deviation / wind.mean, std::sqrt(power.mean_square),
                                   power.freedom, 0.0});
    }
    const auto speeds = std::ranges::minmax(condition.records, {}, &WindyRecordFigures::mean_speed);
    condition.slowest = speeds.min.mean_speed;
    condition.fastest = speeds.max.mean_speed;
    condition.wind_direction = mean_direction(records);
  }

  // Bins that all records have.
  Eigen::Index bins() const {
    Eigen::Index fewest = std::numeric_limits<Eigen::Index>::max();
    for (const Evaluated& one : evaluated_) {
      for (const auto& spectra : one.spectra) {
        fewest = std::min(fewest, spectra.frequency.size());
      }
    }
    return fewest;
  }

  // The bins with the middle of the errors' power, each record counted alike.
  std::pair<Eigen::Index, Eigen::Index> error_band() const {
    Eigen::VectorXd shape = Eigen::VectorXd::Zero(bins());
    for (const Evaluated& one : evaluated_) {
      for (const auto& spectra : one.spectra) {
        const Eigen::VectorXd density = spectra.auto_density(1).head(shape.size());
        shape += density / density.tail(shape.size() - 1).sum();
      }
    }
    const double whole = shape.tail(shape.size() - 1).sum();
    Eigen::Index first = 1, last = 1;
    double sum = 0.0;
    for (Eigen::Index k = 1; k < shape.size(); ++k) {
      sum += shape[k];
      if (sum < power_below_band * whole) first = k + 1;
      if (sum < (1.0 - power_below_band) * whole) last = k + 1;
    }
    return {first, last};
  }

  void measure_gusts() {
    const auto [first, last] = error_band();
    std::vector<double> log_speed, log_power;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& records = condition(side).records;
      for (std::size_t i = 0; i < records.size(); ++i) {
        const double power =
            evaluated_.at(side).spectra[i].auto_density(0).segment(first, last - first + 1).sum();
        // A wind that is recorded without gusts says nothing of them.
        if (!(power > 0.0)) return;
        log_speed.push_back(std::log(records[i].mean_speed));
        log_power.push_back(std::log(power));
      }
    }
    const auto count = static_cast<Eigen::Index>(log_speed.size());
    const Eigen::Map<const Eigen::ArrayXd> speed(log_speed.data(), count);
    const Eigen::Map<const Eigen::ArrayXd> power(log_power.data(), count);
    const Eigen::ArrayXd deviation = speed - speed.mean();
    const double spread = deviation.square().sum();
    const double slope = spread > 0.0 ? (deviation * power).sum() / spread : 0.0;
    const Eigen::ArrayXd gusts = power - power.mean() - slope * deviation;
    Eigen::Index at = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      for (WindyRecordFigures& record : condition(side).records) record.log_gusts = gusts[at++];
    }
  }

  // Mean speeds that both conditions have.
  std::pair<double, double> shared_range() const {
    return {std::max(result_.before.slowest, result_.after.slowest),
            std::min(result_.before.fastest, result_.after.fastest)};
  }

  void compare_coherence() {
    const auto [lowest, highest] = shared_range();
    std::array<std::vector<CoherentSpectra>, 2> in_equal_wind;
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<CoherentSpectra> all;
      for (std::size_t i = 0; i < condition(side).records.size(); ++i) {
        all.push_back(coherent_spectra(evaluated_.at(side).spectra[i], bins()));
        const double speed = condition(side).records[i].mean_speed;
        if (speed >= lowest && speed <= highest) in_equal_wind.at(side).push_back(all.back());
      }
      const ExplainedPower explained = explained_power(all);
      condition(side).explained = explained.fraction;
      condition(side).explained_threshold = explained.threshold;
    }
    result_.by_coherence = coherent_ratio(in_equal_wind[0], in_equal_wind[1], options_.confidence);
  }

  void regress() {
    const auto [lowest, highest] = shared_range();
    if (lowest > equal_wind_range * highest) {
      result_.kind = WindComparisonKind::no_overlap;
      return;
    }
    result_.kind = WindComparisonKind::regression;
    std::vector<ErrorInWind> errors;
    std::vector<double> shared;
    for (std::size_t side = 0; side < 2; ++side) {
      for (const WindyRecordFigures& record : condition(side).records) {
        errors.push_back({side == 1, record.rms * record.rms, record.freedom, record.mean_speed,
                          record.log_gusts});
        if (record.mean_speed >= lowest && record.mean_speed <= highest) {
          shared.push_back(record.mean_speed);
        }
      }
    }
    const double median =
        shared.empty() ? std::sqrt(lowest * highest) : numerics::median(std::move(shared));
    const double reference = options_.reference_speed.value_or(median);
    const WindErrorFit fit(std::move(errors), reference);
    result_.exponent = fit.exponent();
    result_.gust_exponent = fit.gust_exponent();
    result_.at_reference = at_speed(fit, reference);
    if (options_.design_speed) result_.at_design = at_speed(fit, *options_.design_speed);
  }

  RatioAtSpeed at_speed(const WindErrorFit& fit, double speed) const {
    const RatioBand ratio = fit.ratio(speed, options_.confidence);
    const auto outside = [speed](const ConditionInWind& condition) {
      return speed * equal_wind_range < condition.slowest ||
             speed > equal_wind_range * condition.fastest;
    };
    return {speed,
            fit.error(false, speed, options_.confidence),
            fit.error(true, speed, options_.confidence),
            ratio,
            change_of(ratio),
            outside(result_.before),
            outside(result_.after)};
  }

  void compare_equal_wind() {
    const double slowest = std::min(result_.before.slowest, result_.after.slowest);
    const double fastest = std::max(result_.before.fastest, result_.after.fastest);
    if (fastest > equal_speeds * slowest) {
      result_.kind = WindComparisonKind::too_few_records;
      return;
    }
    result_.kind = WindComparisonKind::equal_wind;
    const double reference = std::sqrt(slowest * fastest);
    std::array<BandPower, 2> sum{};
    std::array<RmsBand, 2> error{};
    std::array<double, 2> log_speed{};
    double scatter = 0.0;  // variance of the logarithm of the ratio
    for (std::size_t side = 0; side < 2; ++side) {
      BandPower& whole = sum.at(side);
      const auto& records = condition(side).records;
      const auto count = static_cast<double>(records.size());
      for (std::size_t i = 0; i < records.size(); ++i) {
        const BandPower& one = evaluated_.at(side).power[i];
        const double faster = std::log(records[i].mean_speed / reference);
        whole.mean_square +=
            one.freedom * one.mean_square * std::exp(-usual_wind_exponent * faster);
        whole.freedom += one.freedom;
        log_speed.at(side) += faster / count;
      }
      whole.mean_square /= whole.freedom;
      scatter += scatter_in_equal_wind * scatter_in_equal_wind / count;
      error.at(side) = rms_interval(whole, options_.confidence);
    }
    const double of_exponent = 0.5 * usual_wind_exponent_deviation * (log_speed[1] - log_speed[0]);
    const double more = numerics::student_quantile(0.5 + 0.5 * options_.confidence, 1e6);
    const double added = more * more * (scatter + of_exponent * of_exponent);
    RatioBand ratio = rms_ratio(sum[0], sum[1], options_.confidence);
    const auto wider = [&](double end) {
      return std::sqrt(std::pow(std::log(end / ratio.value), 2) + added);
    };
    ratio = {ratio.value, ratio.value * std::exp(-wider(ratio.lower)),
             ratio.value * std::exp(wider(ratio.upper))};
    result_.at_reference = {reference, error[0], error[1], ratio, change_of(ratio), false, false};
  }

  ConditionInWind& condition(std::size_t side) {
    return side == 0 ? result_.before : result_.after;
  }

  WindComparisonOptions options_;
  WindComparison result_;
  std::array<Evaluated, 2> evaluated_;
};

}  // namespace

std::string_view to_string(WindComparisonKind kind) {
  static constexpr std::array names{"regression on the wind speed", "equal wind",
                                    "wind speeds without overlap", "too few records"};
  return names.at(static_cast<std::size_t>(kind));
}

WindComparison compare_in_wind(const std::vector<WindyRecord>& before,
                               const std::vector<WindyRecord>& after,
                               const WindComparisonOptions& options) {
  return Comparison(before, after, options).compare();
}

}  // namespace boresight::design
