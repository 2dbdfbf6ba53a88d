#include <nlohmann/json.hpp>

#include <boresight/app/io/state_space_formats.hpp>
#include <boresight/app/report/json_linear_models.hpp>

namespace boresight::app {

nlohmann::ordered_json linear_models_json(const LinearModels& models) {
  nlohmann::ordered_json json{{"gear_ratio_1", models.gear_ratio},
                              {"plant", state_space_json(models.plant)}};
  if (models.loop) {
    json["law"] = models.loop->description;
    json["dead_time_s"] = models.loop->dead_time;
    json["controller"] = state_space_json(models.loop->controller);
    json["sampled_controller"] = state_space_json(models.loop->sampled_controller);
  }
  return json;
}

}  // namespace boresight::app
