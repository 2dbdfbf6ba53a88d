#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/design/commissioning/wind_error_fit.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::design {
namespace {

// In still air 0.1 and 0.05, at 8 m/s 1 and 0.5 more (before, after), in quadrature.
double variance(bool after, double speed, double exponent, double gusts) {
  const double half = after ? 0.5 : 1.0;
  return half * half * (0.01 + std::pow(speed / 8.0, exponent) * std::exp(0.8 * gusts));
}

std::vector<ErrorInWind> exact_records(double exponent, double freedom) {
  std::vector<ErrorInWind> records;
  for (int i = 0; i < 10; ++i) {
    for (const bool after : {false, true}) {
      const double speed = (after ? 6.0 : 4.0) + 0.5 * i;
      const double gusts = 0.2 * std::sin(3.0 * i + (after ? 1.0 : 0.0));
      records.push_back({after, variance(after, speed, exponent, gusts), freedom, speed, gusts});
    }
  }
  return records;
}

TEST(WindErrorFit, RecoversNoiseFreeRecords) {
  for (const double exponent : {4.2, 5.3, 6.0}) {
    const WindErrorFit fit(exact_records(exponent, 1e12), 7.0);
    EXPECT_NEAR(fit.exponent(), exponent, 1e-4);
    EXPECT_NEAR(fit.gust_exponent(), 0.8, 1e-4);
    for (const double speed : {5.0, 8.0, 12.0}) {
      const RatioBand ratio = fit.ratio(speed, 0.95);
      EXPECT_NEAR(ratio.value, 0.5, 1e-5);
      EXPECT_LT(ratio.upper - ratio.lower, 1e-3);
      EXPECT_NEAR(fit.error(true, speed, 0.95).value,
                  std::sqrt(variance(true, speed, exponent, 0.0)), 1e-4);
    }
    EXPECT_NEAR(fit.still_air_rms(false), 0.1, 1e-3);
    EXPECT_NEAR(fit.still_air_rms(true), 0.05, 1e-3);
  }
}

TEST(WindErrorFit, KeepsTheErrorOfStillAirAtZeroOrAbove) {
  auto records = exact_records(5.3, 40.0);
  for (ErrorInWind& one : records) one.variance -= one.after ? 0.0025 : 0.01;
  for (ErrorInWind& one : records) {
    if (one.speed < 6.5) one.variance *= 0.7;
  }
  const WindErrorFit fit(records, 7.0);
  EXPECT_EQ(fit.still_air_rms(false), 0.0);
  EXPECT_NEAR(fit.ratio(7.0, 0.95).value, 0.5, 0.15);
}

TEST(WindErrorFit, TakesRecordsThatAreAllInTheSameWind) {
  std::vector<ErrorInWind> records;
  for (int i = 0; i < 8; ++i) {
    records.push_back(
        {i % 2 == 1, (i % 2 == 1 ? 0.25 : 1.0) * (1.0 + 0.05 * (i / 2)), 40.0, 8.0, 0.0});
  }
  EXPECT_NEAR(WindErrorFit(records, 8.0).ratio(8.0, 0.95).value, 0.5, 1e-9);
}

// Chi-squared variances of 20 degrees of freedom, 12 records of each condition.
TEST(WindErrorFit, IntervalHoldsTheRatioAsOftenAsItSays) {
  constexpr int repetitions = 300, freedom = 20;
  int held = 0;
  for (int r = 0; r < repetitions; ++r) {
    const numerics::NormalNumbers numbers(static_cast<std::uint64_t>(r));
    std::uint64_t drawn = 0;
    std::vector<ErrorInWind> records;
    for (int i = 0; i < 24; ++i) {
      const bool after = i % 2 == 1;
      const double speed = (after ? 6.0 : 4.0) + 0.4 * (i / 2);
      double chi_squared = 0.0;
      for (int k = 0; k < freedom / 2; ++k) chi_squared += std::norm(numbers.pair(drawn++));
      records.push_back({after, variance(after, speed, 5.0, 0.0) * chi_squared / freedom, freedom,
                         speed, 0.1 * numbers.pair(drawn++).real()});
    }
    const RatioBand ratio = WindErrorFit(records, 7.0).ratio(7.0, 0.95);
    if (ratio.lower <= 0.5 && 0.5 <= ratio.upper) ++held;
  }
  EXPECT_GE(held, repetitions * 92 / 100);
  EXPECT_LE(held, repetitions * 985 / 1000);
}

TEST(WindErrorFit, RefusesFewRecordsAndImpossibleOnes) {
  auto records = exact_records(5.0, 40.0);
  EXPECT_THROW(WindErrorFit({records.begin(), records.begin() + 4}, 7.0), InvalidInput);
  EXPECT_THROW(WindErrorFit(records, 0.0), InvalidInput);
  records[3].variance = 0.0;
  EXPECT_THROW(WindErrorFit(records, 7.0), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
