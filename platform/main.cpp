// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <iostream>
#include <systemc>

#include "platform/commands/cli.hpp"

namespace {

// Standard output belongs to results: the kernel's own handler would print warnings there. What it would
// abort for is thrown like other faults, so that the program ends with one line.
void handle_report(const sc_core::sc_report& report, const sc_core::sc_actions& actions) {
  if ((actions & sc_core::SC_DISPLAY) != 0) {
    std::cerr << "parallax: warning: " << report.get_msg_type() << ": " << report.get_msg() << std::endl;
  }
  if ((actions & (sc_core::SC_THROW | sc_core::SC_ABORT)) != 0) throw report;
}

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
  sc_core::sc_report_handler::set_handler(handle_report);
  sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  sc_core::sc_report_handler::set_actions(sc_core::SC_FATAL, sc_core::SC_THROW);
  return parallax::run_command_line(argc, argv);
}

int main(int argc, char** argv) {
  open_standard_descriptors();
  // Standard error belongs to our messages. SystemC's own main() would print its notice there first; only the
  // environment can switch it off, and this is the last place before it is printed.
  ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 0);
  return sc_core::sc_elab_and_sim(argc, argv);
}
