// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "platform/machine/machine.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/tracing/trace_options.hpp"
#include "traces/recorder.hpp"
#include "traces/sink_thread.hpp"

namespace parallax {

/// What the options ask for, checked. Throws UserError for a format, level, bound or combination that there
/// is not.
struct TraceChoice {
  std::vector<std::string> formats;
  bool tokens = false;
  TraceWindow window;
  std::vector<std::string> parts;
};
TraceChoice read_trace_options(const TraceOptions& options);

/// The trace of a run: a recorder on the parts of a machine, and the files that it fills.
class Tracing {
 public:
  /// To be made when the machine is, before the simulation starts. Throws UserError for a window outside the
  /// run, or a part that the machine has not. Files are of the folder's publish().
  Tracing(const TraceChoice& choice, const Machine& machine, SamplingTimer& timer, OutputFolder& folder);
  ~Tracing();

  /// Now; frames after the run's last one are left out.
  void frame_step(std::int64_t frame, FrameStep step) {
    if (frame < machine_.input().frames) recorder_.frame_step(frame, step);
  }
  /// Frame `frame` is at the host.
  void delivered(std::int64_t frame);
  /// When the simulation is over. Throws UserError when the disk was full, which has ended the simulation, or
  /// when the window was after its end.
  void finish();

 private:
  void add_parts();
  static ByteSink file(OutputFolder& folder, const std::string& name);
  static std::unique_ptr<TraceSink> make_sink(const std::string& format, OutputFolder& folder);

  const Machine& machine_;
  const std::vector<std::string> wanted_;  // parts; none: all
  const TraceWindow window_;
  std::vector<std::unique_ptr<SinkThread>> sinks_;
  bool stopping_ = false;  // a sink has failed
  Recorder recorder_;
};

}  // namespace parallax
