// SPDX-License-Identifier: Apache-2.0
#include <systemc>

#include "tlm/error.hpp"

int sc_main(int, char**) {
  try {
    throw parallax::UserError("a consumer links");
  } catch (const parallax::UserError&) {
    return 0;
  }
}
