#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "scratch_folder.hpp"

namespace boresight::app {

/// What a run of the program left behind.
struct ProgramResult {
  int exit_code = -1;  // -1 if a signal ended it
  std::string output;
  std::string errors;
};

/// The real program while it runs, without a shell between: arguments reach it as they are.
class ProgramRun {
 public:
  explicit ProgramRun(const std::vector<std::string>& arguments) {
    std::vector<std::string> words{BORESIGHT_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (auto& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    constexpr int fresh = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, folder_.file("output").c_str(), fresh,
                                     0600);
    posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, folder_.file("errors").c_str(), fresh,
                                     0600);
    const int failure =
        posix_spawn(&process_, BORESIGHT_PROGRAM, &streams, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&streams);
    if (failure != 0) throw std::runtime_error("cannot start " BORESIGHT_PROGRAM);
  }

  void signal(int number) const { kill(process_, number); }

  ProgramResult wait() const {
    int status = 0;
    waitpid(process_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(folder_.file("output")),
            content_of(folder_.file("errors"))};
  }

 private:
  ScratchFolder folder_;
  pid_t process_ = 0;
};

inline ProgramResult run_program(const std::vector<std::string>& arguments) {
  return ProgramRun(arguments).wait();
}

}  // namespace boresight::app
