// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm>

namespace parallax {

/// On a payload whose bytes mean nothing: a target may leave out moving them. One that does not know this
/// moves them, and all is the same but slower. One object serves any number of payloads.
class TrafficOnly final : public ::tlm::tlm_extension<TrafficOnly> {
 public:
  ::tlm::tlm_extension_base* clone() const override { return const_cast<TrafficOnly*>(this); }
  void copy_from(const ::tlm::tlm_extension_base&) override {}
  void free() override {}  // it belongs to whoever set it
};

}  // namespace parallax
