/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file programServer.h
 * \brief A program that is loaded once and runs many times.
 */
#ifndef vpApp_test_programServer_h
#define vpApp_test_programServer_h

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

//! \brief A program that is loaded once and runs many times; see programServer.cpp.
class ProgramServer
{
public:
  //! \brief One run. A time limit of 0 s is none.
  struct Request {
    std::string folder, out, err;
    unsigned int seconds = 0;
    std::vector<std::string> arguments, environment;
  };

  explicit ProgramServer(const std::string &program)
  {
#ifdef VISP_DIRECT_PROGRAM_SERVER
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      return;
    }
    const pid_t child = fork();
    if (child == 0) {
      const int end = dup(ends[1]); // without SOCK_CLOEXEC
      setenv("LD_PRELOAD", VISP_DIRECT_PROGRAM_SERVER, 1);
      // With the process, for what a library starts before main() is another one (a shell, on Debian 13).
      setenv("VISP_DIRECT_PROGRAM_SERVER", (std::to_string(end) + " " + std::to_string(getpid())).c_str(), 1);
      execl(program.c_str(), program.c_str(), static_cast<char *>(nullptr));
      _exit(127);
    }
    close(ends[1]);
    m_socket = ends[0];
    char ready = 0;
    if (child < 0 || read(m_socket, &ready, 1) != 1) {
      close(std::exchange(m_socket, -1));
    }
    m_process = child;
#else
    static_cast<void>(program);
#endif
  }
  ~ProgramServer()
  {
    if (m_socket >= 0) {
      close(m_socket); // which ends it
    }
    if (m_process > 0) {
      waitpid(m_process, nullptr, 0);
    }
  }
  ProgramServer(const ProgramServer &) = delete;
  ProgramServer &operator=(const ProgramServer &) = delete;

  //! The status as of waitpid(); none when there is no server.
  std::optional<int> run(const Request &request)
  {
    if (m_socket < 0) {
      return std::nullopt;
    }
    std::string text;
    const auto add = [&text](const std::string &field) { text.append(field.c_str(), field.size() + 1); };
    for (const std::string &field : {request.folder, request.out, request.err, std::to_string(request.seconds),
                                     std::to_string(request.arguments.size())}) {
      add(field);
    }
    std::for_each(request.arguments.begin(), request.arguments.end(), add);
    std::for_each(request.environment.begin(), request.environment.end(), add);
    const std::uint32_t size = static_cast<std::uint32_t>(text.size());
    text.insert(0, reinterpret_cast<const char *>(&size), sizeof(size));
    int status = 0;
    if (send(m_socket, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size()) ||
        recv(m_socket, &status, sizeof(status), MSG_WAITALL) != sizeof(status)) {
      return std::nullopt;
    }
    return status;
  }

  //! The server of a program, for all tests of this process.
  static ProgramServer &of(const std::string &program)
  {
    static std::map<std::string, std::unique_ptr<ProgramServer>> all;
    std::unique_ptr<ProgramServer> &server = all[program];
    if (!server) {
      server = std::make_unique<ProgramServer>(program);
    }
    return *server;
  }

private:
  int m_socket = -1;
  pid_t m_process = -1;
};

#endif
