#include <nlohmann/json.hpp>

#include <boresight/app/report/json_assumed.hpp>

namespace boresight::app {

nlohmann::ordered_json assumed_json(const std::vector<io::Quantity>& assumed) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& quantity : assumed) {
    const bool value = quantity.basis == io::Basis::assumed;
    json.push_back({{"key", quantity.key},
                    {"value", quantity.text},
                    {"assumed", value ? "value" : "uncertainty"},
                    {"source", value ? quantity.source : quantity.uncertainty_source}});
  }
  return json;
}

}  // namespace boresight::app
