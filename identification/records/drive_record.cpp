#include <boresight/identification/records/drive_record.hpp>

namespace boresight::identification {

double torque_per_pressure(const DriveKnowledge& knowledge) {
  return knowledge.torque_efficiency.value * knowledge.displacement.value;
}

Eigen::VectorXd recorded_torque(const DriveRecord& record, const DriveKnowledge& knowledge) {
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(record.samples());
  for (const auto& inlet : record.inlet_pressure) difference += inlet.values;
  for (const auto& outlet : record.outlet_pressure) difference -= outlet.values;
  return torque_per_pressure(knowledge) * difference;
}

}  // namespace boresight::identification
