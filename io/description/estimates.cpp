#include <boresight/io/description/estimates.hpp>

namespace boresight::io {
namespace {

void members_of_estimate(Visitor& v, const design::EstimatedNumber& estimate,
                         const KeyUnit& unnamed) {
  v.number("value", estimate.value, unnamed, "The estimate.");
  v.number("lower", estimate.lower, unnamed, "Where its interval begins.");
  v.number("upper", estimate.upper, unnamed, "Where it ends.");
}

void members_of_distribution(Visitor& v, const design::DistributionSummary& summary,
                             const KeyUnit& unnamed) {
  v.defined_as("distribution",
               "Over plants that are stable, in the unit of the key that holds it.");
  v.count("plants", summary.random_samples, "That it is over.");
  describe_estimate(v, "mean", summary.mean, unnamed, "Arithmetic.");
  describe_estimate(v, "standard_deviation", summary.standard_deviation, unnamed, "By n - 1.");
  v.number("minimum", summary.minimum, unnamed, "Of all.");
  v.number("largest", summary.largest, unnamed, "Of all.");
  v.list("quantiles", summary.quantiles, "By rising fraction.",
         [&](const design::EstimatedQuantile& quantile) {
           v.defined_as("quantile", "A value that a fraction of the plants does not exceed.");
           v.number("fraction", quantile.fraction, key_units::ratio, "Of the plants.",
                    {.minimum = 0.0, .maximum = 1.0, .finite = true});
           members_of_estimate(v, quantile.number, unnamed);
         });
}

}  // namespace

void describe_estimate(Visitor& v, std::string_view key, const design::EstimatedNumber& estimate,
                       const KeyUnit& unit, std::string_view meaning) {
  v.group(key_with_unit(key, unit), meaning, [&] {
    v.defined_as("estimate",
                 "A number from the samples with the interval that holds the truth in 95 % of such "
                 "studies; null: unbounded, or too few samples.");
    members_of_estimate(v, estimate, without_suffix(unit));
  });
}

void describe_distribution(Visitor& v, std::string_view key,
                           const design::DistributionSummary& summary, const KeyUnit& unit,
                           std::string_view meaning) {
  v.group(key_with_unit(key, unit), meaning,
          [&] { members_of_distribution(v, summary, without_suffix(unit)); });
}

void describe_distribution(Visitor& v, std::string_view key,
                           const std::optional<design::DistributionSummary>& summary,
                           const KeyUnit& unit, std::string_view meaning) {
  v.optional_group(key_with_unit(key, unit), summary, meaning,
                   [&](const design::DistributionSummary& there) {
                     members_of_distribution(v, there, without_suffix(unit));
                   });
}

}  // namespace boresight::io
