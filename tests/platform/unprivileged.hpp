// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <stdexcept>

namespace parallax {

/// While it lives, the test is not root, to whom no permission is denied. Nothing happens to other users.
class Unprivileged {
 public:
  Unprivileged() {
    if (user_ == 0 && ::seteuid(kNobody) != 0) throw std::runtime_error("cannot become another user");
  }
  ~Unprivileged() { static_cast<void>(::seteuid(user_) == 0); }
  Unprivileged(const Unprivileged&) = delete;
  Unprivileged& operator=(const Unprivileged&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  uid_t user_ = ::geteuid();
};

}  // namespace parallax
