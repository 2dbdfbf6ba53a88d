#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <boresight/design/commissioning/band_power.hpp>
#include <boresight/design/commissioning/commissioning_records.hpp>
#include <boresight/identification/signals/spectrum.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

constexpr Eigen::Index min_samples = 64;
// A segment is at most this part of the shorter record: enough averages for an interval.
constexpr double segment_fraction = 1.0 / 8.0;
constexpr double bins_of_a_band = 3.0;

void check(const RecordedChannel& channel, const char* which) {
  const bool sampled = channel.sample_time > 0.0 && std::isfinite(channel.sample_time);
  if (channel.values.size() < min_samples || !sampled) {
    throw InvalidInput(fmt::format(
        "compare_records: expected at least {} samples at a positive sample time, found {} at {} s "
        "in the record {}",
        min_samples, channel.values.size(), channel.sample_time, which));
  }
  if (!channel.values.allFinite()) {
    throw InvalidInput(fmt::format(
        "compare_records: expected finite samples, found one that is not in the record {}", which));
  }
}

// About as long as the other record's, in time.
identification::SpectralMatrix spectrum(const RecordedChannel& channel, double segment_time) {
  identification::SpectrumOptions options;
  options.segment_length = std::max<Eigen::Index>(
      8, static_cast<Eigen::Index>(std::llround(segment_time / channel.sample_time)));
  options.detrend = identification::Detrend::line;
  return identification::spectral_matrix(channel.values, channel.sample_time, options,
                                         channel.valid);
}

BandComparison compare_band(const identification::SpectralMatrix& before,
                            const identification::SpectralMatrix& after, double from, double to,
                            double confidence) {
  const BandPower first = band_power(before, 0, from, to);
  const BandPower second = band_power(after, 0, from, to);
  if (first.bins == 0 || second.bins == 0) {
    throw InvalidInput(
        fmt::format("compare_records: expected bands that hold frequencies of both "
                    "spectra, found none from {:g} to {:g} Hz",
                    from, to));
  }
  const bool moving = first.mean_square > 0.0 && second.mean_square > 0.0;
  if (!moving) {
    throw InvalidInput(fmt::format(
        "compare_records: expected records that move, found nothing from {:g} to {:g} Hz in the "
        "record {}",
        from, to, first.mean_square > 0.0 ? "after" : "before"));
  }
  BandComparison band{
      from,          to, std::sqrt(first.mean_square), std::sqrt(second.mean_square), first.freedom,
      second.freedom};
  const auto [ratio, lower, upper] = rms_ratio(first, second, confidence);
  band.ratio = ratio;
  band.lower = lower;
  band.upper = upper;
  band.change = change_of({ratio, lower, upper});
  return band;
}

std::vector<double> octaves(double highest, double bin) {
  std::vector<double> edges{highest};
  while (edges.back() - 0.5 * edges.back() >= bins_of_a_band * bin) {
    edges.push_back(0.5 * edges.back());
  }
  std::ranges::reverse(edges);
  return edges;
}

}  // namespace

std::string_view to_string(Change change) {
  static constexpr std::array names{"no significant change", "better", "worse"};
  return names.at(static_cast<std::size_t>(change));
}

Change change_of(const RatioBand& ratio) {
  return ratio.upper < 1.0 ? Change::better : ratio.lower > 1.0 ? Change::worse : Change::none;
}

RecordComparison compare_records(const RecordedChannel& before, const RecordedChannel& after,
                                 const RecordComparisonOptions& options) {
  check(before, "before");
  check(after, "after");
  const bool within = options.confidence > 0.0 && options.confidence < 1.0;
  if (!within) {
    throw InvalidInput(fmt::format("compare_records: expected a confidence within (0, 1), found {}",
                                   options.confidence));
  }
  const auto duration = [](const RecordedChannel& channel) {
    return channel.sample_time * static_cast<double>(channel.values.size());
  };
  const double segment = segment_fraction * std::min(duration(before), duration(after));
  const auto first = spectrum(before, segment);
  const auto second = spectrum(after, segment);
  const double highest = 0.5 / std::max(before.sample_time, after.sample_time);
  const double bin = std::max(first.frequency[1], second.frequency[1]);
  std::vector<double> edges = options.edges;
  if (edges.empty()) edges = octaves(highest, bin);
  if (edges.size() < 2 || !std::ranges::is_sorted(edges, std::less_equal<>())) {
    throw InvalidInput(fmt::format(
        "compare_records: expected at least two rising edges of bands, found {}", edges.size()));
  }
  RecordComparison result;
  result.whole = compare_band(first, second, edges.front(), edges.back(), options.confidence);
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    result.bands.push_back(compare_band(first, second, edges[k], edges[k + 1], options.confidence));
  }
  const Eigen::VectorXd one = first.auto_density(0);
  const Eigen::VectorXd other = second.auto_density(0);
  for (Eigen::Index i = 1; i < one.size(); ++i) {
    const double f = first.frequency[i];
    const auto nearest = static_cast<Eigen::Index>(std::llround(f / second.frequency[1]));
    if (f > edges.back() || nearest >= other.size() || nearest < 1) break;
    result.frequency.push_back(f);
    result.density_before.push_back(one[i]);
    result.density_after.push_back(other[nearest]);
  }
  return result;
}

}  // namespace boresight::design
