// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <systemc>

#include "platform/cli.hpp"

int sc_main(int argc, char** argv) { return parallax::run_command_line(argc, argv); }

int main(int argc, char** argv) {
  // Standard error belongs to our messages. SystemC's own main() would print its notice there first; only the
  // environment can switch it off, and this is the last place before it is printed.
  ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 0);
  return sc_core::sc_elab_and_sim(argc, argv);
}
