// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/report_handler.hpp"

#include <iostream>
#include <systemc>

namespace parallax {
namespace {

// Standard output belongs to results: the kernel's own handler would print warnings there. What it would
// abort for is thrown like other faults, so that the program ends with one line.
void handle_report(const sc_core::sc_report& report, const sc_core::sc_actions& actions) {
  if ((actions & sc_core::SC_DISPLAY) != 0) {
    std::cerr << "parallax: warning: " << report.get_msg_type() << ": " << report.get_msg() << std::endl;
  }
  if ((actions & (sc_core::SC_THROW | sc_core::SC_ABORT)) != 0) throw report;
}

}  // namespace

void handle_reports() {
  sc_core::sc_report_handler::set_handler(handle_report);
  sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  sc_core::sc_report_handler::set_actions(sc_core::SC_FATAL, sc_core::SC_THROW);
}

}  // namespace parallax
