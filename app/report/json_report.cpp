#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/report_description.hpp>

namespace boresight::app {

std::string to_json(const Report& report) {
  return json_of(report).dump(2) + "\n";
}

}  // namespace boresight::app
