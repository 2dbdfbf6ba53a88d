#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/commissioning/commissioning_records.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::design {
namespace {

// Noise of one pole: x[k+1] = memory x[k] + noise, deviation `rms` throughout.
RecordedChannel noise(Eigen::Index samples, double memory, double rms, std::uint64_t seed,
                      double sample_time = 0.01) {
  const numerics::NormalNumbers numbers(seed);
  RecordedChannel channel{Eigen::VectorXd(samples), {}, sample_time};
  double x = 0.0;
  for (Eigen::Index k = -500; k < samples; ++k) {
    const double next = numbers.pair(static_cast<std::uint64_t>(k + 500)).real();
    x = memory * x + std::sqrt(1.0 - memory * memory) * next;
    if (k >= 0) channel.values[k] = rms * x;
  }
  return channel;
}

TEST(CompareRecords, HoldsTheTrueRatioAsOftenAsItSays) {
  for (const double memory : {0.0, 0.9}) {
    int whole = 0, bands = 0, all = 0;
    constexpr int repetitions = 300;
    for (std::uint64_t seed = 1; seed <= repetitions; ++seed) {
      const auto found = compare_records(noise(4000, memory, 2.0, 2 * seed),
                                         noise(3000, memory, 1.0, 2 * seed + 1));
      whole += found.whole.lower <= 0.5 && 0.5 <= found.whole.upper;
      for (const auto& band : found.bands) {
        bands += band.lower <= 0.5 && 0.5 <= band.upper;
        ++all;
      }
    }
    EXPECT_NEAR(static_cast<double>(whole) / repetitions, 0.95, 0.035) << memory;
    EXPECT_NEAR(static_cast<double>(bands) / all, 0.95, 0.03) << memory;
  }
}

TEST(CompareRecords, CountsIndependentSamplesNotSamples) {
  const auto white = compare_records(noise(8000, 0.0, 1.0, 1), noise(8000, 0.0, 1.0, 2));
  // Of 8000 white samples nearly all are worth something: Welch's halves overlap.
  EXPECT_GT(white.whole.freedom_before, 4000.0);
  EXPECT_LT(white.whole.freedom_before, 8000.0);
  EXPECT_NEAR(white.whole.rms_before, 1.0, 0.05);
  // One pole of memory m: (1 - m^2)/(1 + m^2) of them.
  const auto slow = compare_records(noise(8000, 0.8, 1.0, 1), noise(8000, 0.8, 1.0, 2));
  const double fraction = (1.0 - 0.64) / (1.0 + 0.64);
  EXPECT_NEAR(slow.whole.freedom_before / white.whole.freedom_before, fraction, 0.25 * fraction);
}

TEST(CompareRecords, FindsTheBandThatChanged) {
  // A sine of 5 Hz in the noise before, not after.
  auto before = noise(8000, 0.0, 0.1, 5);
  const auto after = noise(8000, 0.0, 0.1, 6);
  for (Eigen::Index k = 0; k < before.values.size(); ++k) {
    before.values[k] +=
        0.3 * std::sin(2.0 * std::numbers::pi * 5.0 * 0.01 * static_cast<double>(k));
  }
  const auto found = compare_records(before, after, {.edges = {0.5, 4.0, 6.0, 40.0}});
  ASSERT_EQ(found.bands.size(), 3u);
  EXPECT_EQ(found.bands[0].change, Change::none);
  EXPECT_EQ(found.bands[1].change, Change::better);
  EXPECT_EQ(found.bands[2].change, Change::none);
  EXPECT_NEAR(found.bands[1].rms_before, 0.3 / std::sqrt(2.0), 0.02);
  EXPECT_EQ(to_string(found.bands[1].change), "better");
  EXPECT_EQ(found.frequency.size(), found.density_after.size());
  const auto swapped = compare_records(after, before, {.edges = {0.5, 4.0, 6.0, 40.0}});
  EXPECT_EQ(swapped.bands[1].change, Change::worse);
  EXPECT_NEAR(swapped.bands[1].lower * found.bands[1].upper, 1.0, 1e-9);
}

TEST(CompareRecords, TakesRecordsOfDifferentRates) {
  const auto found =
      compare_records(noise(8000, 0.0, 1.0, 3, 0.01), noise(4000, 0.0, 1.0, 4, 0.02));
  // White to 50 Hz and to 25 Hz: below 25 Hz the slower one holds twice the power.
  EXPECT_NEAR(found.whole.highest, 25.0, 1e-9);
  EXPECT_NEAR(found.whole.ratio, std::sqrt(2.0), 0.08);
  EXPECT_EQ(found.whole.change, Change::worse);
}

TEST(CompareRecords, LeavesOutWhatIsNotValid) {
  auto before = noise(8000, 0.0, 1.0, 7);
  auto clipped = before;
  clipped.valid.assign(8000, true);
  for (std::size_t k = 3000; k < 3100; ++k) {
    clipped.valid[k] = false;
    clipped.values[static_cast<Eigen::Index>(k)] = 100.0;
  }
  const auto other = noise(8000, 0.0, 1.0, 8);
  EXPECT_NEAR(compare_records(clipped, other).whole.ratio,
              compare_records(before, other).whole.ratio, 0.05);
}

TEST(CompareRecords, SaysWhatIsWrong) {
  using testing::HasSubstr;
  const auto fine = noise(200, 0.0, 1.0, 1);
  const auto refusal = [](const RecordedChannel& before, const RecordedChannel& after,
                          const RecordComparisonOptions& options = {}) -> std::string {
    try {
      compare_records(before, after, options);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(refusal(noise(10, 0.0, 1.0, 1), fine),
              HasSubstr("found 10 at 0.01 s in the record before"));
  EXPECT_THAT(refusal(fine, noise(200, 0.0, 1.0, 1, 0.0)), HasSubstr("at 0 s in the record after"));
  auto bad = fine;
  bad.values[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(fine, bad), HasSubstr("not in the record after"));
  EXPECT_THAT(refusal(fine, fine, {.confidence = 2.0}), HasSubstr("within (0, 1), found 2"));
  EXPECT_THAT(refusal(fine, fine, {.edges = {3.0}}),
              HasSubstr("two rising edges of bands, found 1"));
  EXPECT_THAT(refusal(fine, fine, {.edges = {3.0, 1.0}}), HasSubstr("two rising edges"));
  EXPECT_THAT(refusal(fine, fine, {.edges = {60.0, 70.0}}),
              HasSubstr("found none from 60 to 70 Hz"));
  RecordedChannel calm{Eigen::VectorXd::Zero(200), {}, 0.01};
  EXPECT_THAT(refusal(fine, calm), HasSubstr("records that move, found nothing from"));
}

}  // namespace
}  // namespace boresight::design
