// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

namespace parallax {

class Leap;
class Stage;
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
  Leap* held_by_ = nullptr;
  bool held_idle_ = false;
};

/// One wait of a deadlock: who waits on which stream, for what, and who would have to act.
struct Wait {
  std::string waiter;
  const StreamBase* stream;
  bool on_full;  ///< true: the stream has no free slot; false: it is empty
  std::string other;
};

/// Runs the actors of one simulation ahead of kernel time: an actor moves as soon as a date that it waits for
/// is known, whatever the kernel's clock says. Blocks that live in kernel time (threads that wait) meet the
/// actors at the streams, and never notice: every date that they can see is in their present or future.
class Dataflow final : public sc_core::sc_module {
 public:
  /// Firings between two looks for periodic motion (leap.hpp): often enough to miss little, seldom enough to
  /// cost little.
  static constexpr std::uint64_t kLeapInterval = 150;

  /// `leap_interval`: 0 for neither leaps nor batches: every firing is gone through one by one. One larger
  /// than the firings of a run: batches alone.
  explicit Dataflow(const sc_core::sc_module_name& name, std::uint64_t leap_interval = kLeapInterval);
  ~Dataflow() override;

  /// Queues an actor; it advances before kernel time does.
  void wake(Actor& actor);
  /// Queues an action that runs in the engine, outside the caller's stack, before any actor that is woken
  /// later.
  void post(std::function<void()> action);

  void add(StreamBase& stream) { streams_.push_back(&stream); }
  void add(Stage& stage) { stages_.push_back(&stage); }
  void count_firings(std::uint64_t count) { firings_ += count; }
  /// Brings what stages and streams say of themselves up to what is known.
  void bring_up_to_date() const;
  const std::vector<StreamBase*>& streams() const { return streams_; }
  const std::vector<Stage*>& stages() const { return stages_; }
  /// Whether stages may go through all firings at hand at once (stage_batch.cpp).
  bool batches() const { return leap_interval_ != 0; }
  /// Firings that leaps have gone over, of those that statistics count.
  std::uint64_t leaped_firings() const;

  /// The closed chain of waits when the simulation has run dry, else empty. Each wait's `other` is the next
  /// one's `waiter`. A chain that ends at a module that does not wait is no deadlock and is not returned.
  std::vector<Wait> deadlock() const;
  /// Everyone who waits on a stream now.
  std::vector<Wait> waits() const;

 private:
  friend class Leap;
  void start_of_simulation() override;
  void run();
  bool step();
  void drain();  // actions and actors until none can move
  bool attempt_leaps();
  bool may_look(bool soon) const;
  void look_anew() { firings_ = failures_ = 0; }
  void hold(Actor& actor, Leap* leap, bool active);
  void release(Actor& actor);

  std::deque<Actor*> ready_;
  std::deque<std::function<void()>> actions_;
  std::vector<StreamBase*> streams_;
  std::vector<Stage*> stages_;
  std::vector<std::unique_ptr<Leap>> leaps_;  // one for each clock
  const std::uint64_t leap_interval_;
  std::uint64_t firings_ = 0;  // since the last attempt
  unsigned failures_ = 0;      // attempts in a row that found nothing
  sc_core::sc_event work_;
  sc_core::sc_event due_;  // what a leap has not computed yet is about to come
  bool notified_ = true;   // a run is coming or under way; the first comes by itself at time 0
};

/// The deadlock as text, one line a wait.
std::string describe(const std::vector<Wait>& cycle);

}  // namespace parallax
