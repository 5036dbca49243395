// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <systemc>
#include <utility>
#include <vector>

#include "tlm/listeners.hpp"
#include "tlm/row_collector.hpp"
#include "tlm/stream_base.hpp"
#include "tlm/token_bits.hpp"

namespace parallax {

/// Notified of the values of a stream, in the order of its tokens, as the writer hands them over: in rows,
/// and ahead of their dates. A Tap has both together.
template <class T>
class RowListener {
 public:
  virtual ~RowListener() = default;
  virtual void row(const StreamBase& stream, const T* values, std::size_t size) = 0;
};

/// A stream with values. Dates and values travel apart: dates token by token (StreamBase), values row by row
/// and ahead of their dates, since no value in this machine depends on time. A reader that works on rows
/// takes each as it is sent; for a reader in kernel time the values wait until it reads them.
///
/// A token is one value, or several where its writer and reader have agreed so (a group of matching costs):
/// the stream's values are those of its tokens one after the other.
template <class T>
class Stream final : public StreamBase {
 public:
  using Row = std::function<void(const T* row, std::size_t length)>;

  /// Throws UserError as StreamBase does, and for a width that is less than kLeastBits<T>.
  Stream(const char* name, Dataflow& dataflow, const ClockDomain& writer_clock,
         const ClockDomain& reader_clock, const FifoConfig& config)
      : StreamBase(name, dataflow, writer_clock, reader_clock, config) {
    require_width(Bits(kLeastBits<T>));
  }

  /// The reader takes rows of `length` values, which are collected where the writer delivers them piece by
  /// piece; with length 0 it takes them as they are sent.
  void on_row(std::size_t length, Row take) {
    collected_ = RowCollector<T>(length);
    take_ = std::move(take);
  }
  /// Notifies `listener` of all values from here on, before the reader gets them (Listeners::add). Dates may
  /// lag behind, so the first of these values need not be of the next token: to meet values with their
  /// tokens, listen from before the simulation starts.
  void add_row_listener(RowListener<T>& listener) { row_listeners_.add(listener); }
  void remove_row_listener(RowListener<T>& listener) { row_listeners_.remove(listener); }

  /// The writer hands over the next `length` values: a row, a burst, an image; rows for the reader are made
  /// by on_row().
  void send_row(const T* row, std::size_t length) {
    for (RowListener<T>* listener : row_listeners_) listener->row(*this, row, length);
    if (take_) {
      collected_.push(row, length, take_);
    } else {
      values_.insert(values_.end(), row, row + length);
    }
  }

  /// For threads in kernel time: reads one token in the first cycle in which that is possible. The value must
  /// have been sent by then, which every writer in this library does before the token's date, as long as the
  /// values of a row enter the actors with the row's first token: where they enter one by one, an actor works
  /// on them when the row is complete. SC_REPORT_ERROR /parallax/stream/value when it has not been sent.
  T read() {
    wait_readable();
    release();
    return pop();
  }
  /// Reads one token in `cycle`, in which can_read(cycle) is true, having waited for it for `starved` cycles.
  T read(Cycles cycle, Cycles starved) {
    mark_read(cycle, starved);
    return pop();
  }

  /// The value that read() would return, which leaves it there. Needs can_read(), and what read() needs.
  const T& peek() const {
    require_value();
    return values_.front();
  }

  /// For threads in kernel time: writes one token in the first cycle in which that is possible.
  void write(const T& value) {
    wait_writable();
    send_row(&value, 1);
    commit();
  }
  /// Writes one token in `cycle`, in which can_write(cycle) is true, having waited for room for `blocked`
  /// cycles.
  void write(const T& value, Cycles cycle, Cycles blocked) {
    send_row(&value, 1);
    mark_written(cycle, blocked);
  }

 private:
  void require_value() const {
    if (values_.empty()) SC_REPORT_ERROR("/parallax/stream/value", name());
  }
  T pop() {
    require_value();
    T value = values_.front();
    values_.pop_front();
    return value;
  }

