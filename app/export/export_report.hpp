#pragma once

#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/design/studies/export_study.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/io/code/computer_signals.hpp>
#include <boresight/io/code/exported_files.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::app {

/// What an export wrote, and what its reader loads and checks.
struct ExportReport {
  std::string case_path, title;
  io::PointingAxis axis;
  std::string structure;  // as the user names it
  std::string source;     // of the controller
  std::string folder;
  std::vector<std::string> files;  // within the folder
  std::string prefix;
  bool with_vectors = false, with_c = false;
  std::vector<io::SignalDescription> signals;
  design::ExportedController exported;
  std::vector<io::Quantity> assumed;
  std::string json;  // as in PREFIX_controller.json
};

Document document_of(const ExportReport& report);

}  // namespace boresight::app
