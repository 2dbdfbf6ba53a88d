#include <nlohmann/json.hpp>

#include <boresight/app/report/json_linear_models.hpp>
#include <boresight/io/exchange/state_space_formats.hpp>

namespace boresight::app {

nlohmann::ordered_json linear_models_json(const LinearModels& models) {
  nlohmann::ordered_json json{{"gear_ratio_1", models.gear_ratio},
                              {"plant", io::state_space_json(models.plant)}};
  if (models.loop) {
    json["law"] = models.loop->description;
    json["dead_time_s"] = models.loop->dead_time;
    json["controller"] = io::state_space_json(models.loop->controller);
    json["sampled_controller"] = io::state_space_json(models.loop->sampled_controller);
  }
  return json;
}

}  // namespace boresight::app
