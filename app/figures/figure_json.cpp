#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/report/json_writer.hpp>

namespace boresight::app {

nlohmann::ordered_json figures_json(const std::vector<Figure>& figures) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& figure : figures) json.push_back(json_of(figure));
  return json;
}

}  // namespace boresight::app
