// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <systemc>
#include <vector>

namespace parallax {

class StreamBase;

/// Something that turns known dates into further dates and returns when it needs one that is not known yet.
class Actor {
 public:
  virtual ~Actor() = default;
  /// Goes as far as the known dates allow. Called again after a date it waited for has become known.
  virtual void advance() = 0;

 private:
  friend class Dataflow;
  bool queued_ = false;
};

/// One wait of a deadlock: who waits on which stream, for what, and who would have to act.
struct Wait {
  std::string waiter;
  const StreamBase* stream;
  bool on_full;  ///< true: the stream has no free place; false: it is empty
  std::string other;
};

/// Runs the actors of one simulation ahead of kernel time: an actor moves as soon as a date that it waits for
/// is known, whatever the kernel's clock says. Blocks that live in kernel time (threads that wait) meet the
/// actors at the streams, and never notice: every date that they can see is in their present or future.
class Dataflow final : public sc_core::sc_module {
 public:
  explicit Dataflow(const sc_core::sc_module_name& name);

  /// Queues an actor; it advances before kernel time does.
  void wake(Actor& actor);
  /// Queues an action that runs in the engine, outside the caller's stack, before any actor that is woken
  /// later.
  void post(std::function<void()> action);

  void add(StreamBase& stream) { streams_.push_back(&stream); }
  const std::vector<StreamBase*>& streams() const { return streams_; }

  /// The closed chain of waits when the simulation has run dry, else empty. Each wait's `other` is the next
  /// one's `waiter`. A chain that ends at somebody who does not wait is no deadlock and is not returned.
  std::vector<Wait> deadlock() const;
  /// Everyone who waits on a stream now.
  std::vector<Wait> waits() const;

 private:
  void run();

  std::deque<Actor*> ready_;
  std::deque<std::function<void()>> actions_;
  std::vector<StreamBase*> streams_;
  sc_core::sc_event work_;
  bool notified_ = true;  // a run is coming or under way; the first comes by itself at time 0
};

/// The deadlock as text, one line a wait.
std::string describe(const std::vector<Wait>& cycle);

}  // namespace parallax
