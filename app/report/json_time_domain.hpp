#pragma once

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/simulate/time_domain.hpp>

namespace boresight::app {

/// "time_domain" of docs/report.schema.json.
nlohmann::ordered_json time_domain_json(const TimeDomainSection& section);

}  // namespace boresight::app
