#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/nonlinear/recorder.hpp>

namespace boresight::plant {

RecorderSensors drawn_sensors(const Recorder& recorder, std::size_t motors, std::uint64_t seed) {
  const numerics::NormalNumbers numbers(seed, 1000);
  std::uint64_t drawn = 0;
  const PressureRecording& ports = recorder.pressure;
  const auto pressure = [&] {
    const auto pair = numbers.pair(drawn++);
    return Sensor{1.0 + ports.gain_error * pair.real(),
                  ports.zero_error * pair.imag(),
                  ports.noise,
                  ports.resolution,
                  0.0,
                  ports.range};
  };
  RecorderSensors sensors;
  for (std::size_t motor = 0; motor < motors; ++motor) {
    sensors.inlet.push_back(pressure());
    sensors.outlet.push_back(pressure());
  }
  const TachometerRecording& tachometer = recorder.tachometer;
  sensors.tachometer = {1.0 + tachometer.gain_error * numbers.pair(drawn).real(),
                        0.0,
                        tachometer.noise * tachometer.scale,
                        tachometer.resolution * tachometer.scale,
                        -tachometer.limit * tachometer.scale,
                        tachometer.limit * tachometer.scale};
  return sensors;
}

}  // namespace boresight::plant
