// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <systemc>

#include "platform/commands/cli.hpp"
#include "platform/commands/report_handler.hpp"

namespace {

// Whoever starts the program may have closed these: the next file that is opened would be one of them, and
// take what is meant for a terminal.
void open_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest number that is free, which is this one; the wrong way round, so that who uses it is told as
    // if it were closed.
    ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace

int sc_main(int argc, char** argv) {
  parallax::handle_reports();
  return parallax::run_command_line(argc, argv);
}

int main(int argc, char** argv) {
  open_standard_descriptors();
  // Standard error belongs to our messages. SystemC's own main() would print its notice there first; only the
  // environment can switch it off, and this is the last place before it is printed.
  ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 0);
  return sc_core::sc_elab_and_sim(argc, argv);
}
