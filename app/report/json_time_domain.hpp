#pragma once

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/simulate/time_domain.hpp>

namespace boresight::app {

/// "time_domain" of docs/report.schema.json.
nlohmann::ordered_json time_domain_json(const TimeDomainSection& section);
/// One of many laws compared in the time domain, influences not told apart.
nlohmann::ordered_json compared_run_json(const design::NonlinearVerification& run);

}  // namespace boresight::app
