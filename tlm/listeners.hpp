// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

namespace parallax {

/// The listeners of one part: any number, notified in the order in which they were added. Without any it is a
/// null pointer, so that a token without a listener costs one test.
template <class Listener>
class Listeners {
 public:
  /// `listener` must outlive the simulation or be removed before; neither may happen while a listener is
  /// being notified. Throws std::logic_error for one that listens already.
  void add(Listener& listener) {
    if (find(listener) != size()) throw std::logic_error("a listener is added twice");
    if (!list_) list_ = std::make_unique<std::vector<Listener*>>();
    list_->push_back(&listener);
  }
  /// Throws std::logic_error for one that does not listen.
  void remove(Listener& listener) {
    const std::size_t at = find(listener);
    if (at == size()) throw std::logic_error("a listener is removed that does not listen");
    if (size() == 1) {
      list_.reset();
    } else {
      list_->erase(list_->begin() + at);
    }
  }

  bool any() const { return list_ != nullptr; }
  std::size_t size() const { return list_ ? list_->size() : 0; }
  Listener* const* begin() const { return list_ ? list_->data() : nullptr; }
  Listener* const* end() const { return begin() + size(); }

 private:
  std::size_t find(const Listener& listener) const { return std::find(begin(), end(), &listener) - begin(); }

  std::unique_ptr<std::vector<Listener*>> list_;
};

}  // namespace parallax
