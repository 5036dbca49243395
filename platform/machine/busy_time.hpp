// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

namespace parallax {

/// Sums the time in which something is so.
class BusyTime {
 public:
  /// It is so, or is not, from now on.
  void set(bool busy) {
    sum_ = until_now();
    since_ = sc_core::sc_time_stamp();
    busy_ = busy;
  }
  sc_core::sc_time until_now() const { return busy_ ? sum_ + (sc_core::sc_time_stamp() - since_) : sum_; }

 private:
  bool busy_ = false;
  sc_core::sc_time sum_;    // until
  sc_core::sc_time since_;  // this date
};

}  // namespace parallax
