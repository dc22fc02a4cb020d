/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Preloaded into a program by ProgramServer. Loading ViSP, OpenCV and the 270 libraries behind them takes a program
// longer than most tests of it. Here the program is loaded once and stops before its main(); each run is a copy of the process.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
using Main = int(int, char **, char **);
Main *s_main = nullptr;

bool receive(int socket, void *data, std::size_t size)
{
  for (char *at = static_cast<char *>(data); size > 0;) {
    const ssize_t n = read(socket, at, size);
    if (n <= 0) {
      return false;
    }
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

void redirect(const char *file, int stream)
{
  const int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (opened < 0 || dup2(opened, stream) < 0) {
    _exit(126);
  }
  close(opened);
}

// Fields: folder, files of standard output and error, seconds until the run is ended (0: never), number of arguments,
// arguments, environment.
int runOnce(std::vector<char *> fields)
{
  if (chdir(fields[0]) != 0) {
    _exit(126);
  }
  redirect(fields[1], STDOUT_FILENO);
  redirect(fields[2], STDERR_FILENO);
  alarm(static_cast<unsigned int>(std::atoi(fields[3])));
  const int count = std::atoi(fields[4]);
  std::vector<char *> arguments(fields.begin() + 5, fields.begin() + 5 + count);
  std::vector<char *> variables(fields.begin() + 5 + count, fields.end());
  arguments.push_back(nullptr);
  variables.push_back(nullptr);
  environ = variables.data();
  std::exit(s_main(count, arguments.data(), environ));
}

int serve(int, char **, char **)
{
  const int socket = std::atoi(std::getenv("VISP_DIRECT_PROGRAM_SERVER"));
  const char ready = 1;
  if (write(socket, &ready, 1) != 1) {
    _exit(1);
  }
  std::uint32_t size = 0;
  while (receive(socket, &size, sizeof(size))) {
    std::string request(size, '\0');
    if (!receive(socket, request.data(), size)) {
      break;
    }
    const pid_t child = fork();
    if (child == 0) {
      close(socket);
      std::vector<char *> fields;
      for (std::size_t at = 0; at < size; at = request.find('\0', at) + 1) {
        fields.push_back(&request[at]);
      }
      runOnce(std::move(fields));
    }
    int status = -1;
    if (child < 0 || waitpid(child, &status, 0) != child || write(socket, &status, sizeof(status)) != sizeof(status)) {
      break;
    }
  }
  _exit(0);
}
} // namespace

extern "C" __attribute__((visibility("default"))) int
__libc_start_main(Main *main, int argc, char **argv, void (*init)(), void (*fini)(), void (*loaderFini)(), void *stack)
{
  using Start = int(Main *, int, char **, void (*)(), void (*)(), void (*)(), void *);
  Start *const start = reinterpret_cast<Start *>(dlsym(RTLD_NEXT, "__libc_start_main"));
  s_main = main;
  const char *server = std::getenv("VISP_DIRECT_PROGRAM_SERVER"); // "SOCKET PROCESS"
  const char *process = server == nullptr ? nullptr : std::strchr(server, ' ');
  return start(process == nullptr || std::atol(process) != getpid() ? main : serve, argc, argv, init, fini, loaderFini,
               stack);
}
