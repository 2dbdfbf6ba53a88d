#include <boresight/app/report/json_design.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/io/description/design_results.hpp>

namespace boresight::app {

Json mode_json(const plant::PlantMode& mode) {
  return json_of(mode);
}

Json design_json(const design::Design& design) {
  return json_of(design);
}

Json ensemble_json(const design::EnsembleResult& ensemble) {
  return json_of(ensemble);
}

}  // namespace boresight::app
