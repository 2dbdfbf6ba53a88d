#include <boresight/app/commands/command_line.hpp>

int main(int argc, char** argv) {
  return boresight::app::run_command_line(argc, argv);
}