  RowCollector<T> collected_;
  Row take_;
  std::deque<T> values_;  // for a reader in kernel time
  Listeners<RowListener<T>> row_listeners_;
};

/// What a stage needs of a port whatever its token type.
class StreamPort {
 public:
  virtual ~StreamPort() = default;
  virtual bool is_input() const = 0;
  virtual std::vector<StreamBase*> streams() = 0;
};

/// Input port of a stage: reads one stream. What it has of Stream is for blocks in kernel time, threads and
/// methods; only a thread may call what waits.
template <class T>
class StreamIn final : public sc_core::sc_port<Stream<T>, 1>, public StreamPort {
 public:
  using sc_core::sc_port<Stream<T>, 1>::sc_port;

  bool is_input() const override { return true; }
  std::vector<StreamBase*> streams() override { return {(*this)[0]}; }
  /// Stream::on_row of whatever stream gets bound; to be called before the simulation starts.
  void on_row(std::size_t length, typename Stream<T>::Row take) {
    row_length_ = length;
    take_ = std::move(take);
  }

  bool can_read() const { return stream().can_read(); }
  bool can_read(Cycles cycle) const { return stream().can_read(cycle); }
  const T& peek() const { return stream().peek(); }
  T read() { return stream().read(); }
  T read(Cycles cycle, Cycles starved) { return stream().read(cycle, starved); }
  /// What is bound, from the end of elaboration on.
  Stream<T>& stream() { return *(*this)[0]; }
  const Stream<T>& stream() const { return *(*this)[0]; }

 private:
  void end_of_elaboration() override {
    sc_core::sc_object* module = this->get_parent_object();
    (*this)[0]->attach_reader(module->name(), dynamic_cast<Actor*>(module));
    if (take_) (*this)[0]->on_row(row_length_, take_);
  }

  std::size_t row_length_ = 0;
  typename Stream<T>::Row take_;
};

/// Output port of a stage: writes one stream, or the same tokens to several in the same cycle (a fork). What
/// it has of Stream is for blocks in kernel time, and does with all streams what Stream does with one.
template <class T>
class StreamOut final : public sc_core::sc_port<Stream<T>, 0>, public StreamPort {
 public:
  using sc_core::sc_port<Stream<T>, 0>::sc_port;

  bool is_input() const override { return false; }
  std::vector<StreamBase*> streams() override {
    std::vector<StreamBase*> bound;
    for (int i = 0; i < this->size(); ++i) bound.push_back((*this)[i]);
    return bound;
  }
  /// Hands the next `length` values to every bound stream.
  void send_row(const T* row, std::size_t length) {
    for (int i = 0; i < this->size(); ++i) (*this)[i]->send_row(row, length);
  }

  bool can_write() const {
    return all([](const Stream<T>& stream) { return stream.can_write(); });
  }
  bool can_write(Cycles cycle) const {
    return all([cycle](const Stream<T>& stream) { return stream.can_write(cycle); });
  }
  void write(const T& value) {
    for (int i = 0; i < this->size(); ++i) (*this)[i]->wait_writable();  // room that there is stays
    send_row(&value, 1);
    for (int i = 0; i < this->size(); ++i) (*this)[i]->commit();
  }
  void write(const T& value, Cycles cycle, Cycles blocked) {
    for (int i = 0; i < this->size(); ++i) (*this)[i]->write(value, cycle, blocked);
  }

 private:
  void end_of_elaboration() override {
    sc_core::sc_object* module = this->get_parent_object();
    for (int i = 0; i < this->size(); ++i) {
      (*this)[i]->attach_writer(module->name(), dynamic_cast<Actor*>(module));
    }
  }
  template <class Question>
  bool all(const Question& question) const {
    for (int i = 0; i < this->size(); ++i) {
      if (!question(*(*this)[i])) return false;
    }
    return true;
  }
};

}  // namespace parallax
