#include <boresight/numerics/vector_clones.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::plant {

ResponsePoint point(const PlantResponse& response, Eigen::Index i) {
  return {response.tachometer_command[i], response.torque_command[i],  response.encoder_command[i],
          response.boresight_command[i],  response.tachometer_wind[i], response.torque_wind[i],
          response.encoder_wind[i],       response.boresight_wind[i]};
}

void set_point(PlantResponse& response, Eigen::Index i, const ResponsePoint& point) {
  response.tachometer_command[i] = point.tachometer_command;
  response.torque_command[i] = point.torque_command;
  response.encoder_command[i] = point.encoder_command;
  response.boresight_command[i] = point.boresight_command;
  response.tachometer_wind[i] = point.tachometer_wind;
  response.torque_wind[i] = point.torque_wind;
  response.encoder_wind[i] = point.encoder_wind;
  response.boresight_wind[i] = point.boresight_wind;
}

PlantResponse unset_response(const Eigen::ArrayXd& frequency) {
  PlantResponse response;
  response.frequency = frequency;
  for (auto* channel :
       {&response.tachometer_command, &response.torque_command, &response.encoder_command,
        &response.boresight_command, &response.tachometer_wind, &response.torque_wind,
        &response.encoder_wind, &response.boresight_wind}) {
    channel->resize(frequency.size());
  }
  return response;
}

PointResponse::PointResponse(const AntennaPlant& plant)
    : drive_(plant.drive),
      structure_(plant.structure),
      modes_(numerics::pack_count(plant.structure.modes.size())) {
  structure_.modes.clear();
  for (std::size_t i = 0; i < modes_.size() * numerics::pack_size; ++i) {
    // Modes that fill the last pack up have no mass and no response.
    const bool there = i < plant.structure.modes.size();
    const StructuralMode mode =
        there ? plant.structure.modes[i] : StructuralMode{0.0, 1.0, 0.0, 0.0, 0.0};
    ModePack& pack = modes_[i / numerics::pack_size];
    pack.inertia.set(i % numerics::pack_size, mode.inertia);
    pack.stiffness.set(i % numerics::pack_size, mode.stiffness);
    pack.damping.set(i % numerics::pack_size, mode.damping);
    pack.wind_fraction.set(i % numerics::pack_size, mode.wind_fraction);
    pack.beam_weight.set(i % numerics::pack_size, mode.beam_weight);
  }
}

// What the modes of each lane add up to.
struct PointResponse::ModeSum {
  numerics::ComplexPack inertial, wind, boresight, bending;

  template <std::size_t width>
  [[gnu::always_inline]] static inline void run(const std::vector<ModePack>& modes, const double& w,
                                                ModeSum& sum) {
    using RealPart = numerics::RealLanes<width>;
    using ComplexPart = numerics::ComplexLanes<width>;
    using numerics::part;
    for (std::size_t k = 0; k < numerics::pack_size / width; ++k) {
      ComplexPart inertial{}, wind{}, boresight{}, bending{};
      for (const ModePack& mode : modes) {
        const RealPart stiffness = part<width>(mode.stiffness, k);
        const RealPart wind_fraction = part<width>(mode.wind_fraction, k);
        const RealPart beam_weight = part<width>(mode.beam_weight, k);
        const RealPart damping = part<width>(mode.damping, k) * w;
        const RealPart inertia = part<width>(mode.inertia, k) * (w * w);
        const RealPart real = stiffness - inertia;
        const RealPart scale = 1.0 / (real * real + damping * damping);
        const ComplexPart inverse{real * scale, -damping * scale};
        const ComplexPart follow = ComplexPart{stiffness, damping} * inverse;
        inertial = inertial - follow * inertia;
        wind = wind + follow * wind_fraction;
        boresight = boresight + follow * beam_weight;
        bending = bending + inverse * (wind_fraction * beam_weight);
      }
      numerics::set_part(sum.inertial, k, inertial);
      numerics::set_part(sum.wind, k, wind);
      numerics::set_part(sum.boresight, k, boresight);
      numerics::set_part(sum.bending, k, bending);
    }
  }
};

ResponsePoint PointResponse::operator()(double frequency) const {
  const double w = frequency;
  ModeSum sum;
  numerics::run_on_widest_lanes<ModeSum>(modes_, w, sum);
  const auto total = [](const numerics::ComplexPack& x) {
    return std::complex<double>(numerics::sum(x.re), numerics::sum(x.im));
  };
  return drive_on_structure(drive_,
                            {total(sum.inertial) - structure_.bull_gear_inertia * w * w,
                             {structure_.gear_stiffness, structure_.gear_damping * w},
                             total(sum.wind) + structure_.bull_gear_wind_fraction,
                             total(sum.boresight) + structure_.bull_gear_beam_weight,
                             total(sum.bending)},
                            w);
}

}  // namespace boresight::plant
