#include <cmath>

#include <gtest/gtest.h>

#include <boresight/plant/nonlinear/recorder.hpp>

namespace boresight::plant {
namespace {

Recorder usual_recorder() {
  Recorder recorder;
  recorder.sample_rate = 200.0;
  recorder.pressure = {0.007, 2e4, 5.5e3, 350.0, 2e7};
  recorder.tachometer = {2.2621, 10.0, 0.003, 8e-3, 5e-3};
  return recorder;
}

TEST(Recorder, GainsAndZerosSpreadAsItsErrors) {
  const auto recorder = usual_recorder();
  const auto sensors = drawn_sensors(recorder, 2000, 1);
  ASSERT_EQ(sensors.inlet.size(), 2000U);
  ASSERT_EQ(sensors.outlet.size(), 2000U);
  double gain = 0.0, zero = 0.0, gain_squares = 0.0, zero_squares = 0.0;
  for (const auto* side : {&sensors.inlet, &sensors.outlet}) {
    for (const Sensor& sensor : *side) {
      gain += (sensor.gain - 1.0) / 4000.0;
      zero += sensor.zero / 4000.0;
      gain_squares += std::pow(sensor.gain - 1.0, 2) / 4000.0;
      zero_squares += std::pow(sensor.zero, 2) / 4000.0;
    }
  }
  // Five standard errors of 4000 normal numbers.
  EXPECT_NEAR(gain, 0.0, 5.0 * 0.007 / std::sqrt(4000.0));
  EXPECT_NEAR(zero, 0.0, 5.0 * 2e4 / std::sqrt(4000.0));
  EXPECT_NEAR(std::sqrt(gain_squares) / 0.007, 1.0, 5.0 / std::sqrt(8000.0));
  EXPECT_NEAR(std::sqrt(zero_squares) / 2e4, 1.0, 5.0 / std::sqrt(8000.0));
}

TEST(Recorder, SensorsAreTheSeeds) {
  const auto recorder = usual_recorder();
  const auto two = drawn_sensors(recorder, 2, 7);
  const auto four = drawn_sensors(recorder, 4, 7);
  for (std::size_t motor = 0; motor < 2; ++motor) {
    EXPECT_EQ(two.inlet[motor].gain, four.inlet[motor].gain);
    EXPECT_EQ(two.outlet[motor].zero, four.outlet[motor].zero);
    EXPECT_NE(two.inlet[motor].gain, two.outlet[motor].gain);
  }
  EXPECT_NE(two.inlet[0].gain, drawn_sensors(recorder, 2, 8).inlet[0].gain);
}

TEST(Recorder, TachometerIsReadInRatesWithinItsLimitEitherWay) {
  const auto recorder = usual_recorder();
  const auto sensors = drawn_sensors(recorder, 1, 1);
  EXPECT_DOUBLE_EQ(sensors.tachometer.highest, 22.621);
  EXPECT_DOUBLE_EQ(sensors.tachometer.lowest, -22.621);
  EXPECT_DOUBLE_EQ(sensors.tachometer.noise, 8e-3 * 2.2621);
  EXPECT_DOUBLE_EQ(sensors.tachometer.resolution, 5e-3 * 2.2621);
  EXPECT_EQ(sensors.tachometer.zero, 0.0);
  EXPECT_NEAR(sensors.tachometer.gain, 1.0, 5.0 * 0.003);
  EXPECT_EQ(sensors.inlet[0].lowest, 0.0);
  EXPECT_EQ(sensors.inlet[0].highest, 2e7);
}

TEST(Recorder, WithoutErrorsReadsWhatIsThere) {
  Recorder recorder;
  recorder.tachometer = {2.0, 10.0};
  const auto sensors = drawn_sensors(recorder, 1, 3);
  EXPECT_EQ(reading(sensors.inlet[0], 7.1e6, 1.0), 7.1e6);
  EXPECT_EQ(reading(sensors.tachometer, 3.0, 1.0), 3.0);
  EXPECT_EQ(reading(sensors.tachometer, 30.0, 1.0), 20.0);
}

}  // namespace
}  // namespace boresight::plant
